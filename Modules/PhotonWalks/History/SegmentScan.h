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
 * Finds the stored segments that moved objects may change, by testing all segments. It flags those
 * that come near one of its bodies, those that end on an object that moved, and contacts. It never
 * misses one, and flags a few too many.
 */
class SegmentScan
{
public:
  /// `frame`: of the points; `reach` the largest coordinate of any point in it, except the
  /// ends of escaped segments.
  SegmentScan(const UnitFrame& frame, double reach);

  /// Segments that may touch this body are flagged.
  void addBody(const EllipsoidBound& bound);
  /// Segments that end on this dynamic object are flagged.
  void addMoved(std::uint32_t object) { tags_ |= 1u << WalkBlock::tagOf(object); }

  /// Lists in `points` the points of the block, in order, where flagged segments begin. `next`: the
  /// block that is scanned after it, to be prefetched, or the same one.
  void find(
    const WalkBlock& block, const WalkBlock& next, std::vector<std::uint32_t>& points) const;

private:
  /// To test more bodies costs more than a ray through the trees over them.
  static constexpr std::size_t kMostBodies = 128;
  /// Escaped segments end beyond everything within this reach, see WalkBlock::kFar.
  static constexpr double kLargestReach = 0x1p22;

  UnitFrame frame_;
  std::uint32_t tags_ = 1u << WalkBlock::kContactTag; ///< contacts are always flagged
  std::vector<ScanBody> bodies_;
  float squaredNear_ = std::numeric_limits<float>::max();
  bool flagsAll_ = false;
};

}

#endif
