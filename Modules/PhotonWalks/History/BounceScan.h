// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  explicit BounceScan(const PointGrid& grid)
    : grid_(grid)
  {
    tags_.add(BounceTag::kAlways);
    for (int axis = 0; axis < 3; ++axis)
    {
      stretch_[axis] = static_cast<float>(grid.step[axis] / grid.step.maxCoeff());
    }
  }

  /// Segments that may touch this body are flagged; with its own box, fewer.
  void addBody(const EllipsoidBound& bound, const OwnBox* own = nullptr)
  {
    if (bound.worldBox().isEmpty())
    {
      return;
    }
    const Vector3 lower = grid_(bound.worldBox().lower), upper = grid_(bound.worldBox().upper);
    constexpr double kInner = GridSegments::kInner;
    if (!(lower.minCoeff() > -kInner) || !(upper.maxCoeff() < kInner))
    {
      tags_.open = BounceTag::kOpen;
    }
    std::optional<GridBody> body = bodyOnGrid(grid_, bound);
    if (!body)
    {
      flagsAll_ = true;
      return;
    }
    if (own != nullptr)
    {
      addOwnBox(grid_, *own, *body);
    }
    bodies_.push_back(*body);
    balls_.push_back(ballOnGrid(grid_, bound));
    areSmall_ = areSmall_ || balls_.back().isSmall();
  }
  /// All segments are flagged.
  void addAll() { flagsAll_ = true; }
  /// Segments that end on this dynamic object are flagged.
  void addMoved(std::uint32_t object) { tags_.add(BounceTag::kindOf(object)); }

  /// Lists the slots of flagged segments, in order. `next`: the block that is scanned after it, to
  /// be prefetched, or the same one.
  void find(
    const BounceBlock& block, const BounceBlock& next, std::vector<std::uint32_t>& slots) const
  {
    if (flagsAll_)
    {
      slots.clear();
      block.forEach([&](std::uint32_t slot) { slots.push_back(slot); });
      return;
    }
    static thread_local std::vector<std::uint16_t> flagged;
    static thread_local std::vector<NearBody> near;
    near.resize(PageScan::kMostParts * bodies_.size() + 1);
    flagged.resize(block.pages().size() * PageScan::kGroups);
    const BouncePage* const after = next.pages().empty() ? nullptr : next.pages().front();
    const PageScan scan{ block.pages().data(), block.pages().size(), after, tags_, bodies_.data(),
      balls_.data(), static_cast<std::uint32_t>(bodies_.size()), areSmall_, stretch_, near.data(),
      flagged.data() };
    bounceLoops().scanPages(scan);
    slots.clear();
    for (std::size_t group = 0; group < flagged.size(); ++group)
    {
      const auto first = static_cast<std::uint32_t>(group) * PageScan::kGroupSize;
      for (unsigned bits = flagged[group]; bits != 0; bits &= bits - 1)
      {
        slots.push_back(first + static_cast<std::uint32_t>(__builtin_ctz(bits)));
      }
    }
  }

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
