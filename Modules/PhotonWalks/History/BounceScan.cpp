// SPDX-License-Identifier: BSD-3-Clause
#include "History/BounceScan.h"

namespace irradiance
{

namespace
{

/// The slots whose bits are set, see PageScan.
void listFlagged(const std::vector<std::uint16_t>& flagged, std::vector<std::uint32_t>& slots)
{
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

}

BounceScan::BounceScan(const PointGrid& grid)
  : grid_(grid)
{
  tags_.add(BounceTag::kAlways);
  for (int axis = 0; axis < 3; ++axis)
  {
    stretch_[axis] = static_cast<float>(grid.step[axis] / grid.step.maxCoeff());
  }
}

void BounceScan::addBody(const EllipsoidBound& bound, const OwnBox* own)
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

void BounceScan::find(
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
  listFlagged(flagged, slots);
}

}
