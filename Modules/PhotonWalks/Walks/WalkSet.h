// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "History/WalkHistory.h"
#include "Repair/StaleWalks.h"
#include "Repair/WalkRepair.h"
#include "Surfaces/Frame.h"
#include "Tally/CellSums.h"
#include "Tally/PowerBalance.h"
#include "Walks/WalkSource.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace irradiance
{

/// How many walks are shot, and what is kept of them.
struct WalkSettings
{
  std::uint32_t numberOfWalks = 1000000;
  std::uint64_t seed = 1;
  bool verify = true; ///< false: all walks of every frame are shot again
  bool cacheStaticHits = false;
  /// Whether cells gather the light that comes straight from the lights, and walks start where it
  /// arrived; else walks start at the lights.
  bool gathersDirectLight = false;
  FewestSamples fewestSamples; ///< with which cells gather it
  /// Whether walks are stored even if nothing can move, for filters that need their photons.
  bool keepPhotons = false;
  /// Whether each rank shoots and keeps all walks, for filters that read their photons there; else
  /// the ranks share them.
  bool allOnEachRank = false;
  bool listRepaired = false;    ///< whether it is noted which walks a repair shoots again
  std::uint32_t replicates = 1; ///< independent; with 2 or more, standard errors are known
  /// Relative half-width of the 95 % interval that 95 % of the area is to reach; 0: no target. The
  /// number of walks is doubled until then.
  double targetRelativeError = 0;
  std::uint32_t maximumNumberOfWalks = 10000000; ///< >= numberOfWalks; with a target
  /// Seconds for the repair of a frame; what is not repaired in time stays stale for the next call.
  /// 0: no limit.
  double repairTimeBudget = 0;
};

/// What the walks of a frame cost.
struct WalkStatistics
{
  std::int64_t suspectSegments = 0; ///< for which the verification cast a ray
  std::int64_t invalidWalks = 0;    ///< found by the verification, or started where no light is now
  std::int64_t repairedSegments = 0;
  std::int64_t shotWalks = 0; ///< with all their segments, other than in a repair
  double shootSeconds = 0;
  double verifySeconds = 0;
  double repairSeconds = 0;

  WalkStatistics& operator+=(const WalkStatistics& other)
  {
    suspectSegments += other.suspectSegments;
    invalidWalks += other.invalidWalks;
    repairedSegments += other.repairedSegments;
    shotWalks += other.shotWalks;
    shootSeconds += other.shootSeconds;
    verifySeconds += other.verifySeconds;
    repairSeconds += other.repairSeconds;
    return *this;
  }
};

/**
 * A population of walks that start at the same lights, each with the same power: where they start,
 * how many there are, what is stored of them, what they brought to the cells, and which of them are
 * stale.
 *
 * Walks are shot round by round. After a motion they are verified, and those that it changed are
 * shot again; then all is as if it had been shot in that frame, bit for bit.
 */
class WalkSet
{
public:
  /// Before the start.
  void setSource(WalkSource source)
  {
    gathered_.reset(); // it refers to the lights of before
    source_ = std::move(source);
  }
  /// For what is done next. Between two starts they may differ only in what is kept, and in the
  /// budget.
  void setSettings(const WalkSettings& settings)
  {
    if (settings_.cacheStaticHits && !settings.cacheStaticHits)
    {
      history_.forgetHiddenHits();
    }
    settings_ = settings;
    statistics_ = {};
  }
  /// Of time, for the next motion, s; > 0 if there is one in the settings.
  void setBudget(double seconds) { settings_.repairTimeBudget = seconds; }
  /// Forgets all walks. The next rounds are shot in this space; of each round this rank shoots its
  /// blocks.
  void start(const Frame& frame, Execution& execution);
  /// Shoots a round. With `isStored` the history holds all rounds before it.
  void shootRound(std::size_t round, bool isStored, const Frame& frame, Execution& execution)
  {
    const double start = steadySeconds();
    beginRound(isStored, frame, execution);
    statistics_.shootSeconds += steadySeconds() - start;
    shootBlocks(plan().rounds()[round], isStored, frame, execution);
  }
  /// Drops all but the first `kept` rounds.
  void dropRounds(std::size_t kept, const SceneTriangles& triangles, const CancelPoint& cancelPoint)
  {
    dropBlocks(blocks_.before(plan().rounds()[kept - 1].endBlock), triangles, cancelPoint);
    if (gathered_)
    {
      gathered_->drop(kept, totals(), cancelPoint);
    }
    sums_.setRounds(kept, cancelPoint);
  }
  /// Whether another source has only another number of walks, and those that both have may stay: all
  /// are stored, or there are more, and none is stale.
  bool isResizedBy(const WalkSource& source, bool areStored) const
  {
    // With several bands powers are rounded to quanta at each hit.
    const bool keepPower =
      history_.bands() == 1 || source.quantaPerWalk() == source_.quantaPerWalk();
    return source_.differsInNumber(source) && keepPower && !hasStale() &&
      (areStored || source.plan.most() > source_.plan.most());
  }
  /// After setSource() of such a source: drops the walks that it has not, and takes what is left for
  /// a part of it. What is missing then is for shootMissing().
  void resize(bool areStored, const SceneTriangles& triangles, const CancelPoint& cancelPoint);
  void shootMissing(bool areStored, const Frame& frame, Execution& execution)
  {
    shootBlocks(missing_, areStored, frame, execution);
  }
  /// Follows a change: verifies what is stored, if the frame has changed, and repairs what is stale,
  /// as far as the budget of time goes. `changes`: receives the photons that go and come; null: not
  /// asked for.
  void follow(const Frame& frame, PhotonChanges* changes, Execution& execution);
  /// Changes to objects of which some have other cells or triangles. No walk may be stale, or touch
  /// these, other than parts that are gone.
  void replaceCells(const Frame& frame, const CancelPoint& cancelPoint);
  /// Forgets that there was a budget if nothing is stale, and there is none now or the number of
  /// rounds has changed.
  void forgetBudget()
  {
    // All ranks agree on the rounds, but not on how many blocks they have.
    if (stale_ && stale_->isEmpty() && (!hasBudget() || staleRounds_ != sums_.rounds()))
    {
      stale_.reset();
    }
  }

  const WalkSource& source() const { return source_; }
  const LightTable& lights() const { return source_.lights; }
  /// Quanta with which a walk may start at most, in each band.
  Bands largestStart() const;
  /// Of the walks that are stored.
  const WalkPlan& plan() const { return gathered_ ? gathered_->plan() : source_.plan; }
  const WalkHistory& history() const { return history_; }
  /// Whether it has the walks that are this rank's: a part of them, or all.
  bool isOf(const Ranks& ranks, bool all) const { return blocks_ == dealt(ranks, all); }
  /// Whether other ranks have walks of it.
  bool isShared() const { return !(blocks_ == DealtBlocks()); }
  bool has(std::uint32_t walk) const
  {
    return isDealt(walk) && !std::binary_search(unborn_.begin(), unborn_.end(), walk);
  }
  /// What arrived in the cells themselves.
  const CellSums& sums() const { return sums_; }
  const PowerBalance& balance() const { return balance_; }
  /// What the budget left unrepaired; null without a budget, or before anything moved.
  const StaleWalks* stale() const { return stale_.get(); }
  bool hasStale() const { return stale_ && !stale_->isEmpty(); }
  /// The first segments of the tails that the last repair shot again, ordered by walk; empty after
  /// a start. Only if that repair was to list them.
  const std::vector<SegmentRef>& repaired() const { return repaired_; }
  /// What was done since the settings were made.
  const WalkStatistics& statistics() const { return statistics_; }
  /// Memory held.
  std::size_t bytes() const
  {
    std::size_t gathered = 0;
    forEachGathered([&](const DirectGather& light) { gathered += light.bytes(); });
    return (stale_ ? stale_->bytes() : 0) + repaired_.capacity() * sizeof(SegmentRef) +
      history_.bytes() + (gathered > 0 ? gathered + sums_.bytes() : 0);
  }

  /// Where walks start; null: at the lights.
  const DirectRounds* gathered() const { return gathered_.get(); }
  /// Calls visit(DirectGather) for each round of direct light that cells gathered.
  template <class Visit>
  void forEachGathered(const Visit& visit) const
  {
    for (std::size_t round = 0; gathered_ && round < gathered_->rounds().size(); ++round)
    {
      visit(*gathered_->rounds()[round]);
    }
  }

  SobolSequence samples() const { return SobolSequence(settings_.seed, plan().replicates()); }
  /// The arguments must outlive it.
  WalkTracer tracer(const Frame& frame, const SobolSequence& samples) const
  {
    return { frame.scene, frame.objects, frame.triangles, lights(), samples, &frame.contacts,
      gathered_.get() };
  }

private:
  static DealtBlocks dealt(const Ranks& ranks, bool all)
  {
    return all ? DealtBlocks() : DealtBlocks(ranks.rank(), ranks.count());
  }
  /// Of each walk, if there is one band.
  Power powerPerWalk() const { return { { source_.quantaPerWalk() } }; }
  /// Whether it is a walk of this rank.
  bool isDealt(std::uint32_t walk) const { return blocks_.contains(plan().blockOf(walk)); }
  bool hasBudget() const { return settings_.repairTimeBudget > 0; }
  /// What it takes before the walks of the next round are shot: gathered light, and room.
  void beginRound(bool isStored, const Frame& frame, Execution& execution);
  void shootBlocks(const WalkRound& walks, bool isStored, const Frame& frame, Execution& execution);
  /// Drops all but the first `kept` blocks of this rank, and what they brought.
  void dropBlocks(
    std::size_t kept, const SceneTriangles& triangles, const CancelPoint& cancelPoint);
  /// Fills a batch with the walks of blocks [first, end) of this rank from `firstWalk` on.
  void fill(
    WalkBatch& batch, std::size_t first, std::size_t end, std::uint32_t firstWalk, int bands) const;
  /// Whether walks start at cells of which some moved or reflect otherwise.
  bool hasOtherCells(const Frame& frame) const
  {
    bool hasOthers = false;
    for (std::uint32_t i = source_.cells->first; i < source_.cells->second; ++i)
    {
      hasOthers = hasOthers || (i > 0 && frame.moved[i - 1]) ||
        (!frame.repainted.empty() && frame.repainted[i]);
    }
    return hasOthers;
  }
  /// Gathers anew; for such cells. All walks are still to be born.
  void startAgain(const Frame& frame, Execution& execution);
  /// Follows what a motion changes of the direct light: takes back the walks that no longer start,
  /// and notes which are to be born.
  void followGathered(const Frame& frame, Execution& execution);
  /// Walks of this rank that isChosen(block, walk), in order.
  template <class Chosen>
  std::vector<std::uint32_t> walksOfBlocks(
    const Chosen& isChosen, const CancelPoint& cancelPoint) const;
  /// The rest of follow(): what was gathered is up to date. `moved`, `repainted`: since the walks
  /// were shot.
  void followWalks(const std::vector<bool>& moved, const Repainted& repainted, const Frame& frame,
    PhotonChanges* changes, Execution& execution);
  DirectGather::Totals totals() { return { sums_, balance_, blocks_ }; }
  /// What a motion may change, to be looked for among stored segments.
  BounceScan scanOf(const std::vector<bool>& moved, const Frame& frame) const;
  /// An arena for pages of so many bands: the one of before, if it will do.
  std::shared_ptr<BlockArena> arenaFor(int bands)
  {
    constexpr std::size_t kUsualBytes = std::size_t{ 4 } * 34; // of a walk
    const std::size_t pageBytes = BounceBlock::pageBytes(bands);
    const std::size_t expected = kUsualBytes *
      blocks_.before(source_.plan.rounds().front().endBlock) * WalkPlan::kWalksPerBlock;
    if (!arena_ || arena_->pageBytes() < pageBytes || arena_->pageBytes() >= 2 * pageBytes)
    {
      arena_ = std::make_shared<BlockArena>(pageBytes);
    }
    else if (arena_->bytes() > 4 * expected)
    {
      arena_->release();
    }
    return arena_;
  }

  WalkSettings settings_;
  WalkSource source_;
  std::unique_ptr<DirectRounds> gathered_; ///< null: walks start at the lights
  DealtBlocks blocks_;                     ///< of this rank
  std::shared_ptr<BlockArena> arena_;      ///< kept over fresh starts
  WalkHistory history_;                    ///< empty unless walks are stored
  CellSums sums_;
  PowerBalance balance_;
  std::unique_ptr<StaleWalks> stale_; ///< null unless there is, or was, a budget
  std::size_t staleRounds_ = 0;       ///< for which that is
  std::vector<std::uint32_t> unborn_; ///< walks that are to be born, in order
  bool areCellsRenumbered_ = false;   ///< since direct light was gathered for them
  WalkRound missing_{};               ///< walks that resize() left to be shot
  std::vector<SegmentRef> repaired_;
  WalkStatistics statistics_;
  // What threads work with, kept for the next frames.
  std::unique_ptr<Pool<WalkBatch>> batches_ = std::make_unique<Pool<WalkBatch>>();
  std::unique_ptr<Pool<RepairWork>> repairs_ = std::make_unique<Pool<RepairWork>>();
};

}
