// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkRepair_h
#define irradiance_WalkRepair_h

#include "Execution/SlicedPass.h"
#include "Execution/TimeBudget.h"
#include "History/WalkHistory.h"
#include "Repair/StaleWalks.h"
#include "Tally/PowerBalance.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace irradiance
{

/**
 * Shoots stale walks again from their first stale segment on; walks of several blocks side by side.
 *
 * With a budget of time those come first whose stale segments carry most power. A walk is repaired
 * completely or not at all: what is half done at the end is dropped. The first few walks are always
 * finished, however small the budget, so that enough calls repair all.
 */
class WalkRepair
{
public:
  /// What it works on. Must outlive it.
  struct State
  {
    const WalkTracer& tracer;
    WalkHistory& history;
    CellSums& sums;
    PowerBalance& balance;
    bool cacheStaticHits;
    bool storesSides; ///< see WalkBatch
    /// By block, what the verification of this frame found. May be empty if nothing moved.
    const std::vector<std::vector<StaleSegment>>& found;
    StaleWalks* stale;  ///< the walks to repair; null: those in `found`
    TimeBudget* budget; ///< null: time for all; else `stale` is given
    PhotonChanges* changes =
      nullptr; ///< receives the photons that go and come; null: not asked for
    /// Receives the first segment of each tail that was shot, by walk; null: likewise.
    std::vector<SegmentRef>* tails = nullptr;
  };

  explicit WalkRepair(const State& state)
    : state_(state)
    , balance_(state.balance)
  {
  }

  /// Returns the number of segments that were shot. Throws Interrupted.
  std::int64_t run(Execution& execution);

private:
  struct Item;
  struct Batch;
  struct Unit;

  std::vector<PowerClass> classes() const;
  std::vector<Unit> units(const PowerClass& like) const;
  void addItems(std::size_t block, std::uint16_t weakest, std::vector<Item>& items) const;
  bool work(Unit& unit, const Deadline& deadline);
  /// The next walks of a unit; null if there are none or the time is up.
  std::unique_ptr<Batch> begin(Unit& unit);
  void fill(Batch& batch) const;
  void prefetch(const Item& item) const;
  void findSegments(Batch& batch) const;
  /// Null if the walk was marked in an earlier frame.
  const StaleSegment* foundNow(const Item& item) const;
  void finish(Batch& batch);
  void listTails(const Batch& batch);
  /// Appends the photons of the tails that the batch replaces.
  void collectTails(const Batch& batch, std::vector<Photon>& photons) const;

  // Without a budget no clock is read.
  double now() const { return state_.budget ? state_.budget->now() : 0; }
  bool hasEnded() const { return state_.budget && state_.budget->hasEnded(); }

  State state_;
  SharedBalance balance_;
  std::atomic<bool> hasBegun_{ false };
  std::atomic<std::int64_t> segments_{ 0 };
  std::mutex changesMutex_;
};

}

#endif
