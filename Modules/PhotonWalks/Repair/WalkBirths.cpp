// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/WalkBirths.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

std::vector<std::uint32_t> WalkBirths::shoot(
  const std::vector<std::uint32_t>& walks, TimeBudget* budget, Execution& execution)
{
  std::vector<Unit> units = unitsOf(walks);
  runSliced(units.size(), execution, [&](std::size_t unit, const auto& hasToStop) {
    return work(units[unit], walks, budget, hasToStop);
  });
  std::vector<std::uint32_t> shot;
  for (const Unit& unit : units)
  {
    const auto at = [&](std::size_t i) { return walks.begin() + static_cast<std::ptrdiff_t>(i); };
    shot.insert(shot.end(), at(unit.first), at(unit.next));
  }
  return shot;
}

/// A block is one thread's. Walks of several are shot together, as long as that leaves
/// enough units for all threads.
std::vector<WalkBirths::Unit> WalkBirths::unitsOf(const std::vector<std::uint32_t>& walks) const
{
  constexpr std::size_t kUnits = 32;
  const std::size_t together =
    std::clamp<std::size_t>(walks.size() / kUnits, 256, WalkFront::kUsualSize);
  std::vector<Unit> units;
  std::size_t last = 0;
  for (std::size_t i = 0; i < walks.size(); ++i)
  {
    const std::size_t place = state_.history.indexOf(walks[i]);
    if (units.empty() || (place != last && i - units.back().first >= together))
    {
      units.push_back({ i, i, i, nullptr });
    }
    units.back().end = i + 1;
    last = place;
  }
  return units;
}

bool WalkBirths::work(Unit& unit, const std::vector<std::uint32_t>& walks, TimeBudget* budget,
  const std::function<bool()>& hasToStop)
{
  const auto now = [&] { return budget ? budget->now() : 0; }; // without a budget no clock is read
  while (true)
  {
    const double start = now();
    const bool isNew = !unit.open;
    if (isNew && !begin(unit, walks, budget))
    {
      return true;
    }
    const bool isDone = run(unit, isNew, hasToStop);
    unit.seconds += now() - start;
    if (isDone)
    {
      segments_ += unit.open->numberOfSegments();
      state_.pool.giveBack(std::move(unit.open));
      if (budget)
      {
        budget->spend(std::exchange(unit.seconds, 0), unit.begun);
      }
    }
    if (!isDone || hasToStop())
    {
      return isDone && unit.next == unit.end;
    }
  }
}

bool WalkBirths::begin(Unit& unit, const std::vector<std::uint32_t>& walks, TimeBudget* budget)
{
  constexpr std::size_t kFirst = 16, kWithBudget = 512;
  const std::size_t left = unit.end - unit.next;
  const std::size_t most = std::min(left, budget ? kWithBudget : WalkFront::kUsualSize);
  unit.begun = !budget ? most : hasBegun_ ? budget->itemsToBegin(most) : std::min(most, kFirst);
  if (left == 0 || unit.begun == 0)
  {
    return false;
  }
  hasBegun_ = true;
  unit.open = state_.pool.take();
  unit.open->begin(state_.tracer, &state_.history);
  WalkFront& front = unit.open->front();
  front.reserve(unit.begun, state_.tracer.stages().bands());
  front.size = unit.begun;
  for (std::size_t i = 0; i < unit.begun; ++i)
  {
    front.walk[i] = walks[unit.next + i];
    front.block[i] = static_cast<std::uint32_t>(state_.history.indexOf(front.walk[i]));
  }
  unit.next += unit.begun;
  return true;
}

bool WalkBirths::run(Unit& unit, bool isNew, const std::function<bool()>& hasToStop)
{
  PowerBalance balance;
  bool isDone = true;
  {
    FrontTally tally(state_.tracer.triangles(), state_.sums, balance, state_.tracer.powerPerWalk(),
      4 * unit.begun);
    if (isNew)
    {
      unit.open->start(tally);
    }
    isDone = unit.open->run(tally, hasToStop);
  }
  addLocked(balance, state_.balance, mutex_);
  return isDone;
}

}
