#include "BudgetedRepair.h"

#include "WalkBatch.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

namespace irradiance
{

/// Walks that are shot side by side, and what they bring until it is sure that they get done.
struct BudgetedRepair::Batch
{
  struct Item
  {
    std::size_t block;
    StaleMark* mark;
  };

  explicit Batch(const State& state)
    : booking(state.sums, balance)
    , walks(state.shooter)
  {
  }

  std::vector<Item> items;
  std::vector<StaleSegment> segments; ///< of the items
  PowerBalance balance;
  WalkBooking booking;
  WalkBatch walks;
  double seconds = 0; ///< spent on it
  bool isFirst = false;
};

std::int64_t BudgetedRepair::run(double progressFrom, Execution& execution, PowerBalance& balance)
{
  const auto classes = effects();
  std::size_t all = 0, done = 0;
  for (const auto& [effect, count] : classes)
  {
    all += count;
  }
  const auto progress = [&](std::size_t count) {
    return progressFrom +
      (1 - progressFrom) * static_cast<double>(count) / static_cast<double>(all);
  };
  for (const auto& [effect, count] : classes)
  {
    if (isOver())
    {
      break;
    }
    std::vector<Unit> parts = units();
    SlicedPass pass{ progress(done), progress(done + count), parts.size(), {} };
    pass.work = [&, effect = effect](std::size_t i, const Deadline& deadline,
                  PowerBalance& booked) { return work(parts[i], effect, deadline, booked); };
    pass.run(execution, balance);
    done += count;
  }
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    state_.stale.forgetRepaired(block);
  }
  return segments_;
}

std::vector<std::pair<std::uint16_t, std::size_t>> BudgetedRepair::effects() const
{
  std::map<std::uint16_t, std::size_t, std::greater<>> counts;
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    for (const StaleMark& mark : std::as_const(state_.stale).marks(block))
    {
      ++counts[mark.effect];
    }
  }
  return { counts.begin(), counts.end() };
}

std::vector<BudgetedRepair::Unit> BudgetedRepair::units() const
{
  // As few blocks as leave enough units for all threads, as a block has few stale walks.
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

bool BudgetedRepair::work(
  Unit& unit, std::uint16_t effect, const Deadline& deadline, PowerBalance& balance)
{
  while (unit.open || (unit.open = begin(unit, effect)))
  {
    Batch& batch = *unit.open;
    const auto isTooLate = [&] { return !batch.isFirst && time_.hasEnded(); };
    const double start = time_.now();
    const bool isDone =
      batch.walks.run(batch.booking, [&] { return deadline.hasPassed() || isTooLate(); });
    if (isDone)
    {
      finish(batch, balance);
    }
    batch.seconds += time_.now() - start;
    if (!isDone && !isTooLate())
    {
      return false;
    }
    isDone ? time_.spend(batch.seconds, batch.items.size()) : batch.booking.discard();
    unit.open.reset();
    if (deadline.hasPassed())
    {
      return false;
    }
  }
  return true;
}

std::shared_ptr<BudgetedRepair::Batch> BudgetedRepair::begin(Unit& unit, std::uint16_t effect)
{
  constexpr std::size_t kTogether = 512, kFirst = 16;
  const double start = time_.now();
  const std::size_t count = hasBegun_ ? time_.itemsToBegin(kTogether) : kFirst;
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
      if (marks[unit.mark].effect == effect)
      {
        batch->items.push_back({ unit.block, &marks[unit.mark] });
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

/// A hit that the verification of an earlier frame found may have changed since: it is cast anew.
void BudgetedRepair::fill(Batch& batch) const
{
  std::vector<Ray> rays;
  std::vector<std::size_t> unknown;
  const Scene& scene = state_.shooter.scene();
  for (const Batch::Item& item : batch.items)
  {
    const std::uint32_t walk = item.mark->walkInBlock, bounce = item.mark->bounce;
    if (!state_.found.empty())
    {
      const std::vector<StaleSegment>& found = state_.found[item.block];
      const auto known = std::lower_bound(found.begin(), found.end(), walk,
        [](const StaleSegment& segment, std::uint32_t w) { return segment.walkInBlock < w; });
      if (known != found.end() && known->walkInBlock == walk)
      {
        batch.segments.push_back(*known);
        continue;
      }
    }
    const WalkBlock& block = state_.history[item.block];
    const auto first = static_cast<std::uint32_t>(item.block * WalkBlock::kWalks);
    const Ray ray = state_.shooter.rayOf(block, walk, first + walk, bounce);
    Hit old = block.hit(walk, bounce);
    if (old && old.id.object == 0)
    {
      old.distance = scene.distanceTo(ray, old.id);
    }
    unknown.push_back(batch.segments.size());
    batch.segments.push_back({ walk, bounce, ray, {}, old });
    rays.push_back(ray);
  }
  std::vector<Hit> hits(rays.size());
  scene.cast(rays.data(), rays.size(), hits.data());
  for (std::size_t i = 0; i < unknown.size(); ++i)
  {
    batch.segments[unknown[i]].hit = hits[i];
  }
  for (std::size_t i = 0; i < batch.items.size(); ++i)
  {
    const WalkBlock& block = state_.history[batch.items[i].block];
    const StaleSegment& segment = batch.segments[i];
    const auto first = static_cast<std::uint32_t>(batch.items[i].block * WalkBlock::kWalks);
    batch.walks.resume(first + segment.walkInBlock, segment.bounce, segment.ray, segment.hit,
      block.power(segment.walkInBlock, 0), block.power(segment.walkInBlock, segment.bounce));
  }
}

void BudgetedRepair::finish(Batch& batch, PowerBalance& balance)
{
  std::vector<Deposit> stale;
  for (std::size_t i = 0; i < batch.items.size(); ++i)
  {
    const Batch::Item& item = batch.items[i];
    const StaleSegment& segment = batch.segments[i];
    WalkBlock& block = state_.history[item.block];
    batch.booking.remove(block, segment.walkInBlock, segment.bounce);
    state_.stale.repair(item.block, block, *item.mark, stale);
    block.updateStaticHit(
      segment.walkInBlock, segment.bounce, segment.old, segment.hit, state_.cacheStaticHits);
  }
  state_.stale.take(stale);
  batch.walks.store(state_.history);
  balance += batch.balance;
  segments_ += static_cast<std::int64_t>(batch.walks.pieces().size());
}

}
