// SPDX-License-Identifier: BSD-3-Clause
#include "History/BounceScan.h"

#include "Simd/SimdLevel.h"

namespace irradiance
{

BounceScan::BounceScan(const PointGrid& grid)
  : grid_(grid)
{
  tags_.add(BounceTag::kAlways);
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
}

void BounceScan::find(
  const BounceBlock& block, const BounceBlock& next, std::vector<std::uint32_t>& slots) const
{
  if (flagsAll_)
  {
    listAll(block, slots);
    return;
  }
  static thread_local std::vector<std::uint16_t> flagged;
  flagged.resize(block.pages().size() * PageScan::kGroups);
  const BouncePage* const after = next.pages().empty() ? nullptr : next.pages().front();
  const PageScan scan{ block.pages().data(), block.pages().size(), after, tags_, bodies_.data(),
    bodies_.size(), flagged.data() };
  IRRADIANCE_CALL_BEST(scanPages, scan);
  listFlagged(flagged, slots);
}

void BounceScan::listAll(const BounceBlock& block, std::vector<std::uint32_t>& slots)
{
  slots.clear();
  block.forEach([&](std::uint32_t slot) { slots.push_back(slot); });
}

void BounceScan::listFlagged(
  const std::vector<std::uint16_t>& flagged, std::vector<std::uint32_t>& slots)
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
