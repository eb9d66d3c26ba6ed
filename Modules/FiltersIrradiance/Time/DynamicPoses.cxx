// SPDX-License-Identifier: BSD-3-Clause
#include "Time/DynamicPoses.h"

#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkNew.h"
#include "vtkQuaternionInterpolator.h"
#include "vtkTransform.h"
#include "vtkTransformInterpolator.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

double degreesAt(vtkTransformInterpolator* interpolator, double time)
{
  vtkNew<vtkTransform> pose;
  interpolator->InterpolateTransform(time, pose);
  double rotation[4];
  pose->GetOrientationWXYZ(rotation);
  return rotation[0];
}

/// VTK 9.1 takes the degrees of three or more keys for radians when it makes splines of them.
bool areRotationSplinesWrong()
{
  vtkNew<vtkTransformInterpolator> interpolator;
  interpolator->SetInterpolationTypeToSpline();
  constexpr double kStep = 40;
  for (int key = 0; key < 3; ++key)
  {
    vtkNew<vtkTransform> pose;
    pose->RotateZ(key * kStep);
    interpolator->AddTransform(key, pose);
  }
  return !(std::abs(degreesAt(interpolator, 1) - kStep) < 1e-6);
}

bool turnsBySpline(vtkTransformInterpolator* interpolator)
{
  const bool isSpline =
    interpolator->GetInterpolationType() == vtkTransformInterpolator::INTERPOLATION_TYPE_SPLINE ||
    (interpolator->GetInterpolationType() == vtkTransformInterpolator::INTERPOLATION_TYPE_MANUAL &&
      interpolator->GetRotationInterpolator()->GetInterpolationType() ==
        vtkQuaternionInterpolator::INTERPOLATION_TYPE_SPLINE);
  return isSpline && interpolator->GetNumberOfTransforms() > 2;
}

}

bool DynamicPoses::set(int connection, vtkLinearTransform* worldFromObject)
{
  if (transform(connection) == worldFromObject && !interpolator(connection))
  {
    return false;
  }
  poses_.erase(connection);
  if (worldFromObject)
  {
    poses_[connection].transform = worldFromObject;
  }
  return true;
}

bool DynamicPoses::set(int connection, vtkTransformInterpolator* worldFromObject)
{
  if (interpolator(connection) == worldFromObject && !transform(connection))
  {
    return false;
  }
  poses_.erase(connection);
  if (worldFromObject)
  {
    poses_[connection].interpolator = worldFromObject;
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
  return interpolator(connection) ? nullptr : pose(connection);
}

vtkTransformInterpolator* DynamicPoses::interpolator(int connection) const
{
  const auto found = poses_.find(connection);
  return found == poses_.end() ? nullptr : found->second.interpolator.Get();
}

vtkLinearTransform* DynamicPoses::pose(int connection) const
{
  const auto found = poses_.find(connection);
  return found == poses_.end() ? nullptr : found->second.transform.Get();
}

DynamicPoses::Keys DynamicPoses::keysOf(vtkTransformInterpolator* interpolator)
{
  const int count = interpolator->GetNumberOfTransforms();
  return count == 0 ? Keys{}
                    : Keys{ count, { interpolator->GetMinimumT(), interpolator->GetMaximumT() } };
}

vtkMTimeType DynamicPoses::changeTime()
{
  vtkMTimeType time = 0;
  for (auto& [connection, pose] : poses_)
  {
    if (!pose.interpolator)
    {
      time = std::max(time, pose.transform->GetMTime());
      continue;
    }
    const Keys keys = keysOf(pose.interpolator);
    if (keys != pose.seen)
    {
      pose.seen = keys;
      pose.changed.Modified();
    }
    time = std::max({ time, pose.interpolator->GetMTime(), pose.changed.GetMTime() });
  }
  return time;
}

void DynamicPoses::addTimes(TimeKeys& times) const
{
  for (const auto& [connection, pose] : poses_)
  {
    if (pose.interpolator && pose.interpolator->GetNumberOfTransforms() > 0)
    {
      times.addRange(pose.interpolator->GetMinimumT(), pose.interpolator->GetMaximumT());
    }
  }
}

void DynamicPoses::evaluate(std::optional<double> time)
{
  for (auto& [connection, pose] : poses_)
  {
    if (pose.interpolator)
    {
      evaluate("input port 1, connection " + std::to_string(connection), pose, time);
    }
  }
}

void DynamicPoses::evaluate(const std::string& name, Pose& pose, std::optional<double> time)
{
  vtkTransformInterpolator* interpolator = pose.interpolator;
  const Keys keys = keysOf(interpolator);
  const std::string subject = name + ": the transform interpolator ";
  if (keys.count < 2)
  {
    throw InputError(subject + "has " + std::to_string(keys.count) +
      (keys.count == 1 ? " key" : " keys") + "; it takes two at least");
  }
  const double now = time.value_or(keys.range[0]);
  if (!(now >= keys.range[0] && now <= keys.range[1]))
  {
    throw InputError(subject + "has keys from " + text(keys.range[0]) + " to " +
      text(keys.range[1]) + ", and the time " + text(now) + " is asked for");
  }
  if (keys != pose.evaluated)
  {
    interpolator->Modified(); // or it might not take notice of its own keys
    pose.evaluated = keys;
  }
  const auto worldFromObject = vtkSmartPointer<vtkTransform>::New();
  interpolator->InterpolateTransform(now, worldFromObject);
  pose.transform = worldFromObject;
  static const bool areWrong = areRotationSplinesWrong();
  if (areWrong && turnsBySpline(interpolator) &&
    (degreesAt(interpolator, now) != 0 || degreesAt(interpolator, keys.range[0]) != 0 ||
      degreesAt(interpolator, keys.range[1]) != 0))
  {
    throw InputError(subject +
      "has a spline of rotations, which this version of VTK evaluates wrongly: "
      "SetInterpolationTypeToLinear(), or use vtkKeyFramedPose, which has splines of its own");
  }
}

}
