// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/PrincipalAxes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <utility>

namespace irradiance
{
namespace
{

/// Makes two columns orthogonal by a Jacobi rotation; false if they are orthogonal already.
bool orthogonalize(Matrix3& columns, int p, int q)
{
  constexpr double kNegligible = 0x1p-51 * 0x1p-51; // squared cosine
  const double product = columns.col(p).dot(columns.col(q));
  const double squareP = columns.col(p).squaredNorm();
  const double squareQ = columns.col(q).squaredNorm();
  if (!(product * product > kNegligible * squareP * squareQ))
  {
    return false;
  }
  const double cotangent = (squareQ - squareP) / (2.0 * product); // of twice the angle
  const double tangent =
    std::copysign(1.0, cotangent) / (std::abs(cotangent) + std::sqrt(1.0 + cotangent * cotangent));
  const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
  const Vector3 turned = cosine * (columns.col(p) - tangent * columns.col(q));
  columns.col(q) = cosine * (columns.col(q) + tangent * columns.col(p));
  columns.col(p) = turned;
  return true;
}

void sortLongestFirst(Matrix3& columns)
{
  for (const auto& [p, q] : { std::pair(0, 1), std::pair(1, 2), std::pair(0, 1) })
  {
    if (columns.col(p).squaredNorm() < columns.col(q).squaredNorm())
    {
      columns.col(p).swap(columns.col(q));
    }
  }
}

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

// One-sided Jacobi iteration (Hestenes 1958). An eigenvalue solver works on squares, in which the
// short axes of a needle would drown.
Matrix3 principalSemiAxes(const Matrix3& matrix)
{
  // A power of two near the largest entry keeps fourth powers in range.
  const double largest = matrix.cwiseAbs().maxCoeff();
  const double scale = largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
  Matrix3 columns = matrix / scale;
  constexpr int kMaxSweeps = 20; // about five are needed
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep)
  {
    sortLongestFirst(columns); // speeds up convergence
    bool isOrthogonal = true;
    for (const auto& [p, q] : { std::pair(0, 1), std::pair(0, 2), std::pair(1, 2) })
    {
      isOrthogonal = !orthogonalize(columns, p, q) && isOrthogonal;
    }
    if (isOrthogonal)
    {
      break;
    }
  }
  sortLongestFirst(columns);
  return columns * scale;
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
