// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "Repair/StaleWalks.h"
#include "Repair/WalkVerifier.h"
#include "Shooting/WalkBatch.h"
#include "Tally/PowerBalance.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

namespace irradiance
{

/// What a thread needs to find stale walks and to shoot them again, or others for the first time.
struct RepairWork
{
  WalkBatch batch; ///< its front: first stale segments, then the tails that are shot
  WalkVerifier::Memory verifier;
  WalkFront old;                  ///< segments that are taken back
  std::vector<SegmentRef> firsts; ///< of the tails that are shot
  PhotonChanges changes;
  bool areBorn = false;  ///< the walks of the front start
  bool hasBegun = false; ///< they have, or the old tails are removed
};

/**
 * Shoots stale walks again from their first stale segment on, walks of several blocks side by side:
 * those that a motion changed, in one pass with their verification; or those that were marked. And
 * walks that start where direct light arrives since a motion.
 *
 * With a budget of time those marked come first whose stale segments carry most power. A walk is
 * repaired completely or not at all: what a thread has begun it finishes, some hundred walks. The
 * first few are always begun, however small the budget, so that enough calls repair all.
 */
class WalkRepair
{
public:
  /// What it works on. Must outlive it.
  struct State
  {
    const WalkTracer& tracer;
    const WalkVerifier& verifier;
    WalkHistory& history;
    CellSums& sums;
    PowerBalance& balance;
    Pool<RepairWork>& pool;
    PhotonChanges* changes; ///< receives the photons that go and come; null: not asked for
    /// Receives the first segment of each tail that was shot, in any order; null: likewise.
    std::vector<SegmentRef>* tails;
  };
  /// What was done.
  struct Figures
  {
    std::int64_t repairedSegments = 0;
    double verifySeconds = 0, repairSeconds = 0; ///< of all threads
  };

  explicit WalkRepair(const State& state)
    : state_(state)
  {
  }

  // Each throws Interrupted.
  /// Verifies all walks and repairs those that are stale.
  void verifyAndRepair(Execution& execution);
  /// Verifies all walks and marks those that are stale.
  void verifyAndMark(StaleWalks& stale, Execution& execution);
  /// Shoots walks that are not stored yet, which are ordered by number; returns those that are left.
  /// `budget`: null: there is time for all.
  std::vector<std::uint32_t> shootBorn(
    const std::vector<std::uint32_t>& walks, TimeBudget* budget, Execution& execution);
  /// Repairs marked walks.
  void repair(StaleWalks& stale, TimeBudget* budget, Execution& execution);

  const Figures& figures() const { return figures_; }

private:
  struct Unit;

  std::vector<Unit> unitsOf(StaleWalks& stale, std::uint16_t weakest, std::size_t walks) const;
  std::vector<Unit> unitsOf(const std::vector<std::uint32_t>& walks) const;
  /// `stale`: of marked walks; null: they are to be born.
  bool work(
    Unit& unit, StaleWalks* stale, TimeBudget* budget, const std::function<bool()>& hasToStop);
  /// The next walks of a unit; null if there are none or the time is up.
  std::unique_ptr<RepairWork> begin(Unit& unit, StaleWalks* stale, TimeBudget* budget);
  void addMarked(const Unit& unit, StaleWalks& stale, RepairWork& work);
  void addBorn(const Unit& unit, RepairWork& work) const;

  std::unique_ptr<RepairWork> take()
  {
    std::unique_ptr<RepairWork> work = state_.pool.take();
    work->batch.begin(state_.tracer, &state_.history);
    work->verifier.hidden.clear();
    work->firsts.clear();
    work->changes.gone.clear();
    work->changes.arrived.clear();
    work->areBorn = work->hasBegun = false;
    return work;
  }
  /// Removes the old tails of the front.
  void removeOld(RepairWork& work, FrontTally& tally);
  /// Shoots the new ones; returns whether they are done.
  bool shoot(RepairWork& work, const std::function<bool()>& hasToStop);
  void finish(std::unique_ptr<RepairWork>& work)
  {
    const std::vector<SegmentPlace>& places = work->batch.places();
    for (std::size_t i = 0; i < work->verifier.hidden.size(); ++i)
    {
      if (work->verifier.hidden[i].isKnown())
      {
        state_.history.setHidden(places[i], work->verifier.hidden[i]);
      }
    }
    for (std::size_t i = 0; state_.changes && i < places.size(); ++i)
    {
      state_.history.forEachPhotonFrom(places[i], work->firsts[i],
        [&](const Photon& photon) { work->changes.arrived.push_back(photon); });
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      figures_.repairedSegments += work->batch.numberOfSegments();
      if (state_.changes)
      {
        state_.changes->add(work->changes);
      }
      if (state_.tails)
      {
        state_.tails->insert(state_.tails->end(), work->firsts.begin(), work->firsts.end());
      }
    }
    state_.pool.giveBack(std::move(work));
  }

  State state_;
  std::atomic<bool> hasBegun_{ false };
  std::mutex mutex_;
  Figures figures_;
};

}
