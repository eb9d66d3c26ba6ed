// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DynamicPoses_h
#define irradiance_DynamicPoses_h

#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <map>
#include <optional>
#include <string>

class vtkLinearTransform;
class vtkTransform;
class vtkTransformInterpolator;

namespace irradiance
{

class TimeKeys;

/// The transforms and transform interpolators that the user gave to dynamic connections, by the
/// numbers of these. A connection has one of the two at most.
class DynamicPoses
{
public:
  /// They replace what the connection had; null removes it. Return whether anything changed.
  bool set(int connection, vtkLinearTransform* worldFromObject);
  bool set(int connection, vtkTransformInterpolator* worldFromObject);
  bool removeAll();

  /// Null if the connection has none.
  vtkLinearTransform* transform(int connection) const;
  vtkTransformInterpolator* interpolator(int connection) const;
  std::size_t size() const { return poses_.size(); }
  bool isEmpty() const { return poses_.empty(); }
  int firstConnection() const { return poses_.begin()->first; }
  int lastConnection() const { return poses_.rbegin()->first; }

  /// When one of them last changed, as far as can be told: VTK 9.1 does not say so where a first or
  /// last key comes or goes. Keys that change in number or range are noticed all the same.
  vtkMTimeType changeTime();
  /// Adds the range of the interpolators' keys.
  void addTimes(TimeKeys& times) const;
  /// Evaluates the interpolators at `time`, or each at its first key. Not thread-safe, as they
  /// initialize themselves, which counts as a change. Throws InputError.
  void evaluate(std::optional<double> time);
  /// The transform, or what the interpolator gave; null if the connection has neither.
  vtkLinearTransform* pose(int connection) const;

private:
  /// What can be seen of an interpolator's keys.
  struct Keys
  {
    int count = 0;
    double range[2] = { 0, 0 };
    bool operator!=(const Keys& other) const
    {
      return count != other.count || range[0] != other.range[0] || range[1] != other.range[1];
    }
  };

  struct Pose
  {
    vtkSmartPointer<vtkLinearTransform> transform;
    vtkSmartPointer<vtkTransformInterpolator> interpolator; ///< null: `transform` stays
    Keys seen;                                              ///< by changeTime()
    Keys evaluated;                                         ///< by evaluate()
    vtkTimeStamp changed;                                   ///< when other keys were seen
  };

  static Keys keysOf(vtkTransformInterpolator* interpolator);
  static void evaluate(const std::string& name, Pose& pose, std::optional<double> time);

  std::map<int, Pose> poses_;
};

}

#endif
