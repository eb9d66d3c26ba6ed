// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BounceScan_h
#define irradiance_BounceScan_h

#include "History/BounceBlock.h"
#include "History/PageScan.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Finds the stored segments that moved objects may change, by testing all segments of a
 * BounceBlock. It flags those that come near one of its bodies, those that end on an object that
 * moved, and those that are always flagged. It never misses one, flags a few too many, and flags
 * the same ones on every machine.
 *
 * Segments that are not whole within the grid are stored up to its border. While all bodies are
 * within the grid, no more is needed; if one sticks out, all such segments are flagged.
 */
class BounceScan
{
public:
  /// `grid`: of the blocks.
  explicit BounceScan(const PointGrid& grid);

  /// Segments that may touch this body are flagged; with its own box, fewer.
  void addBody(const EllipsoidBound& bound, const OwnBox* own = nullptr);
  /// Segments that end on this dynamic object are flagged.
  void addMoved(std::uint32_t object) { tags_.add(BounceTag::kindOf(object)); }

  /// Lists the slots of flagged segments, in order. `next`: the block that is scanned after it, to
  /// be prefetched, or the same one.
  void find(
    const BounceBlock& block, const BounceBlock& next, std::vector<std::uint32_t>& slots) const;

private:
  PointGrid grid_;
  float stretch_[3];
  TagSet tags_;
  bool flagsAll_ = false; ///< where floats might tell too little
  std::vector<GridBody> bodies_;
  std::vector<GridBall> balls_;
  bool areSmall_ = false;
};

}

#endif
