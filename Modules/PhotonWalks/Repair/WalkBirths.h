// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkBirths_h
#define irradiance_WalkBirths_h

#include "Execution/Execution.h"
#include "Shooting/WalkBatch.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * Shoots walks that start where direct light arrives since a motion, into the history of those that
 * started before. With a budget of time some may be left for later; what a thread has begun it
 * finishes, and the first few are always begun.
 */
class WalkBirths
{
public:
  /// What it works on. Must outlive it.
  struct State
  {
    const WalkTracer& tracer;
    WalkHistory& history;
    CellSums& sums;
    PowerBalance& balance;
    Pool<WalkBatch>& pool;
  };

  explicit WalkBirths(const State& state)
    : state_(state)
  {
  }

  /// Shoots walks, which are ordered by number. Returns which were shot, in order. `budget`: null:
  /// there is time for all. Throws Interrupted.
  std::vector<std::uint32_t> shoot(
    const std::vector<std::uint32_t>& walks, TimeBudget* budget, Execution& execution);

  std::int64_t numberOfSegments() const { return segments_; }

private:
  /// Walks [next, end) of consecutive blocks, on which one thread at a time works.
  struct Unit
  {
    std::size_t first, next, end;
    std::unique_ptr<WalkBatch> open;
    std::size_t begun = 0; ///< walks of the open batch
    double seconds = 0;    ///< that they took so far
  };

  std::vector<Unit> unitsOf(const std::vector<std::uint32_t>& walks) const;
  bool work(Unit& unit, const std::vector<std::uint32_t>& walks, TimeBudget* budget,
    const std::function<bool()>& hasToStop);
  /// Puts the next walks of a unit into a batch; false if there are none or the time is up.
  bool begin(Unit& unit, const std::vector<std::uint32_t>& walks, TimeBudget* budget);
  /// Returns whether they have ended.
  bool run(Unit& unit, bool isNew, const std::function<bool()>& hasToStop);

  State state_;
  std::mutex mutex_; ///< of the balance
  std::atomic<bool> hasBegun_{ false };
  std::atomic<std::int64_t> segments_{ 0 };
};

}

#endif
