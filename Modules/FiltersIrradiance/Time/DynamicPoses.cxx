// SPDX-License-Identifier: BSD-3-Clause
#include "Time/DynamicPoses.h"

#include "vtkLinearTransform.h"

#include <algorithm>

namespace irradiance
{

bool DynamicPoses::set(int connection, vtkLinearTransform* worldFromObject)
{
  if (transform(connection) == worldFromObject)
  {
    return false;
  }
  poses_.erase(connection);
  if (worldFromObject)
  {
    poses_[connection] = worldFromObject;
  }
  return true;
}

bool DynamicPoses::removeAll()
{
  const bool hadAny = !poses_.empty();
  poses_.clear();
  return hadAny;
}

vtkLinearTransform* DynamicPoses::transform(int connection) const
{
  const auto found = poses_.find(connection);
  return found == poses_.end() ? nullptr : found->second.Get();
}

vtkMTimeType DynamicPoses::changeTime() const
{
  vtkMTimeType time = 0;
  for (const auto& [connection, pose] : poses_)
  {
    time = std::max(time, pose->GetMTime());
  }
  return time;
}

}
