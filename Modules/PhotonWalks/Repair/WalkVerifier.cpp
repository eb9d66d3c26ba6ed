// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkVerifier.h"

#include <algorithm>

namespace irradiance
{

WalkVerifier::WalkVerifier(const WalkTracer& tracer, const WalkHistory& history,
  const std::vector<bool>& moved, const BounceScan& scan, const ChangedReflections& reflections,
  const KeptParts& kept, bool cachesStaticHits)
  : tracer_(tracer)
  , history_(history)
  , scan_(scan)
  , reflections_(reflections)
  , kept_(kept)
  , cachesStaticHits_(cachesStaticHits)
  , firstDynamic_(history.numbers().objects() > 1 ? history.numbers().first(1) : WalkFront::kNone)
{
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    hasMoved_.resize(history.numbers().first(i + 2) - firstDynamic_, moved[i] ? 1 : 0);
  }
}

template <class IsChosen>
void WalkVerifier::choose(Memory& memory, const IsChosen& isChosen, WalkFront& stale) const
{
  const std::array<Suspects*, 3> suspects = memory.all();
  const std::array<const WalkFront*, 3> fronts{ &suspects[0]->rows, &suspects[1]->rows,
    &suspects[2]->rows };
  using Row = WalkFront::Rows::value_type;
  const auto isBefore = [&](const Row& a, const Row& b) {
    return fronts[a.first]->block[a.second] < fronts[b.first]->block[b.second];
  };
  memory.chosen.clear();
  for (std::size_t i = 0; i < fronts.size(); ++i)
  {
    const auto before = static_cast<std::ptrdiff_t>(memory.chosen.size());
    for (std::size_t row = 0; row < fronts[i]->size; ++row)
    {
      if (isChosen(*fronts[i], row))
      {
        memory.chosen.emplace_back(i, row);
      }
    }
    std::inplace_merge(
      memory.chosen.begin(), memory.chosen.begin() + before, memory.chosen.end(), isBefore);
  }
  stale.pick(fronts, memory.chosen);
  for (std::size_t i = 0; cachesStaticHits_ && i < memory.chosen.size(); ++i)
  {
    const auto [front, row] = memory.chosen[i];
    const Suspects& from = *suspects[front];
    memory.hidden.push_back(isDynamic(from.rows.hit[row]) ? from.known[row] : HiddenHit{});
  }
}

void WalkVerifier::find(std::size_t first, std::size_t end,
  const std::vector<const StaleMarks*>& known, Memory& memory, WalkFront& stale) const
{
  memory.slots.resize(std::max(memory.slots.size(), end - first));
  for (std::size_t block = first; block < end; ++block)
  {
    scan_.find(history_.block(block), history_.block(std::min(block + 1, end - 1)),
      memory.slots[block - first]);
  }
  memory.firstStale.assign((end - first) * WalkPlan::kWalksPerBlock, BounceBlock::kNone);
  memory.clear();
  const auto prefetchHits = [&](std::size_t block) {
    for (std::size_t i = 0; block < end && i < memory.slots[block - first].size(); ++i)
    {
      history_.block(block).prefetchHit(memory.slots[block - first][i]);
    }
  };
  prefetchHits(first);
  for (std::size_t block = first; block < end; ++block)
  {
    prefetchHits(block + 1);
    std::uint32_t* const firstStale =
      memory.firstStale.data() + (block - first) * WalkPlan::kWalksPerBlock;
    sort(block, memory.slots[block - first], known.empty() ? nullptr : known[block], firstStale,
      memory);
  }
  suspects_ += static_cast<std::int64_t>(
    memory.blocked.rows.size + memory.lost.rows.size + memory.uncovered.rows.size);
  cast(memory, false);
  noteFirst(first, memory);
  choose(
    memory,
    [&](const WalkFront& rows, std::size_t row) {
      return rows.bounce[row] == memory.firstStale[walkAt(rows, row, first)];
    },
    stale);
  found_ += static_cast<std::int64_t>(stale.size);
}

void WalkVerifier::castAgain(
  const std::vector<SegmentPlace>& places, bool areLost, Memory& memory, WalkFront& stale) const
{
  memory.clear();
  memory.reserve(places.size(), history_.bands());
  for (const SegmentPlace& place : places)
  {
    const std::uint32_t hit = history_.block(place.block).triangle(place.slot);
    add(place.block, place.slot, areLost || isDynamic(hit), memory);
  }
  cast(memory, true);
  choose(
    memory, [](const WalkFront&, std::size_t) { return true; }, stale);
}

