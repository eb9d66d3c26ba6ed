// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BudgetedRepair_h
#define irradiance_BudgetedRepair_h

#include "Execution/SlicedPass.h"
#include "Execution/TimeBudget.h"
#include "Repair/StaleWalks.h"
#include "Tally/PowerBalance.h"

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

namespace irradiance
{

/**
 * Shoots stale walks again until the time is up, those first whose stale segments carry most power.
 * A walk is repaired completely or not at all: what is half done at the end is dropped. The first
 * few walks are always finished, however small the budget, so that enough calls repair all.
 */
class BudgetedRepair
{
public:
  /// What it works on.
  struct State
  {
    const WalkShooter& shooter;
    const WalkPlan& plan;
    std::vector<WalkBlock>& history;
    const UnitFrame& frame; ///< of the history
    CellSums& sums;
    SharedBalance& balance;
    StaleWalks& stale;
    /// By block, what the verification of this frame found, with the new hits. May be empty.
    const std::vector<std::vector<StaleSegment>>& found;
    bool cacheStaticHits;
  };

  /// The budget of `seconds`, which may be infinite, begins now.
  BudgetedRepair(const State& state, const Execution& execution, double seconds)
    : state_(state)
    , time_(execution, seconds)
  {
  }

  /// Returns the number of segments that were shot. Throws Interrupted.
  std::int64_t run(Execution& execution);
  /// Seconds since the beginning, by the clock of the budget.
  double seconds() const { return time_.elapsed(); }

private:
  struct Batch;
  /// Consecutive blocks, on which one thread at a time works.
  struct Unit
  {
    std::size_t block, endBlock;
    std::size_t mark = 0;
    std::shared_ptr<Batch> open;
  };

  /// Walks of similar effect that are repaired before weaker ones.
  struct Class
  {
    std::uint16_t weakest;
    std::size_t size;
  };
  /// The strongest first. Each is large enough to fill batches; if there is time for all, all are
  /// in one class.
  std::vector<Class> classes() const;
  std::vector<Unit> units() const;
  bool isOver() const { return hasBegun_ && time_.itemsToBegin(1) == 0; }
  bool work(Unit& unit, std::uint16_t weakest, const Deadline& deadline);
  /// The next walks of a unit; null if there are none or the time is up.
  std::shared_ptr<Batch> begin(Unit& unit, std::uint16_t weakest);
  void fill(Batch& batch) const;
  /// Null if the walk was marked in an earlier frame.
  const StaleSegment* foundNow(std::size_t block, std::uint32_t walk) const;
  void castAnew(Batch& batch) const;
  void finish(Batch& batch);

  State state_;
  TimeBudget time_;
  std::atomic<bool> hasBegun_{ false };
  std::atomic<std::int64_t> segments_{ 0 };
};

}

#endif
