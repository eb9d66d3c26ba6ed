// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SegmentScan_h
#define irradiance_SegmentScan_h

#include "Ellipsoids/EllipsoidBound.h"
#include "History/PointScan.h"
#include "History/WalkBlock.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace irradiance
{

/**
 * Finds the stored segments that moved objects may change, by a look at all of them: those that come
 * near one of some bodies, and those that end on an object that moved. It never misses one, and
 * names a few too many.
 */
class SegmentScan
{
public:
  /// `frame` is that of the points; `reach` the largest coordinate of any point in it, but for the
  /// ends of escaped segments.
  SegmentScan(const UnitFrame& frame, double reach);

  /// A body that segments must not touch.
  void addBody(const EllipsoidBound& bound);
  /// Segments that end on this dynamic object are named.
  void addMoved(std::uint32_t object) { tags_ |= 1u << WalkBlock::tagOf(object); }

  /// The points of the block, in order, where such segments begin. `next`: the block that will be
  /// looked at after it, or the same.
  void find(
    const WalkBlock& block, const WalkBlock& next, std::vector<std::uint32_t>& points) const;

private:
  /// To look at more bodies costs more than a ray through the trees over them.
  static constexpr std::size_t kMostBodies = 512;
  /// Escaped segments end behind all that is within this, see WalkBlock::kFar.
  static constexpr double kLargestReach = 0x1p22;

  UnitFrame frame_;
  std::uint32_t tags_ = 1u << WalkBlock::kContactTag; ///< contacts are always named
  std::vector<ScanBody> bodies_;
  float squaredNear_ = std::numeric_limits<float>::max();
  bool namesAll_ = false;
};

}

#endif