void WalkVerifier::cast(Memory& memory, bool byAllDynamic) const
{
  for (Suspects* const suspects : memory.all())
  {
    memory.rays.find(tracer_, history_, suspects->rows);
  }
  // The old hit is not on a moved object. It is valid unless a moved object came in front of it.
  WalkFront& blocked = memory.blocked.rows;
  tracer_.findDistances(blocked, memory.cast);
  for (std::size_t row = 0; cachesStaticHits_ && row < blocked.size; ++row)
  {
    if (!isDynamic(blocked.hit[row]))
    {
      memory.blocked.known[row] = { blocked.distance[row], blocked.hit[row],
        { blocked.weightB[row], blocked.weightC[row] } };
    }
  }
  byAllDynamic ? tracer_.castDynamic(blocked, memory.cast)
               : tracer_.castMoved(blocked, memory.cast);
  tracer_.cast(memory.lost.rows, memory.cast); // the object that was hit moved, or objects touch
  // Dynamic objects hid a static hit that is known.
  WalkFront& uncovered = memory.uncovered.rows;
  for (std::size_t row = 0; row < uncovered.size; ++row)
  {
    const HiddenHit& known = memory.uncovered.known[row];
    uncovered.distance[row] = known.distance;
    uncovered.hit[row] = known.triangle;
    uncovered.weightB[row] = known.weights[0];
    uncovered.weightC[row] = known.weights[1];
  }
  tracer_.castDynamic(uncovered, memory.cast);
}

/// Decides for each flagged segment of a block how to find out whether it is stale. Those at whose
/// hits walks go on otherwise are.
void WalkVerifier::sort(std::size_t number, std::vector<std::uint32_t>& slots,
  const StaleMarks* known, std::uint32_t* firstStale, Memory& memory) const
{
  const BounceBlock& block = history_.block(number);
  const auto isKnown = [&](std::uint32_t slot) {
    return known && irradiance::isStale(*known, block.segmentAt(slot));
  };
  const auto noteStale = [&](std::uint32_t slot) {
    if (!isKnown(slot))
    {
      std::uint32_t& least = firstStale[block.walkOf(slot) - block.firstWalk()];
      least = std::min(least, block.bounceOf(slot));
    }
  };
  for (const std::uint32_t slot : slots)
  {
    if (hasMoved(block.triangle(slot)) || (!kept_.areAll() && block.isLost(slot)))
    {
      noteStale(slot);
    }
  }
  if (!reflections_.isEmpty())
  {
    const auto flagged = static_cast<std::ptrdiff_t>(slots.size());
    block.forEach([&](std::uint32_t slot) {
      if (reflections_.change(block, slot))
      {
        noteStale(slot);
        slots.push_back(slot);
      }
    });
    std::inplace_merge(slots.begin(), slots.begin() + flagged, slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  }
  memory.reserve(slots.size(), history_.bands());
  for (const std::uint32_t slot : slots)
  {
    // What comes after a segment whose hit moved need not be looked at; nor could its ray be found.
    if (block.bounceOf(slot) <= firstStale[block.walkOf(slot) - block.firstWalk()] &&
      !isKnown(slot))
    {
      // A static part is not among what moved.
      add(number, slot, kept_.mayMeetOthers() || hasMoved(block.triangle(slot)), memory);
    }
  }
}

void WalkVerifier::add(std::size_t number, std::uint32_t slot, bool isLost, Memory& memory) const
{
  const BounceBlock& block = history_.block(number);
  const bool isTouched = isTouching(block, slot);
  const bool mayHide = cachesStaticHits_ && !isTouched && isDynamic(block.triangle(slot));
  const HiddenHit hidden = mayHide ? history_.hidden({ number, slot }) : HiddenHit{};
  Suspects& suspects = isTouched ? memory.lost
    : !isLost                    ? memory.blocked
    : hidden.isKnown()           ? memory.uncovered
                                 : memory.lost;
  const std::size_t row = suspects.rows.size++;
  suspects.rows.block[row] = static_cast<std::uint32_t>(number);
  suspects.rows.slot[row] = slot;
  if (cachesStaticHits_)
  {
    suspects.known.push_back(hidden);
  }
}

/// Whether contacts affect the stored hit.
bool WalkVerifier::isTouching(const BounceBlock& block, std::uint32_t slot) const
{
  if (block.isContact(slot))
  {
    return true;
  }
  if (!tracer_.hasContacts())
  {
    return false;
  }
  const std::uint32_t hit = block.triangle(slot), parent = block.previous(slot);
  const std::uint32_t start =
    parent == BounceBlock::kNone ? tracer_.startOf(block.walkOf(slot)) : block.triangle(parent);
  return tracer_.hasContact(hit) || tracer_.isContact(start, hit);
}

/// Segments whose hit moved are stale even if the same triangle is found again: its normal and the
/// point on it have changed. They were noted before.
void WalkVerifier::noteFirst(std::size_t firstBlock, Memory& memory) const
{
  const auto noteIf = [&](const WalkFront& rows, const auto& isStale) {
    for (std::size_t row = 0; row < rows.size; ++row)
    {
      std::uint32_t& first = memory.firstStale[walkAt(rows, row, firstBlock)];
      if (rows.bounce[row] < first && isStale(row))
      {
        first = rows.bounce[row];
      }
    }
  };
  const WalkFront &blocked = memory.blocked.rows, &lost = memory.lost.rows;
  noteIf(blocked, [&](std::size_t row) { return blocked.hit[row] != blocked.candidate[row]; });
  noteIf(lost, [&](std::size_t row) { return isChanged(lost, row); });
}

}
