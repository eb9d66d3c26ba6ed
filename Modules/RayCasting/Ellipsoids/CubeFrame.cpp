// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/CubeFrame.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace irradiance
{
namespace
{

constexpr double kFlatness = 0x1p-20;         // thinnest axis over the longest
constexpr double kOffsetResolution = 0x1p-44; // thinnest axis over the distance from the origin
constexpr double kSmallestLength = 0x1p-200;  // only a point exactly at the origin needs it

Matrix3 principalDirections(const std::vector<Vector3>& points, const Vector3& origin, double unit,
  ThrottledCancelPoint& pace)
{
  Vector3 mean = Vector3::Zero();
  for (const Vector3& point : points)
  {
    mean += (point - origin) / unit;
    pace.step();
  }
  mean /= static_cast<double>(points.size());
  Matrix3 covariance = Matrix3::Zero();
  for (const Vector3& point : points)
  {
    const Vector3 d = (point - origin) / unit - mean;
    covariance += d * d.transpose();
    pace.step();
  }
  // A needle's covariance: one entry is large, the others near its rounding. The solver copes.
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(covariance);
  const bool usable = solver.info() == Eigen::Success && solver.eigenvectors().allFinite();
  return usable ? solver.eigenvectors() : Matrix3::Identity();
}

}

CubeFrame cubeFrame(const std::vector<Vector3>& points, const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  Box box;
  for (const Vector3& point : points)
  {
    box.add(point);
    pace.step();
  }
  CubeFrame frame;
  frame.origin = box.center();
  const double resolution = std::max(box.magnitude() * kOffsetResolution, kSmallestLength);
  const double size = std::max(0.5 * box.extent().maxCoeff(), resolution);
  const double unit = std::ldexp(1.0, std::ilogb(size)); // a power of two: dividing is exact
  frame.axes = principalDirections(points, frame.origin, unit, pace);

  Box rotated;
  for (const Vector3& point : points)
  {
    rotated.add(frame.axes.transpose() * (point - frame.origin));
    pace.step();
  }
  frame.origin += frame.axes * rotated.center();
  const Vector3 extent = 0.5 * rotated.extent();
  const double thinnest = std::max(kFlatness * extent.maxCoeff(), resolution);
  frame.halfWidth = extent.cwiseMax(thinnest);
  for (int axis = 0; axis < 3; ++axis)
  {
    frame.isFlat[axis] = extent[axis] < thinnest;
  }
  return frame;
}

}
