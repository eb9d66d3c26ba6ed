// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IrradianceEngine_h
#define irradiance_IrradianceEngine_h

#include "Execution/Execution.h"
#include "Light/Contacts.h"
#include "Light/SceneObjects.h"
#include "Repair/StaleWalks.h"
#include "Repair/WalkVerifier.h"
#include "Tally/ErrorEstimate.h"
#include "Tally/WalkTally.h"

#include <chrono>
#include <memory>

namespace irradiance
{

struct EngineSettings
{
  std::uint32_t numberOfWalks = 1000000;
  std::uint64_t seed = 1;
  TraversalMode traversalMode = TraversalMode::Parallel;
  bool verify = true; ///< false: every frame is shot anew
  bool cacheStaticHits = true;
  bool separateSides = false;
  std::uint32_t replicates = 1; ///< independent; with 2 or more, standard errors are known
  /// Relative half-width of the 95 % interval that 95 % of the area is to reach; 0: no target. The
  /// number of walks is doubled until then.
  double targetRelativeError = 0;
  std::uint32_t maximumNumberOfWalks = 10000000; ///< >= numberOfWalks; with a target
  /// Seconds for the repair of a frame; what is not repaired in time stays stale for the next call.
  /// 0: no limit.
  double repairTimeBudget = 0;
};

/// What a frame cost.
struct EngineStatistics
{
  std::int64_t suspectSegments = 0; ///< for which the verification cast a ray
  std::int64_t invalidWalks = 0;    ///< found by the verification
  std::int64_t repairedSegments = 0;
  double shootSeconds = 0;
  double verifySeconds = 0; ///< includes rebuilding the trees over dynamic objects
  double repairSeconds = 0;
  std::size_t historyBytes = 0;
};

/**
 * The front door of the engine: a scene in, the power received by every cell out.
 *
 * The first frame is shot. A later one is verified and repaired if only dynamic objects changed
 * pose or points; its sums then equal those of a new engine, bit for bit. It is shot anew if
 * lights, materials, static geometry, seed or sides changed, or the number of objects, triangles,
 * walks or replicates.
 *
 * With a time budget the repair may end early. Then stale() tells what is left, and further calls,
 * with or without motion, continue with it.
 */
class IrradianceEngine
{
public:
  /// All objects need a body and a material, with the same number of bands.
  void update(const SceneObjects& objects, const EngineSettings& settings, Execution& execution);

  /// W/m2 received by `side` (0 front or both, 1 back) of a cell, given its area; 0 if that is 0.
  double irradiance(std::uint32_t object, std::size_t cell, int side, int band, double area) const;
  /// The errors of the sums, from the spread of the replicates; valid until the next update.
  ErrorEstimate errorEstimate() const { return errorEstimate(sums_.rounds()); }
  /// Watts of a number of quanta.
  double watts(double quanta) const
  {
    return emitters_.flux() *
      (quanta / (static_cast<double>(emitters_.photon()) * numberOfWalks()));
  }
  double watts(std::int64_t quanta) const { return watts(static_cast<double>(quanta)); }
  /// The number of walks shot; more than in the settings if a target needs them.
  std::uint32_t numberOfWalks() const { return plan_.rounds()[sums_.rounds() - 1].endWalk; }
  /// See ErrorEstimate::relativeErrorOfMostArea; 0 without a target, NaN while walks are stale.
  double reachedRelativeError() const { return reached_; }
  /// What the budget left unrepaired; null without a budget, or before anything moved.
  const StaleWalks* stale() const { return stale_.get(); }
  /// The part of irradiance() that rests on stale walks.
  double staleIrradiance(
    std::uint32_t object, std::size_t cell, int side, int band, double area) const;
  /// StaleWalks::gainBound() in watts.
  double staleGainBound(int band) const { return stale_ ? watts(stale_->gainBound(band)) : 0.0; }
  bool hasEmitters() const { return !emitters_.isEmpty(); }
  const PowerBalance& balance() const { return balance_; }
  const EngineStatistics& statistics() const { return statistics_; }
  const CellSums& sums() const { return sums_; }
  const std::vector<WalkBlock>& history() const { return history_; }
  const WalkPlan& plan() const { return plan_; }

private:
  using Clock = std::chrono::steady_clock;
  static double secondsSince(Clock::time_point start)
  {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  /// Whether the stored walks can be repaired, given that the lights are the same.
  bool canRepair(const SceneObjects& objects, const EngineSettings& settings) const;
  void commitScene(const std::vector<bool>& moved, Execution& execution);
  void startAnew(Execution& execution);
  /// Shoots rounds of walks until the target is reached, and drops those that it does not need:
  /// what remains is what a new engine would shoot.
  void reachTarget(Execution& execution);
  /// An estimate, after some rounds, of the number of walks that the target will take.
  double expectedWalks(std::size_t rounds) const;
  void shootRound(std::size_t round, Execution& execution);
  /// `storedIn`: the frame of the history; null if the walks are not stored.
  void shootBlocks(const WalkRound& walks, const UnitFrame* storedIn, Execution& execution);
  void dropRounds(std::size_t kept, const Checkpoint& checkpoint);
  ErrorEstimate errorEstimate(std::size_t rounds) const
  {
    return { sums_, plan_, rounds, emitters_.largestStart() };
  }
  void verifyAndRepair(const std::vector<bool>& moved, Execution& execution);
  std::vector<std::vector<StaleSegment>> verify(
    const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution);
  bool hasBudget() const { return settings_.repairTimeBudget > 0; }
  std::size_t historyBytes() const;
  /// Walks stay inside, except where they escape.
  Box walkBounds() const;
  double reachInFrame() const;

  bool isValid_ = false; ///< the state below belongs to objects_ and settings_
  SceneObjects objects_;
  EngineSettings settings_;
  WalkPlan plan_;
  Scene scene_;
  EmitterTable emitters_;
  Contacts contacts_; ///< of this frame
  CellSums sums_;
  PowerBalance balance_;
  std::vector<WalkBlock> history_;    ///< empty unless something may move
  std::unique_ptr<StaleWalks> stale_; ///< null unless there is, or was, a budget
  UnitFrame pointFrame_;              ///< of the stored points
  double pointReach_ = 0;             ///< their largest coordinate, except the ends of escapes
  double clearance_ = 0;              ///< of all frames since the walks were shot, see Scene
  double reached_ = 0;
  EngineStatistics statistics_;
};

}

#endif
