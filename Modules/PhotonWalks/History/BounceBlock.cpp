// SPDX-License-Identifier: BSD-3-Clause
#include "History/BounceBlock.h"

#include "History/PageScan.h"

namespace irradiance
{

namespace
{

std::uint8_t tagOf(std::uint8_t kind, GridSegments::State state)
{
  constexpr std::uint8_t kTooFar = BounceTag::kAlways | BounceTag::kOpen;
  return state == GridSegments::Whole ? kind
    : state == GridSegments::Cut      ? static_cast<std::uint8_t>(kind | BounceTag::kOpen)
                                      : kTooFar;
}

/// In a frame most runs have one row, for which a call would take longer.
template <class Value>
void copySome(const Value* from, std::size_t count, Value* to)
{
  if (count == 1)
  {
    *to = *from;
    return;
  }
  std::copy_n(from, count, to);
}

}

void BounceBlock::append(
  const BounceColumns& front, std::size_t first, std::size_t count, std::uint32_t* slots)
{
  if (pages_.empty()) // only now, so that whoever shoots the walks touches their memory first
  {
    pages_.reserve(3 * numberOfWalks_ / BouncePage::kSize + 1);
    while (pages_.size() * BouncePage::kSize < size_)
    {
      addPage();
    }
  }
  for (std::size_t at = 0; at < count; at += GridSegments::kSize)
  {
    appendSome(front, first + at, std::min(GridSegments::kSize, count - at), slots + at);
  }
}

void BounceBlock::appendSome(
  const BounceColumns& front, std::size_t first, std::size_t count, std::uint32_t* slots)
{
  const bool isScattered = !free_.empty();
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t parent = front.parents[first + i];
    slots[i] = parent == kNone ? front.walks[first + i] - firstWalk_ : newSlot();
    if (isScattered)
    {
      prefetchToStore(slots[i], parent);
    }
  }
  GridSegments segments;
  bounceLoops().placeOnGrid(grid_, front.rays, first, count, segments);
  for (std::size_t i = 0, run = 1; i < count; i += run)
  {
    // Most slots follow each other, up to the end of a page.
    const std::size_t most =
      std::min<std::size_t>(count - i, BouncePage::kSize - slots[i] % BouncePage::kSize);
    for (run = 1; run < most && slots[i + run] == slots[i] + run; ++run)
    {
    }
    storeRun(front, first + i, segments, i, slots[i], run);
  }
}

/// Rows from `row` on, placed from `at` on, to consecutive slots of a page.
void BounceBlock::storeRun(const BounceColumns& front, std::size_t row,
  const GridSegments& segments, std::size_t at, std::uint32_t slot, std::size_t count)
{
  BouncePage& page = pageOf(slot);
  const std::uint32_t place = slot % BouncePage::kSize;
  for (int column = 0; column < 6; ++column)
  {
    copySome(segments.ends[column] + at, count, page.ends[column] + place);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const unsigned contact =
      front.kinds[row + i] == BounceColumns::kContact ? BounceRecord::kContact : 0;
    const unsigned side = front.isFront[row + i] != 0 ? 0 : BounceRecord::kBack;
    page.records[place + i] = { front.triangles[row + i],
      { front.weights[0][row + i], front.weights[1][row + i] },
      static_cast<std::uint16_t>((front.walks[row + i] - firstWalk_) | side | contact), kEnd };
    page.tags[place + i] =
      tagOf(front.kinds[row + i], static_cast<GridSegments::State>(segments.states[at + i]));
    page.children[place + i] = kEnd;
    page.bounces[place + i] = 0;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto stored = slot + static_cast<std::uint32_t>(i);
    if (bands_ > 0)
    {
      for (std::uint32_t band = 0; band < bands_; ++band)
      {
        powersAt(stored)[band] = front.powers[band][row + i];
      }
    }
    if (front.parents[row + i] != kNone)
    {
      link(front.parents[row + i], stored);
    }
  }
}

void BounceBlock::removeFrom(std::uint32_t slot)
{
  unlink(slot);
  while (slot != kNone)
  {
    const std::uint32_t after = next(slot);
    pageOf(slot).tags[slot % BouncePage::kSize] = BounceTag::kFree;
    if (after != kNone && partOf(after) != partOf(slot))
    {
      children_.erase(slot);
      parents_.erase(after);
    }
    if (slot >= numberOfWalks_)
    {
      free_.push_back(slot);
    }
    slot = after;
  }
}

}
