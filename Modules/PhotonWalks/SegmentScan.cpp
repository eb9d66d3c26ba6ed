#include "SegmentScan.h"

#include "SimdLevel.h"

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
  , reach_(reach)
  , namesAll_(!(reach <= kLargestReach))
{
}

void SegmentScan::addBody(const EllipsoidBound& bound)
{
  const EllipsoidBound::Ball ball = bound.ball();
  const Matrix3 matrix = ball.roundFromWorld / frame_.scale;
  const Vector3 offset = ball.roundFromWorld * (frame_.center - ball.center);
  // No point is farther from 0. Floats are off by 2^-24 of each number in a sum of a few, squares of
  // lengths by that of the squares; Documentation/Theory.md counts them.
  const double farthest = 2 * reach_ * matrix.norm() + offset.norm();
  const double radius = ball.radius + 0x1p-20 * farthest;
  ScanBody body;
  Eigen::Map<Eigen::Matrix3f>(body.matrix) = matrix.cast<float>();
  Eigen::Map<Eigen::Vector3f>(body.offset) = offset.cast<float>();
  body.squaredRadius =
    static_cast<float>((radius * radius + 0x1p-18 * farthest * farthest) * (1 + 0x1p-20));
  // Beyond these, a product of floats might overflow, or vanish.
  constexpr double kMost = 1e6, kLeast = 1e-6;
  const double stretch = matrix.norm();
  namesAll_ = namesAll_ || bodies_.size() == kMostBodies || !(stretch < kMost) ||
    !(stretch > kLeast) || !(farthest < kMost);
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
  if (namesAll_)
  {
    points.resize(segments);
    std::iota(points.begin(), points.end(), 0);
    return;
  }
  static thread_local std::vector<std::uint16_t> named;
  named.resize(segments / PointScan::kTogether + 1);
  const PointScan scan{ pointsOf(block), pointsOf(next), tags_, bodies_.data(), bodies_.size(),
    named.data() };
#ifdef __x86_64__
  const SimdLevel level = simdLevel();
  (level == SimdLevel::Avx512    ? runScanAvx512
      : level == SimdLevel::Avx2 ? runScanAvx2
                                 : runScanPlain)(scan);
#else
  runScanPlain(scan);
#endif
  for (std::size_t first = 0; first < segments; first += PointScan::kTogether)
  {
    for (unsigned bits = named[first / PointScan::kTogether]; bits != 0; bits &= bits - 1)
    {
      points.push_back(
        static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(__builtin_ctz(bits)));
    }
  }
}

}
