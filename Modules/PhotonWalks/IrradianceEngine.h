// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/CellEstimate.h"
#include "Estimates/CellEstimator.h"
#include "Execution/Execution.h"
#include "Photons/NearestPhotons.h"
#include "Repair/SceneChange.h"
#include "Surfaces/Frame.h"
#include "Walks/LightSurvey.h"
#include "Walks/WalkSets.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

namespace irradiance
{

struct LeftToScene;

struct EngineSettings
  : WalkSettings
  , EstimateSettings
{
  TraversalMode traversalMode = TraversalMode::Parallel;

  /// With how many samples cells gather direct light at least.
  FewestSamples fewestOfCells() const { return fewestSamplesOf(*this, fewestSamples); }
};

/// Whether walks are kept: for motions to come, or for their photons.
inline bool storesWalks(const SceneObjects& objects, const WalkSettings& settings)
{
  return settings.keepPhotons || (settings.verify && !objects.dynamicObjects.empty());
}

/// What a frame cost. Verification includes rebuilding the trees over dynamic objects, repair
/// includes updating the stores of photons.
struct EngineStatistics : WalkStatistics
{
  std::size_t historyBytes = 0;   ///< of all that is kept for frames to come
  std::int64_t followedPaths = 0; ///< of the final gather
};

/**
 * The front door of the engine: a scene in, the power received by every cell out.
 *
 * The first frame is shot. A later one is verified and repaired if objects or static parts moved,
 * came or went, or reflect otherwise, or if there are to be more or fewer walks; its sums then equal
 * the sums of a new engine, bit for bit. FrameChange tells after which changes all is shot again.
 *
 * With a time budget the repair may end early. Then stalePower() tells what is left, and further
 * calls, with or without motion, continue with it.
 */
class IrradianceEngine
{
public:
  IrradianceEngine() = default;
  IrradianceEngine(const IrradianceEngine&) = delete;
  IrradianceEngine& operator=(const IrradianceEngine&) = delete;

  /// The settings, with what is left to the scene as chooseByScene() says. What it finds out
  /// update() need not.
  EngineSettings chosen(const LeftToScene& left, const SceneObjects& objects,
    const EngineSettings& settings, Execution& execution);
  /// All objects need a body and a material, with the same number of bands. No conflictOf() the
  /// settings. Throws Interrupted, and InputError for lights that the cell estimate does not know,
  /// see checkLights().
  void update(const SceneObjects& objects, const EngineSettings& settings, Execution& execution);

  /// W/m2, by the cell estimate of the settings; 0 for a cell without area.
  double irradiance(const CellSide& cell, int band) const
  {
    return estimator_->irradiance(cell, band);
  }
  /// The errors of irradiance(), see CellEstimator; valid until the next update.
  ErrorEstimate errorEstimate() const { return estimator_->errorEstimate(); }
  double watts(double quanta) const { return walks_.watts(quanta); }
  double watts(std::int64_t quanta) const { return watts(static_cast<double>(quanta)); }
  std::uint32_t numberOfWalks() const { return walks_.numberOfWalks(); }
  /// Of each side of a small cell; more than in the settings if a target needs them, 0 if no cell
  /// casts any.
  std::uint64_t numberOfGatherRays() const { return estimator_->numberOfRays(); }
  /// See TargetMiss; 0 without a target, NaN while walks are stale.
  double reachedRelativeError() const { return miss_.reached; }
  /// Quanta that the walks carry which the budget left unrepaired.
  Power stalePower() const { return walks_.stalePower(); }
  /// The part of irradiance() that rests on stale walks.
  double staleIrradiance(const CellSide& cell, int band) const
  {
    return estimator_->staleIrradiance(cell, band);
  }
  /// StalePower::gain in watts.
  double staleGainBound(int band) const { return watts(walks_.staleGainBound(band)); }
  bool hasLights() const { return !walks_.isEmpty(); }
  const PowerBalance& balance() const { return walks_.balance(); }
  /// W: the standard error of what escapes, and of what is absorbed; rather too large.
  double escapedError(int band) const { return watts(walks_.escapedError(band)); }
  const EngineStatistics& statistics() const { return statistics_; }
  const CellSums& sums() const { return walks_.sums(); }
  /// Their histories are empty unless something may move, or photons are kept.
  const WalkSets& walks() const { return walks_; }

