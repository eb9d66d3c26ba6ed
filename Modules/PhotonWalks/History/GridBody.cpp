// SPDX-License-Identifier: BSD-3-Clause
#include "History/GridBody.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr double kHalf = 0.5 + GridSegments::kBlur; // how far an end may be from its place
constexpr double kMore = 1 + 0x1p-20; // pays for the rounding of a few numbers to floats
constexpr double kRoundoff = 0x1p-24;
constexpr double kMost = 0x1p40, kLeast = 0x1p-40;

/// The largest |matrix * x| where no coordinate of x is above 1: at a corner.
double largestOfCube(const Matrix3& matrix)
{
  double largest = 0;
  for (const double y : { -1.0, 1.0 })
  {
    for (const double z : { -1.0, 1.0 })
    {
      largest = std::max(largest, (matrix * Vector3(1, y, z)).norm());
    }
  }
  return largest;
}

}

std::optional<GridBody> bodyOnGrid(const PointGrid& grid, const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const Matrix3 matrix = ball.roundFromWorld * grid.step.asDiagonal();
  const Vector3 offset = ball.roundFromWorld * (grid.center - ball.center);
  const double norm = matrix.norm();
  // No point of the grid is farther from 0 in the body's frame.
  const double farthest = std::sqrt(3.0) * PointGrid::kReach * norm + offset.norm();
  if (!(norm < kMost) || !(norm > kLeast) || !(farthest < kMost * PointGrid::kReach))
  {
    return std::nullopt;
  }
  constexpr double kRoundings = 32;
  const double radius =
    (ball.radius + kHalf * largestOfCube(matrix) + kRoundings * kRoundoff * farthest) * kMore;
  GridBody body{};
  Eigen::Map<Eigen::Matrix3f>(body.matrix) = matrix.cast<float>();
  Eigen::Map<Eigen::Vector3f>(body.offset) = offset.cast<float>();
  body.squaredRadius = static_cast<float>(radius * radius);
  return body;
}

GridBall ballOnGrid(const PointGrid& grid, const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball round = bound.ball();
  const double unit = grid.step.maxCoeff();
  const Vector3 center = (round.center - grid.center) / unit;
  const double stretch = 1 / Eigen::JacobiSVD<Matrix3>(round.roundFromWorld).singularValues()[2];
  const double farthest = std::sqrt(3.0) * PointGrid::kReach + center.norm();
  constexpr double kRoundings = 64, kSmall = 0x1p-4 * PointGrid::kReach;
  const double rounding = kRoundings * kRoundoff * farthest;
  const double radius = (round.radius * stretch / unit + std::sqrt(3.0) * kHalf + rounding) * kMore;
  GridBall ball;
  if (radius < kSmall && farthest < 4 * PointGrid::kReach)
  {
    Eigen::Map<Eigen::Vector3f>(ball.center) = center.cast<float>();
    ball.squaredRadius = static_cast<float>(radius * radius * kMore);
  }
  constexpr double kFarthest = 36000; // so that all sums fit in 16 bits
  if (ball.isSmall() && center.cwiseAbs().maxCoeff() < kFarthest)
  {
    constexpr double kRounding = 4; // of a line and the ball, in units
    const auto twice = [](double value) {
      return 0x10001u * static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(value)));
    };
    for (int axis = 0; axis < 3; ++axis)
    {
      ball.lineCenter[axis] = twice(center[axis] / GridBall::kLineUnit);
    }
    const double widest = std::sqrt(static_cast<double>(ball.squaredRadius));
    ball.lineRadius = twice(std::ceil(widest / GridBall::kLineUnit + kRounding));
  }
  return ball;
}

void addOwnBox(const PointGrid& grid, const OwnBox& own, GridBody& body)
{
  const Matrix3& linear = own.worldFromObject.linear;
  const Matrix3 inverse = linear.inverse();
  constexpr double kSlenderest = 0x1p10; // beyond, the inverse is not exact enough, row by row
  if (own.box.isEmpty() || !(linear.norm() * inverse.norm() < kSlenderest))
  {
    return;
  }
  const Vector3 center = own.box.center();
  const Vector3 half = (own.box.upper - center).cwiseMax(center - own.box.lower);
  const Vector3 away = grid.center - own.worldFromObject.translation;
  const Vector3 rows = inverse.rowwise().norm();
  const Matrix3 matrix = inverse * grid.step.asDiagonal();
  const Vector3 sums = matrix.cwiseAbs().rowwise().sum();
  // Divided by these the box is the cube.
  const Vector3 sizes = (half + own.worldPad * rows + kHalf * sums) * kMore;
  const Matrix3 scaled = sizes.cwiseInverse().asDiagonal() * matrix;
  const Vector3 offset = (inverse * away - center).cwiseQuotient(sizes);
  const Vector3 farthest = // of what is added up for a coordinate
    (PointGrid::kReach * sums + away.norm() * rows + center.cwiseAbs()).cwiseQuotient(sizes);
  const Vector3 largest = scaled.cwiseAbs().rowwise().maxCoeff();
  if (!(farthest.maxCoeff() < kMost) || !(largest.minCoeff() > kLeast))
  {
    return;
  }
  constexpr double kFaceRoundings = 64, kEdgeRoundings = 128;
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    body.face[i] = static_cast<float>((2 + kFaceRoundings * kRoundoff * farthest[i]) * kMore);
    body.slack[i] = static_cast<float>(kEdgeRoundings * kRoundoff * kMore *
      ((farthest[j] + 1) * largest[k] + (farthest[k] + 1) * largest[j]));
  }
  Eigen::Map<Eigen::Matrix3f>(body.boxMatrix) = scaled.cast<float>();
  Eigen::Map<Eigen::Vector3f>(body.boxOffset) = offset.cast<float>();
  body.hasBox = true;
}

}
