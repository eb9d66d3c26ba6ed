// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IrradianceEngine_h
#define irradiance_IrradianceEngine_h

#include "Execution/Execution.h"
#include "Light/Contacts.h"
#include "Light/SceneObjects.h"
#include "NearestCells.h"
#include "Photons/LeafPhotons.h"
#include "Photons/SpecularPhotons.h"
#include "Repair/StaleWalks.h"
#include "Repair/WalkVerifier.h"
#include "Tally/CellEstimate.h"
#include "Tally/CellSpread.h"
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
  /// Whether walks are stored even if nothing can move, for those who ask for photons.
  bool keepPhotons = false;
  bool listRepaired = false;    ///< whether it is noted which walks a repair shoots again
  std::uint32_t replicates = 1; ///< independent; with 2 or more, standard errors are known
  /// Relative half-width of the 95 % interval that 95 % of the area is to reach; 0: no target. The
  /// number of walks is doubled until then.
  double targetRelativeError = 0;
  std::uint32_t maximumNumberOfWalks = 10000000; ///< >= numberOfWalks; with a target
  /// Seconds for the repair of a frame; what is not repaired in time stays stale for the next call.
  /// 0: no limit.
  double repairTimeBudget = 0;
  CellEstimate cellEstimate = CellEstimate::Sums;
  /// On how many photons a small cell draws if the estimate is spread, on average; > 0.
  double spreadPhotons = 250;
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
 * pose or points, came or went; its sums then equal those of a new engine, bit for bit. An object that
 * comes may look different from before, if no walks are stale. All is shot anew if lights, materials,
 * static geometry, seed or sides changed, or the number of objects, triangles, walks or replicates.
 *
 * With a time budget the repair may end early. Then stale() tells what is left, and further calls,
 * with or without motion, continue with it.
 */
class IrradianceEngine
{
public:
  /// All objects need a body and a material, with the same number of bands.
  void update(const SceneObjects& objects, const EngineSettings& settings, Execution& execution);

  /// W/m2, by the cell estimate of the settings; 0 for a cell without area.
  double irradiance(const CellSide& cell, int band) const;
  /// The errors of irradiance(), from the variance between replicates; valid until the next update.
  /// What the estimate blurs is not in them.
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
  /// The first segments of the tails that the last update which repaired something shot again, ordered
  /// by walk; empty after a fresh start. Only if that update was to list them.
  const std::vector<SegmentRef>& repaired() const { return repaired_; }
  /// The part of irradiance() that rests on stale walks.
  double staleIrradiance(const CellSide& cell, int band) const;
  /// StaleWalks::gainBound() in watts.
  double staleGainBound(int band) const { return stale_ ? watts(stale_->gainBound(band)) : 0.0; }
  bool hasEmitters() const { return !emitters_.isEmpty(); }
  const PowerBalance& balance() const { return balance_; }
  const EngineStatistics& statistics() const { return statistics_; }
  /// What arrived in the cells themselves.
  const CellSums& sums() const { return sums_; }
  /// Empty unless something may move, or photons are kept.
  const WalkHistory& history() const { return history_; }
  const WalkPlan& plan() const { return plan_; }

  /// Differs after each update: what was derived from another state is out of date.
  std::uint64_t state() const { return state_; }
  /// Whether the last update was completed.
  bool isValid() const { return isValid_; }
  const SceneObjects& objects() const { return objects_; }
  const SceneCells& cells() const { return cells_; }
  const Scene& scene() const { return scene_; }
  /// Walks stay inside, except where they escape.
  Box walkBounds() const;
  const EngineSettings& settings() const { return settings_; }
  /// Whether the following can be asked for.
  bool keepsPhotons() const
  {
    return settings_.keepPhotons || (settings_.verify && !objects_.dynamicObjects.empty());
  }
  SobolSequence samples() const { return SobolSequence(settings_.seed, plan_.replicates()); }
  /// `samples` must outlive it.
  WalkShooter shooter(const SobolSequence& samples) const
  {
    return { scene_, objects_, emitters_, samples, &contacts_ };
  }
  /// The photons on specular cells. They are collected when first asked for, then updates keep them
  /// up to date. Throws Interrupted.
  const SpecularPhotons& specularPhotons(Execution& execution);
  /// All photons, in the leaf cells of the ray-casting trees; likewise.
  const LeafPhotons& leafPhotons(Execution& execution);
  /// The surfaces of all objects, on which sensors stand; likewise.
  const Surfaces& surfaces(Execution& execution);
  /// How many sides of cells the last update estimated from their nearest photons.
  std::size_t numberOfNearestEstimates() const { return nearestCells_.numberOfEstimates(); }

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
  /// `isStored`: the history has room for them.
  void shootBlocks(const WalkRound& walks, bool isStored, Execution& execution);
  void dropRounds(std::size_t kept, const Checkpoint& checkpoint);
  bool isSpread() const { return settings_.cellEstimate == CellEstimate::Spread; }
  /// Spreads the sums of the first rounds, if the settings say so.
  void spreadSums(std::size_t rounds, Execution& execution);
  /// Of the rounds for which spreadSums() was called.
  ErrorEstimate errorEstimate(std::size_t rounds) const;
  void verifyAndRepair(const std::vector<bool>& moved, Execution& execution);
  std::vector<std::vector<StaleSegment>> verify(
    const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution);
  /// Of all stored hits.
  void findSides(Execution& execution);
  /// `isSame`: no photon has changed since the last call.
  void estimateNearest(bool isSame, Execution& execution);
  bool hasPhotonStores() const { return specularPhotons_ || leafPhotons_; }
  void forgetPhotonStores()
  {
    specularPhotons_.reset();
    leafPhotons_.reset();
    nearestCells_ = {};
  }
  void updatePhotonStores(const PhotonChanges& changes, Execution& execution);
  bool hasBudget() const { return settings_.repairTimeBudget > 0; }
  std::size_t historyBytes() const;
  double reachInFrame() const;

  bool isValid_ = false; ///< the state below belongs to objects_ and settings_
  SceneObjects objects_;
  SceneCells cells_;
  EngineSettings settings_;
  WalkPlan plan_;
  Scene scene_;
  EmitterTable emitters_;
  Contacts contacts_; ///< of this frame
  CellSums sums_;
  CellSpread spread_;
  NearestCells nearestCells_;             ///< empty unless asked for
  CellSums spreadSums_, spreadStaleSums_; ///< empty unless sums are spread
  PowerBalance balance_;
  WalkHistory history_;                              ///< empty unless something may move
  std::unique_ptr<SpecularPhotons> specularPhotons_; ///< null until asked for
  std::unique_ptr<LeafPhotons> leafPhotons_;         ///< null until asked for
  Surfaces surfaces_;                                ///< empty until asked for
  std::uint64_t state_ = 0;
  bool hasSides_ = false;             ///< all sides of stored hits are known, see WalkBatch
  std::unique_ptr<StaleWalks> stale_; ///< null unless there is, or was, a budget
  std::vector<SegmentRef> repaired_;
  double pointReach_ = 0; ///< the largest coordinate of a stored point, except the ends of escapes
  double clearance_ = 0;  ///< of all frames since the walks were shot, see Scene
  double reached_ = 0;
  EngineStatistics statistics_;
};

}

#endif