  /// Differs after each update: what was derived from another state is out of date.
  std::uint64_t state() const { return state_; }
  /// Whether the last update was completed.
  bool isValid() const { return isValid_; }
  const Frame& frame() const { return frame_; }
  const SceneObjects& objects() const { return frame_.objects; }
  const SceneCells& cells() const { return frame_.cells; }
  const Scene& scene() const { return frame_.scene; }
  const EngineSettings& settings() const { return settings_; }
  bool storesWalks() const { return irradiance::storesWalks(objects(), settings_); }
  /// Collects the photons of the history, unless that was done before; then updates keep them up to
  /// date, or forget them where direct light is gathered. Those are then photons of indirect light
  /// alone. Needs stored walks. Throws Interrupted.
  void collectPhotons(Execution& execution)
  {
    assert(storesWalks());
    if (photons_)
    {
      return;
    }
    auto photons = std::make_unique<LeafPhotons>(objects());
    inParts(walks_.sets().size(), execution, [&](std::size_t i, Execution& part) {
      const WalkHistory& history = walks_.sets()[i].history();
      photons->add(history, 0, history.size(), part);
    });
    photons_ = std::move(photons);
  }
  /// What was collected.
  const LeafPhotons& photons() const { return *photons_; }
  /// Prepares the surfaces of all objects, on which sensors stand, unless that was done before.
  /// Throws Interrupted.
  void prepareSurfaces(Execution& execution)
  {
    surfaces_.update(objects(), cancelPointOf(execution, 0));
  }
  /// Until the next update. Needs leaf photons and surfaces.
  NearestPhotons nearestPhotons() const
  {
    return { photons(), surfaces_, objects(), walks_.histories() };
  }

private:
  /// What is to be done for a frame, see FrameChange. Takes over new lights and a new plan.
  FrameChange changeTo(
    const SceneObjects& objects, const EngineSettings& settings, Execution& execution);
  /// Whether the stored walks can be repaired, given that the lights are the same. `before`: the
  /// frame of them with as many objects.
  bool canRepair(const SceneObjects& objects, const SceneObjects& before, const KeptParts& kept,
    const EngineSettings& settings) const;
  /// Takes over a frame and its settings, and forgets what it makes out of date.
  void adopt(const SceneObjects& objects, const EngineSettings& settings, const FrameChange& change,
    Execution& execution);
  void commitScene(Execution& execution);
  /// Forgets all walks and commits the scene.
  void start(Execution& execution)
  {
    commitScene(execution);
    walks_.start(frame_, execution);
    photons_.reset();
  }
  void follow(const FrameChange& change, Execution& execution);
  void shootRound(std::size_t round, Execution& execution)
  {
    photons_.reset(); // they are collected again, with this round
    walks_.shootRound(round, storesWalks(), frame_, execution);
  }
  /// Without a target, or as long as walks are stale: `isFresh` tells that no walk is shot yet.
  void shootOnce(bool isFresh, Execution& execution)
  {
    if (isFresh)
    {
      shootRound(0, execution);
    }
    miss_ = {};
    miss_.reached = walks_.hasStale() ? std::numeric_limits<double>::quiet_NaN() : 0;
    const bool staysAsItIs = !isFresh && settings_.targetRelativeError > 0;
    const std::size_t rays = staysAsItIs ? std::min(rounds_.rays, estimator_->mostRayRounds()) : 1;
    ProgressSpan end(execution, 1, 1);
    estimate({ sums().rounds(), rays }, end);
  }
  /// Adds rounds of walks and rays until the target is reached, and drops those that it does not
  /// need: what remains is what a new engine would have.
  void reachTarget(Execution& execution);
  /// An estimate, after some rounds, of how much more there will be of all that was done.
  double expectedGrowth() const
  {
    const double walks = walks_.plan().most() / double(walks_.plan().walksAfter(rounds_.walks));
    const double rays = std::ldexp(1, static_cast<int>(estimator_->mostRayRounds() - rounds_.rays));
    // The error falls with the square root of the numbers.
    const double ratio = miss_.reached / settings_.targetRelativeError;
    return std::max(2.0, std::min(ratio * ratio, std::max(walks, rays)));
  }
  /// Estimates the cells from the first rounds.
  void estimate(const EstimateRounds& rounds, Execution& execution)
  {
    rounds_ = rounds;
    estimator_->update(rounds, execution);
    statistics_.followedPaths += estimator_->followedPaths();
  }

  bool isValid_ = false; ///< the state below belongs to frame_ and settings_
  std::uint64_t state_ = 0;
  Frame frame_;
  SceneCells cellsToChoose_; ///< of the frame that chosen() saw
  FrameLights lights_;       ///< of that or the last frame
  EngineSettings settings_;
  WalkSets walks_;
  std::unique_ptr<LeafPhotons> photons_;     ///< null until they are collected
  Surfaces surfaces_;                        ///< empty until they are prepared
  std::unique_ptr<CellEstimator> estimator_; ///< null before the first update
  EstimateRounds rounds_;                    ///< of the last estimate
  TargetMiss miss_;
  EngineStatistics statistics_;
};

}
