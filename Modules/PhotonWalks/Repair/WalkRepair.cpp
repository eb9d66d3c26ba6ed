// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkRepair.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace irradiance
{

namespace
{

constexpr std::size_t kUnits = 32; // at least, if there are as many marked walks; for all threads
constexpr std::size_t kBatchSize = 512;

/// A pass over all blocks: work(first, end, unit, hasToStop) on those of a unit.
template <class Work>
void passOver(const WalkHistory& history, Execution& execution, const Work& work)
{
  constexpr std::size_t kBlocks = 32; // verified and repaired together
  const std::size_t all = history.size();
  runSliced((all + kBlocks - 1) / kBlocks, execution, [&](std::size_t unit, const auto& hasToStop) {
    return work(unit * kBlocks, std::min((unit + 1) * kBlocks, all), unit, hasToStop);
  });
}

}

/// Walks of consecutive blocks, on which one thread at a time works.
struct WalkRepair::Unit
{
  std::vector<StaleMark*> marks;       ///< of stale walks, ordered by walk
  const std::uint32_t* born = nullptr; ///< or walks that are to be born, in order
  std::size_t next = 0, end = 0;       ///< which of these are left
  std::unique_ptr<RepairWork> open;
  std::size_t begun = 0; ///< walks of what is open
  double seconds = 0;    ///< spent on it
};

void WalkRepair::verifyAndRepair(Execution& execution)
{
  std::vector<std::unique_ptr<RepairWork>> open(state_.history.size()); // by unit
  passOver(state_.history, execution,
    [&](std::size_t first, std::size_t end, std::size_t unit, const auto& hasToStop) {
      if (!open[unit])
      {
        open[unit] = take();
        const double start = steadySeconds();
        state_.verifier.find(first, end, {}, open[unit]->verifier, open[unit]->batch.front());
        const double seconds = steadySeconds() - start;
        const std::lock_guard<std::mutex> lock(mutex_);
        figures_.verifySeconds += seconds;
      }
      const double start = steadySeconds();
      const bool isDone = shoot(*open[unit], hasToStop);
      if (isDone)
      {
        finish(open[unit]);
      }
      const std::lock_guard<std::mutex> lock(mutex_);
      figures_.repairSeconds += steadySeconds() - start;
      return isDone;
    });
}

void WalkRepair::verifyAndMark(StaleWalks& stale, Execution& execution)
{
  std::vector<const StaleMarks*> known;
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    known.push_back(&stale.marks(block));
  }
  passOver(
    state_.history, execution, [&](std::size_t first, std::size_t end, std::size_t, const auto&) {
      std::unique_ptr<RepairWork> work = take();
      state_.verifier.find(first, end, known, work->verifier, work->batch.front());
      const WalkFront& rows = work->batch.front();
      for (std::size_t row = 0, next = 0; row < rows.size; row = next)
      {
        work->firsts.clear();
        for (next = row; next < rows.size && rows.block[next] == rows.block[row]; ++next)
        {
          work->firsts.push_back({ rows.walk[next], rows.bounce[next] });
        }
        std::sort(work->firsts.begin(), work->firsts.end());
        stale.add(rows.block[row], state_.history, work->firsts);
      }
      state_.pool.giveBack(std::move(work));
      return true;
    });
}

void WalkRepair::repair(StaleWalks& stale, TimeBudget* budget, Execution& execution)
{
  // Each class is large enough to fill the batches of all threads. If there is time for all, so is
  // the only one.
  constexpr std::size_t kForAUnit = 128;
  const std::size_t enough = kForAUnit * std::min(kUnits, state_.history.size());
  const auto classes = stale.classes(budget ? enough : std::numeric_limits<std::size_t>::max());
  hasBegun_ = false;
  double all = 0, done = 0;
  for (const auto& [weakest, walks] : classes)
  {
    all += static_cast<double>(walks);
  }
  for (const auto& [weakest, walks] : classes)
  {
    if (hasBegun_ && budget && budget->itemsToBegin(1) == 0)
    {
      break;
    }
    std::vector<Unit> parts = unitsOf(stale, weakest, walks);
    const double from = done / all;
    done += static_cast<double>(walks);
    ProgressSpan span(execution, from, done / all);
    runSliced(parts.size(), span, [&](std::size_t i, const auto& hasToStop) {
      return work(parts[i], &stale, budget, hasToStop);
    });
  }
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    stale.forgetRepaired(block);
  }
}

