// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/BudgetedRepair.h"

#include "Execution/ProgressSpan.h"
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace irradiance
{

/// Walks that are shot side by side, with a tally that is dropped if they are not done in time.
struct BudgetedRepair::Batch
{
  struct Item
  {
    std::size_t block;
    std::uint32_t walk;
    StaleMark* mark;
  };

  explicit Batch(const State& state)
    : tally(state.sums, balance)
    , walks(state.shooter, &state.frame)
  {
  }

  std::vector<Item> items;
  std::vector<StaleSegment> segments; ///< of the items
  std::vector<bool> isKnown;          ///< whether this frame's verification found the hit
  PowerBalance balance;
  WalkTally tally;
  WalkBatch walks;
  double seconds = 0; ///< spent on it
  bool isFirst = false;
};

std::int64_t BudgetedRepair::run(Execution& execution)
{
  const std::vector<Class> order = classes();
  std::size_t all = 0, done = 0;
  for (const Class& like : order)
  {
    all += like.size;
  }
  for (const Class& like : order)
  {
    if (isOver())
    {
      break;
    }
    std::vector<Unit> parts = units();
    ProgressSpan span(execution, static_cast<double>(done) / static_cast<double>(all),
      static_cast<double>(done + like.size) / static_cast<double>(all));
    SlicedPass pass{ parts.size(), {} };
    pass.work = [&](std::size_t i, const Deadline& deadline) {
      return work(parts[i], like.weakest, deadline);
    };
    pass.run(span);
    done += like.size;
  }
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    state_.stale.forgetRepaired(block);
  }
  return segments_;
}

std::vector<BudgetedRepair::Class> BudgetedRepair::classes() const
{
  constexpr std::size_t kForAUnit = 128;
  std::map<std::uint16_t, std::size_t, std::greater<>> counts;
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    for (const StaleMark& mark : std::as_const(state_.stale).marks(block))
    {
      ++counts[mark.effect];
    }
  }
  const std::size_t enough = kForAUnit * units().size();
  std::vector<Class> classes;
  for (const auto& [effect, count] : counts)
  {
    if (classes.empty() || (classes.back().size >= enough && !time_.isEndless()))
    {
      classes.push_back({ effect, 0 });
    }
    classes.back().weakest = effect;
    classes.back().size += count;
  }
  return classes;
}

std::vector<BudgetedRepair::Unit> BudgetedRepair::units() const
{
  // As many blocks as leave enough units for all threads, as a block has few stale walks.
  constexpr std::size_t kUnits = 32, kMostTogether = 16;
  const std::size_t blocks = state_.history.size();
  const std::size_t together = std::clamp<std::size_t>(blocks / kUnits, 1, kMostTogether);
  std::vector<Unit> units;
  for (std::size_t block = 0; block < blocks; block += together)
  {
    units.push_back({ block, std::min(block + together, blocks), 0, {} });
  }
  return units;
}

bool BudgetedRepair::work(Unit& unit, std::uint16_t weakest, const Deadline& deadline)
{
  while (unit.open || (unit.open = begin(unit, weakest)))
  {
    Batch& batch = *unit.open;
    const auto isTooLate = [&] { return !batch.isFirst && time_.hasEnded(); };
    const double start = time_.now();
    const bool isDone =
      batch.walks.run(batch.tally, [&] { return deadline.hasPassed() || isTooLate(); });
    if (isDone)
    {
      finish(batch);
    }
    batch.seconds += time_.now() - start;
    if (!isDone && !isTooLate())
    {
      return false;
    }
    isDone ? time_.spend(batch.seconds, batch.items.size()) : batch.tally.discard();
    unit.open.reset();
    if (deadline.hasPassed())
    {
      return false;
    }
  }
  return true;
}

std::shared_ptr<BudgetedRepair::Batch> BudgetedRepair::begin(Unit& unit, std::uint16_t weakest)
{
  constexpr std::size_t kBatchSize = 512, kFirst = 16;
  const double start = time_.now();
  const std::size_t count = hasBegun_ ? time_.itemsToBegin(kBatchSize) : kFirst;
  if (count == 0)
  {
    return nullptr;
  }
  auto batch = std::make_shared<Batch>(state_);
  while (batch->items.size() < count && unit.block < unit.endBlock)
  {
    StaleMarks& marks = state_.stale.marks(unit.block);
    for (; unit.mark < marks.size() && batch->items.size() < count; ++unit.mark)
    {
      if (marks[unit.mark].effect >= weakest) // no stronger class is left
      {
        StaleMark& mark = marks[unit.mark];
        batch->items.push_back(
          { unit.block, state_.plan.firstWalkOf(unit.block) + mark.walkInBlock, &mark });
      }
    }
    if (unit.mark == marks.size())
    {
      ++unit.block;
      unit.mark = 0;
    }
  }
  if (batch->items.empty())
  {
    return nullptr;
  }
  batch->isFirst = !hasBegun_.exchange(true);
  fill(*batch);
  batch->seconds = time_.now() - start;
  return batch;
}

