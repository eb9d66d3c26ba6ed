// SPDX-License-Identifier: BSD-3-Clause
#include "History/SegmentScan.h"

#include "Simd/SimdLevel.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

ScanPoints pointsOf(const WalkBlock& block)
{
  return { block.x(), block.y(), block.z(), block.tags(), block.numberOfPoints() };
}

}

SegmentScan::SegmentScan(const UnitFrame& frame, double reach)
  : frame_(frame)
  , flagsAll_(!(reach <= kLargestReach))
{
}

void SegmentScan::addBody(const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const Matrix3 matrix = ball.roundFromWorld / frame_.scale;
  const Matrix3 inverse = matrix.inverse();
  const Vector3 offset = ball.roundFromWorld * (frame_.center - ball.center);
  // No point of the body is farther from 0.
  const double farthest = frame_(ball.center).norm() + ball.radius * inverse.norm();
  // Each term of a sum of floats is off by 2^-24 of itself; Documentation/Theory.md counts them.
  const double norm = matrix.norm();
  const double error = 0x1p-19 * norm;
  ScanBody body;
  Eigen::Map<Eigen::Matrix3f>(body.matrix) = matrix.cast<float>();
  Eigen::Map<Eigen::Vector3f>(body.offset) = offset.cast<float>();
  const double radius = ball.radius + error * farthest;
  // Bounds (radius + error |x|)^2 for any share, and tightly where x is as far as the body.
  const double share = std::max(0x1p-8, error * farthest / radius);
  body.squaredRadius = static_cast<float>((1 + share) * radius * radius * (1 + 0x1p-20));
  body.byDistance = static_cast<float>((1 + 1 / share) * error * error * (1 + 0x1p-20));
  constexpr float kLittle = 0x1p-5f; // of the squared radius
  squaredNear_ = std::min(squaredNear_, kLittle * body.squaredRadius / body.byDistance);
  // Beyond these limits a product of floats may overflow or vanish, or errors are no longer small.
  constexpr double kMost = 0x1p30, kLeast = 0x1p-30, kThinnest = 3.1 * 0x1p20;
  flagsAll_ = flagsAll_ || bodies_.size() == kMostBodies || !(norm < kMost) || !(norm > kLeast) ||
    !(norm * inverse.norm() < kThinnest) || !(farthest < 2 * kLargestReach);
  bodies_.push_back(body);
}

void SegmentScan::find(
  const WalkBlock& block, const WalkBlock& next, std::vector<std::uint32_t>& points) const
{
  points.clear();
  if (block.numberOfPoints() < 2)
  {
    return;
  }
  const std::size_t segments = block.numberOfPoints() - 1;
  if (flagsAll_)
  {
    points.resize(segments);
    std::iota(points.begin(), points.end(), 0);
    return;
  }
  static thread_local std::vector<std::uint16_t> flagged;
  flagged.resize(segments / PointScan::kGroupSize + 1);
  const PointScan scan{ pointsOf(block), pointsOf(next), tags_, bodies_.data(), bodies_.size(),
    squaredNear_, flagged.data() };
  IRRADIANCE_CALL_BEST(runScan, scan);
  for (std::size_t first = 0; first < segments; first += PointScan::kGroupSize)
  {
    for (unsigned bits = flagged[first / PointScan::kGroupSize]; bits != 0; bits &= bits - 1)
    {
      points.push_back(
        static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(__builtin_ctz(bits)));
    }
  }
}

}
