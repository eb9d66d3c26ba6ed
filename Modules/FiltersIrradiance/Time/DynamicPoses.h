// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DynamicPoses_h
#define irradiance_DynamicPoses_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstddef>
#include <map>

class vtkLinearTransform;

namespace irradiance
{

/// The transforms that the user gave to dynamic connections, by the numbers of these.
class DynamicPoses
{
public:
  /// It replaces what the connection had; null removes that. Return whether anything changed.
  bool set(int connection, vtkLinearTransform* worldFromObject);
  bool removeAll();

  /// Null if the connection has none.
  vtkLinearTransform* transform(int connection) const;
  std::size_t size() const { return poses_.size(); }
  bool isEmpty() const { return poses_.empty(); }
  int firstConnection() const { return poses_.begin()->first; }
  int lastConnection() const { return poses_.rbegin()->first; }
  /// When one of them last changed.
  vtkMTimeType changeTime() const;

private:
  std::map<int, vtkSmartPointer<vtkLinearTransform>> poses_;
};

}

#endif