std::vector<std::uint32_t> WalkRepair::shootBorn(
  const std::vector<std::uint32_t>& walks, TimeBudget* budget, Execution& execution)
{
  hasBegun_ = false;
  std::vector<Unit> units = unitsOf(walks);
  runSliced(units.size(), execution, [&](std::size_t i, const auto& hasToStop) {
    return work(units[i], nullptr, budget, hasToStop);
  });
  std::vector<std::uint32_t> left;
  for (const Unit& unit : units)
  {
    left.insert(left.end(), unit.born + unit.next, unit.born + unit.end);
  }
  return left;
}

/// A block is one thread's; see below.
std::vector<WalkRepair::Unit> WalkRepair::unitsOf(const std::vector<std::uint32_t>& walks) const
{
  const std::size_t together =
    std::clamp<std::size_t>(walks.size() / kUnits, 256, WalkFront::kUsualSize);
  std::vector<Unit> units;
  std::size_t last = 0;
  for (const std::uint32_t& walk : walks)
  {
    const std::size_t block = state_.history.indexOf(walk);
    if (units.empty() || (block != last && units.back().end >= together))
    {
      units.emplace_back();
      units.back().born = &walk;
    }
    ++units.back().end;
    last = block;
  }
  return units;
}

/// A block has few stale walks. So walks of several blocks are shot together, as long as that
/// leaves enough units for all threads.
std::vector<WalkRepair::Unit> WalkRepair::unitsOf(
  StaleWalks& stale, std::uint16_t weakest, std::size_t walks) const
{
  const std::size_t together = std::max<std::size_t>(std::min(walks / kUnits, kBatchSize), 1);
  std::vector<Unit> units;
  for (std::size_t block = 0; block < state_.history.size(); ++block)
  {
    if (units.empty() || units.back().marks.size() >= together)
    {
      units.emplace_back();
    }
    for (StaleMark& mark : stale.marks(block))
    {
      if (mark.powerClass >= weakest) // no stronger class is left
      {
        units.back().marks.push_back(&mark);
        ++units.back().end;
      }
    }
  }
  return units;
}

bool WalkRepair::work(
  Unit& unit, StaleWalks* stale, TimeBudget* budget, const std::function<bool()>& hasToStop)
{
  const auto now = [&] { return budget ? budget->now() : 0; }; // without a budget no clock is read
  while (unit.open || (unit.open = begin(unit, stale, budget)))
  {
    const double start = now();
    const bool isDone = shoot(*unit.open, hasToStop);
    if (isDone)
    {
      finish(unit.open);
    }
    unit.seconds += now() - start;
    if (!isDone)
    {
      return false;
    }
    if (budget)
    {
      budget->spend(unit.seconds, unit.begun);
    }
    if (hasToStop())
    {
      return false;
    }
  }
  return true;
}

std::unique_ptr<RepairWork> WalkRepair::begin(Unit& unit, StaleWalks* stale, TimeBudget* budget)
{
  constexpr std::size_t kFirst = 16;
  const std::size_t most = stale || budget ? kBatchSize : WalkFront::kUsualSize;
  const std::size_t left = std::min(unit.end - unit.next, most);
  if (left == 0)
  {
    return nullptr;
  }
  const double start = budget ? budget->now() : 0;
  unit.begun = !budget ? left : hasBegun_ ? budget->itemsToBegin(left) : std::min(left, kFirst);
  if (unit.begun == 0)
  {
    return nullptr;
  }
  hasBegun_ = true;
  std::unique_ptr<RepairWork> work = take();
  stale ? addMarked(unit, *stale, *work) : addBorn(unit, *work);
  unit.next += unit.begun;
  unit.seconds = budget ? budget->now() - start : 0;
  return work;
}