void BudgetedRepair::fill(Batch& batch) const
{
  for (const Batch::Item& item : batch.items)
  {
    const StaleSegment* known = foundNow(item.block, item.mark->walkInBlock);
    batch.segments.push_back(known
        ? *known
        : StaleSegment{ item.mark->walkInBlock, item.mark->bounce, {}, {}, {}, false });
    batch.isKnown.push_back(known != nullptr);
  }
  castAnew(batch);
  for (std::size_t i = 0; i < batch.items.size(); ++i)
  {
    const WalkBlock& block = state_.history[batch.items[i].block];
    const StaleSegment& segment = batch.segments[i];
    const std::uint32_t walk = batch.items[i].walk;
    batch.walks.resume(walk, segment.bounce, segment.ray, segment.hit,
      block.power(segment.walkInBlock, segment.bounce));
    for (std::uint32_t k = segment.bounce; k < block.size(segment.walkInBlock); ++k)
    {
      const TriangleId id = block.hit(segment.walkInBlock, k).id;
      if (id != TriangleId{})
      {
        batch.tally.prefetch(walk, id.object, state_.sums.cellOf(id)); // will be subtracted
      }
    }
  }
}

const StaleSegment* BudgetedRepair::foundNow(std::size_t block, std::uint32_t walk) const
{
  if (state_.found.empty())
  {
    return nullptr;
  }
  const std::vector<StaleSegment>& found = state_.found[block];
  const auto known = std::lower_bound(found.begin(), found.end(), walk,
    [](const StaleSegment& segment, std::uint32_t w) { return segment.walkInBlock < w; });
  return known != found.end() && known->walkInBlock == walk ? &*known : nullptr;
}

/// A hit that the verification of an earlier frame found may have changed since, but its ray has
/// not. If the static hit along the ray is known, only dynamic objects can precede it.
void BudgetedRepair::castAnew(Batch& batch) const
{
  const WalkShooter& shooter = state_.shooter;
  const Scene& scene = shooter.scene();
  std::vector<WalkShooter::Stored> stored;
  std::vector<std::size_t> unknown;
  for (std::size_t i = 0; i < batch.items.size(); ++i)
  {
    if (!batch.isKnown[i])
    {
      const Batch::Item& item = batch.items[i];
      stored.push_back({ &state_.history[item.block], batch.segments[i].walkInBlock, item.walk,
        batch.segments[i].bounce });
      unknown.push_back(i);
    }
  }
  std::vector<Ray> derived(stored.size());
  shooter.raysOf(stored.data(), stored.size(), derived.data());
  std::vector<Ray> rays[2]; // without and with a known static hit
  std::vector<Hit> hits[2];
  std::vector<std::size_t> which[2];
  for (std::size_t k = 0; k < unknown.size(); ++k)
  {
    const std::size_t i = unknown[k];
    StaleSegment& segment = batch.segments[i];
    const std::uint32_t walk = segment.walkInBlock;
    const WalkBlock& block = *stored[k].block;
    segment.ray = derived[k];
    segment.old = block.hit(walk, segment.bounce);
    const bool wasDynamic = segment.old.id.isDynamic();
    segment.wasTouching = block.isContact(walk, segment.bounce) ||
      shooter.isContact(segment.ray.start, segment.old.id) || shooter.hasContact(segment.old.id);
    if (segment.old && !wasDynamic && !segment.wasTouching)
    {
      segment.old.distance = scene.distanceTo(segment.ray, segment.old.id);
    }
    const Hit* staticHit = segment.wasTouching ? nullptr
      : wasDynamic                             ? block.hiddenStaticHit(walk, segment.bounce)
                                               : &segment.old;
    rays[staticHit != nullptr].push_back(segment.ray);
    hits[staticHit != nullptr].push_back(staticHit ? *staticHit : Hit{});
    which[staticHit != nullptr].push_back(i);
  }
  scene.cast(rays[0].data(), rays[0].size(), hits[0].data());
  scene.castDynamic(rays[1].data(), rays[1].size(), hits[1].data());
  for (const int isStaticHitKnown : { 0, 1 })
  {
    for (std::size_t i = 0; i < which[isStaticHitKnown].size(); ++i)
    {
      StaleSegment& segment = batch.segments[which[isStaticHitKnown][i]];
      segment.hit = shooter.settled(segment.ray, hits[isStaticHitKnown][i]);
    }
  }
}

void BudgetedRepair::finish(Batch& batch)
{
  std::vector<Deposit> stale;
  for (std::size_t i = 0; i < batch.items.size(); ++i)
  {
    const Batch::Item& item = batch.items[i];
    const StaleSegment& segment = batch.segments[i];
    WalkBlock& block = state_.history[item.block];
    batch.tally.remove(block, segment.walkInBlock, item.walk, segment.bounce);
    state_.stale.repair(item.block, block, *item.mark, stale);
    block.updateStaticHit(segment.walkInBlock, segment.bounce, segment.old, segment.hit,
      state_.cacheStaticHits && !segment.wasTouching);
  }
  state_.stale.take(stale);
  batch.walks.store(state_.plan, state_.history);
  state_.balance.add(batch.balance);
  segments_ += batch.walks.numberOfSegments();
}

}
