// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkRepair.h"

#include "Execution/ProgressSpan.h"
#include "Repair/Recast.h"
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace irradiance
{

namespace
{

constexpr std::size_t kUnits = 32; // at least, if there are as many blocks; for all threads
constexpr std::size_t kBatchSize = 512;

}

/// A walk to be repaired.
struct WalkRepair::Item
{
  std::size_t block;
  StaleMark* mark;             ///< null without StaleWalks
  const StaleSegment* segment; ///< null while the new hit is not known
};

/// Walks of consecutive blocks, on which one thread at a time works.
struct WalkRepair::Unit
{
  std::vector<Item> items; ///< ordered by walk
  std::size_t next = 0;
  std::unique_ptr<Batch> open;
};

/// Walks that are shot side by side, with a tally that is dropped if they are not done in time.
struct WalkRepair::Batch
{
  Batch(const State& state, Item* first, std::size_t count)
    : begin(first)
    , end(first + count)
    , tally(state.sums, balance)
    , walks(state.tracer, &state.history.frame(), state.storesSides)
  {
  }

  Item *begin, *end;
  std::vector<StaleSegment> recast; ///< of the items that an earlier frame marked
  PowerBalance balance;
  WalkTally tally;
  WalkBatch walks;
  double seconds = 0; ///< spent on it
  bool isFirst = false;
};

std::int64_t WalkRepair::run(Execution& execution)
{
  const std::vector<PowerClass> order = classes();
  double all = 0, done = 0;
  for (const PowerClass& like : order)
  {
    all += static_cast<double>(like.size);
  }
  for (const PowerClass& like : order)
  {
    if (hasBegun_ && state_.budget && state_.budget->itemsToBegin(1) == 0)
    {
      break;
    }
    std::vector<Unit> parts = units(like);
    const double from = done / all;
    done += static_cast<double>(like.size);
    ProgressSpan span(execution, from, done / all);
    SlicedPass pass{ parts.size(), {} };
    pass.work = [&](std::size_t i, const Deadline& deadline) { return work(parts[i], deadline); };
    pass.run(span);
  }
  for (std::size_t block = 0; state_.stale && block < state_.history.size(); ++block)
  {
    state_.stale->forgetRepaired(block);
  }
  if (state_.tails)
  {
    std::sort(state_.tails->begin(), state_.tails->end());
  }
  return segments_;
}

/// Each is large enough to fill the batches of all threads. If there is time for all, so is the
/// only one.
std::vector<PowerClass> WalkRepair::classes() const
{
  if (state_.stale)
  {
    constexpr std::size_t kForAUnit = 128;
    const std::size_t enough = kForAUnit * std::min(kUnits, state_.history.size());
    return state_.stale->classes(state_.budget ? enough : std::numeric_limits<std::size_t>::max());
  }
  PowerClass every{ 0, 0 };
  for (const auto& found : state_.found)
  {
    every.size += found.size();
  }
  return every.size > 0 ? std::vector<PowerClass>{ every } : std::vector<PowerClass>{};
}

/// A block has few stale walks. So walks of several blocks are shot together, as long as that leaves
/// enough units for all threads.
std::vector<WalkRepair::Unit> WalkRepair::units(const PowerClass& like) const
{
  const std::size_t together = std::min(like.size / kUnits, kBatchSize);
  std::vector<Unit> units;
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    if (units.empty() || units.back().items.size() >= std::max<std::size_t>(together, 1))
    {
      units.emplace_back();
      units.back().items.reserve(together);
    }
    addItems(block, like.weakest, units.back().items);
  }
  return units;
}

void WalkRepair::addItems(std::size_t block, std::uint16_t weakest, std::vector<Item>& items) const
{
  if (!state_.stale)
  {
    for (const StaleSegment& segment : state_.found[block])
    {
      items.push_back({ block, nullptr, &segment });
    }
    return;
  }
  for (StaleMark& mark : state_.stale->marks(block))
  {
    if (mark.powerClass >= weakest) // no stronger class is left
    {
      items.push_back({ block, &mark, nullptr });
    }
  }
}

bool WalkRepair::work(Unit& unit, const Deadline& deadline)
{
  while (unit.open || (unit.open = begin(unit)))
  {
    Batch& batch = *unit.open;
    const auto isTooLate = [&] { return !batch.isFirst && hasEnded(); };
    const double start = now();
    const bool isDone =
      batch.walks.run(batch.tally, [&] { return deadline.hasPassed() || isTooLate(); });
    if (isDone)
    {
      finish(batch);
    }
    batch.seconds += now() - start;
    if (!isDone && !isTooLate())
    {
      return false;
    }
    if (!isDone)
    {
      batch.tally.discard();
    }
    else if (state_.budget)
    {
      state_.budget->spend(batch.seconds, static_cast<std::size_t>(batch.end - batch.begin));
    }
    unit.open.reset();
    if (deadline.hasPassed())
    {
      return false;
    }
  }
  return true;
}