void WalkRepair::addMarked(const Unit& unit, StaleWalks& stale, RepairWork& work)
{
  std::vector<SegmentPlace> places;
  std::vector<Deposit> deposits;
  for (std::size_t i = unit.next; i < unit.next + unit.begun; ++i)
  {
    places.push_back(state_.history.placeOf(unit.marks[i]->first()));
    stale.repair(state_.history, *unit.marks[i], deposits);
  }
  stale.take(deposits);
  state_.verifier.castAgain(places, stale.mayMeetOthers(), work.verifier, work.batch.front());
}

void WalkRepair::addBorn(const Unit& unit, RepairWork& work) const
{
  work.areBorn = true;
  WalkFront& front = work.batch.front();
  front.reserve(unit.begun, state_.history.bands());
  front.size = unit.begun;
  for (std::size_t i = 0; i < unit.begun; ++i)
  {
    front.walk[i] = unit.born[unit.next + i];
    front.block[i] = static_cast<std::uint32_t>(state_.history.indexOf(front.walk[i]));
    work.firsts.push_back({ front.walk[i], 0 });
  }
}

void WalkRepair::removeOld(RepairWork& work, FrontTally& tally)
{
  constexpr std::size_t kAhead = 12;
  WalkFront& rows = work.batch.front();
  const int bands = state_.history.bands();
  Power starting;
  work.old.size = 0;
  for (std::size_t row = 0; row < rows.size; ++row)
  {
    // First the links to the segments after, then these.
    if (row + 2 * kAhead < rows.size)
    {
      const std::size_t soon = row + 2 * kAhead;
      state_.history.block(rows.block[soon]).prefetch(rows.slot[soon]);
    }
    if (row + kAhead < rows.size)
    {
      const BounceBlock& block = state_.history.block(rows.block[row + kAhead]);
      const std::uint32_t after = block.next(rows.slot[row + kAhead]);
      if (after != BounceBlock::kNone)
      {
        block.prefetch(after);
      }
    }
    const SegmentPlace place{ rows.block[row], rows.slot[row] };
    const SegmentRef first{ rows.walk[row], rows.bounce[row] };
    const Power carried = state_.history.power(place);
    if (bands > 1)
    {
      rows.setPower(row, bands, carried);
    }
    starting += carried;
    if (state_.changes || state_.tails)
    {
      work.firsts.push_back(first);
    }
    if (state_.changes)
    {
      state_.history.forEachPhotonFrom(
        place, first, [&](const Photon& photon) { work.changes.gone.push_back(photon); });
    }
    const BounceBlock& block = state_.history.block(place.block);
    state_.history.removeFrom(
      place, [&](std::uint32_t slot) { addStored(block, slot, bands, work.old); });
  }
  tally.remove(work.old, starting);
}

bool WalkRepair::shoot(RepairWork& work, const std::function<bool()>& hasToStop)
{
  PowerBalance balance;
  bool isDone = true;
  {
    constexpr std::size_t kUsualTail = 8; // photons that go and come
    FrontTally tally(state_.tracer.triangles(), state_.sums, balance, state_.tracer.powerPerWalk(),
      kUsualTail * work.batch.front().size);
    if (const bool isFirst = !std::exchange(work.hasBegun, true); isFirst && work.areBorn)
    {
      work.batch.start(tally);
    }
    else if (isFirst)
    {
      removeOld(work, tally);
      work.batch.resume(state_.changes || !work.verifier.hidden.empty());
    }
    isDone = work.batch.run(tally, hasToStop);
  }
  addLocked(balance, state_.balance, mutex_);
  return isDone;
}

}
