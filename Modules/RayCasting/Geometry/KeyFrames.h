// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KeyFrames_h
#define irradiance_KeyFrames_h

#include "Geometry/Vector.h"
#include "Progress/CancelPoint.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace irradiance
{

/// A pose at a time.
struct KeyFrame
{
  std::string name; ///< for messages, as in "line 3 of poses.csv"
  double time = 0;
  AffineMap worldFromObject;
};

/// How poses between keys follow from them.
enum class KeyInterpolation
{
  Linear, ///< straight lines, constant speeds; rotations by the shorter way
  Spline, ///< cubic, through the keys with continuous velocity
  Step    ///< the pose of the last key
};

/// Poses over time. At the time of a key they are the pose of the key, bit for bit.
class KeyFrames
{
public:
  /// No keys.
  KeyFrames() = default;
  /// At least two keys, in the order of time. Throws InputError, naming the key and the value: for
  /// times that are not finite or not increasing, and for poses that cannot be interpolated, as
  /// they shear, or as some mirror and others do not.
  KeyFrames(
    std::vector<KeyFrame> keys, KeyInterpolation interpolation, const CancelPoint& cancelPoint);

  bool isEmpty() const { return keys_.empty(); }
  double begin() const { return keys_.front().time; }
  double end() const { return keys_.back().time; }
  /// The times of the keys, and between them others at equal distances, none longer than 1 /
  /// `parts` of the time from begin() to end(). 0: the keys alone.
  std::vector<double> steps(int parts) const;
  /// `time` is from begin() to end().
  AffineMap at(double time) const;

private:
  /// A pose in parts that can be interpolated: first scale, then rotate, then move.
  struct Parts
  {
    Vector3 position;
    Eigen::Quaterniond rotation;
    Vector3 scale; ///< all negative if the pose mirrors
  };

  static Parts partsOf(const KeyFrame& key);
  Parts linear(std::size_t key, double fraction) const;
  Parts spline(std::size_t key, double fraction) const;

  KeyInterpolation interpolation_ = KeyInterpolation::Linear;
  std::vector<KeyFrame> keys_;
  std::vector<Parts> parts_; ///< of each key; none if poses are not interpolated
  bool onlyMove_ = true;     ///< all keys have the same linear map
};

}

#endif