std::unique_ptr<WalkRepair::Batch> WalkRepair::begin(Unit& unit)
{
  constexpr std::size_t kFirst = 16;
  const std::size_t left = unit.items.size() - unit.next;
  if (left == 0)
  {
    return nullptr;
  }
  const double start = now();
  const std::size_t count = !state_.budget ? left
    : hasBegun_                            ? state_.budget->itemsToBegin(std::min(left, kBatchSize))
                                           : std::min(left, kFirst);
  if (count == 0)
  {
    return nullptr;
  }
  auto batch = std::make_unique<Batch>(state_, unit.items.data() + unit.next, count);
  unit.next += count;
  batch->isFirst = !hasBegun_.exchange(true);
  fill(*batch);
  batch->seconds = now() - start;
  return batch;
}

void WalkRepair::fill(Batch& batch) const
{
  constexpr std::ptrdiff_t kAhead = 16;
  findSegments(batch);
  for (const Item* item = batch.begin; item != batch.end; ++item)
  {
    if (batch.end - item > 2 * kAhead)
    {
      const Item& later = item[2 * kAhead];
      state_.history.block(later.block).prefetchPlace(later.segment->segment.walk);
    }
    if (batch.end - item > kAhead)
    {
      prefetch(item[kAhead]);
    }
    const StaleSegment& stale = *item->segment;
    const WalkBlock& block = state_.history.block(item->block);
    batch.walks.resume(stale.segment, stale.ray, stale.hit, block.power(stale.segment));
    batch.tally.remove(block, stale.segment);
  }
}

/// Prefetches what the tally will read of the old tail and what the new one will overwrite.
void WalkRepair::prefetch(const Item& item) const
{
  const WalkBlock& block = state_.history.block(item.block);
  block.prefetch(item.segment->segment);
  block.prefetchPoint(item.segment->segment);
}

/// Those that this frame's verification found have their new hits; the others are cast.
void WalkRepair::findSegments(Batch& batch) const
{
  std::vector<SegmentRef> earlier;
  std::vector<Item*> items;
  for (Item* item = batch.begin; item != batch.end; ++item)
  {
    item->segment = item->mark ? foundNow(*item) : item->segment;
    if (!item->segment)
    {
      earlier.push_back(item->mark->first());
      items.push_back(item);
    }
  }
  batch.recast = recast(state_.tracer, state_.history, earlier);
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    items[i]->segment = &batch.recast[i];
  }
}

const StaleSegment* WalkRepair::foundNow(const Item& item) const
{
  if (state_.found.empty())
  {
    return nullptr;
  }
  const std::vector<StaleSegment>& found = state_.found[item.block];
  const std::uint32_t walk = item.mark->walk;
  const auto known = std::lower_bound(found.begin(), found.end(), walk,
    [](const StaleSegment& stale, std::uint32_t w) { return stale.segment.walk < w; });
  return known != found.end() && known->segment.walk == walk ? &*known : nullptr;
}

void WalkRepair::finish(Batch& batch)
{
  std::vector<Deposit> stale;
  for (const Item* item = batch.begin; item != batch.end; ++item)
  {
    const StaleSegment& now = *item->segment;
    WalkBlock& block = state_.history.block(item->block);
    if (item->mark)
    {
      state_.stale->repair(item->block, block, *item->mark, stale);
    }
    block.updateStaticHit(
      now.segment, now.old, now.hit, state_.cacheStaticHits && !now.wasTouching);
  }
  if (state_.stale)
  {
    state_.stale->take(stale);
  }
  PhotonChanges changes;
  if (state_.changes)
  {
    collectTails(batch, changes.gone);
  }
  batch.walks.store(state_.history);
  if (state_.changes)
  {
    collectTails(batch, changes.arrived);
    const std::lock_guard<std::mutex> lock(changesMutex_);
    state_.changes->add(changes);
  }
  if (state_.tails)
  {
    listTails(batch);
  }
  balance_.add(batch.balance);
  segments_ += batch.walks.numberOfSegments();
}

void WalkRepair::listTails(const Batch& batch)
{
  const std::lock_guard<std::mutex> lock(changesMutex_);
  for (const Item* item = batch.begin; item != batch.end; ++item)
  {
    state_.tails->push_back(item->segment->segment);
  }
}

void WalkRepair::collectTails(const Batch& batch, std::vector<Photon>& photons) const
{
  for (const Item* item = batch.begin; item != batch.end; ++item)
  {
    state_.history.forEachPhotonFrom(
      item->segment->segment, [&](const Photon& photon) { photons.push_back(photon); });
  }
}

}
