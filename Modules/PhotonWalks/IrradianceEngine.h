// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IrradianceEngine_h
#define irradiance_IrradianceEngine_h

#include "Execution/Execution.h"
#include "Light/Contacts.h"
#include "Light/SceneCells.h"
#include "NearestCells.h"
#include "Photons/LeafPhotons.h"
#include "Photons/SpecularPhotons.h"
#include "Repair/SceneChange.h"
#include "Tally/CellEstimate.h"
#include "Tally/CellSpread.h"
#include "Tally/ErrorEstimate.h"
#include "Walks/WalkSet.h"

#include <memory>

namespace irradiance
{

struct EngineSettings : WalkSettings
{
  TraversalMode traversalMode = TraversalMode::Parallel;
  CellEstimate cellEstimate = CellEstimate::Sums;
  /// On how many photons a small cell draws if the estimate is spread, on average; > 0.
  double spreadPhotons = 250;
};

/// What a frame cost. Verification includes rebuilding the trees over dynamic objects, repair includes
/// updating the stores of photons.
struct EngineStatistics : WalkStatistics
{
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
  ErrorEstimate errorEstimate() const { return errorEstimate(sums().rounds()); }
  double watts(double quanta) const { return walks_.watts(quanta); }
  double watts(std::int64_t quanta) const { return watts(static_cast<double>(quanta)); }
  std::uint32_t numberOfWalks() const { return walks_.numberOfWalks(); }
  /// See ErrorEstimate::relativeErrorOfMostArea; 0 without a target, NaN while walks are stale.
  double reachedRelativeError() const { return reached_; }
  const StaleWalks* stale() const { return walks_.stale(); }
  const std::vector<SegmentRef>& repaired() const { return walks_.repaired(); }
  /// The part of irradiance() that rests on stale walks.
  double staleIrradiance(const CellSide& cell, int band) const;
  /// StaleWalks::gainBound() in watts.
  double staleGainBound(int band) const { return stale() ? watts(stale()->gainBound(band)) : 0.0; }
  bool hasEmitters() const { return !walks_.isEmpty(); }
  const PowerBalance& balance() const { return walks_.balance(); }
  const EngineStatistics& statistics() const { return statistics_; }
  const CellSums& sums() const { return walks_.sums(); }
  /// Empty unless something may move, or photons are kept.
  const WalkHistory& history() const { return walks_.history(); }
  const WalkPlan& plan() const { return walks_.plan(); }

  /// Differs after each update: what was derived from another state is out of date.
  std::uint64_t state() const { return state_; }
  /// Whether the last update was completed.
  bool isValid() const { return isValid_; }
  const SceneObjects& objects() const { return objects_; }
  const SceneCells& cells() const { return cells_; }
  const Scene& scene() const { return scene_; }
  /// Walks stay inside, except where they escape.
  Box walkBounds() const { return walks_.bounds(scene_); }
  const EngineSettings& settings() const { return settings_; }
  /// Whether the following can be asked for.
  bool keepsPhotons() const
  {
    return settings_.keepPhotons || (settings_.verify && !objects_.dynamicObjects.empty());
  }
  SobolSequence samples() const { return walks_.samples(); }
  /// `samples` must outlive it.
  WalkShooter shooter(const SobolSequence& samples) const
  {
    return walks_.shooter(space(), samples);
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
  WalkSpace space() const { return { scene_, objects_, contacts_ }; }
  /// What is to be done for a frame. Takes over new lights and a new plan.
  FrameChange changeTo(
    const SceneObjects& objects, const EngineSettings& settings, Execution& execution);
  /// Whether the stored walks can be repaired, given that the lights are the same.
  bool canRepair(const SceneObjects& objects, const EngineSettings& settings) const;
  void commitScene(const std::vector<bool>& moved, Execution& execution);
  /// Forgets all walks and commits the scene.
  void start(Execution& execution);
  void follow(const std::vector<bool>& moved, Execution& execution);
  void shootRound(std::size_t round, Execution& execution);
  /// Without a target, or as long as walks are stale: `isFresh` tells that no walk is shot yet.
  void shootOnce(bool isFresh, Execution& execution);
  /// Shoots rounds of walks until the target is reached, and drops those that it does not need:
  /// what remains is what a new engine would shoot.
  void reachTarget(Execution& execution);
  /// An estimate, after some rounds, of the number of walks that the target will take.
  double expectedWalks(std::size_t rounds) const;
  bool isSpread() const { return settings_.cellEstimate == CellEstimate::Spread; }
  /// Spreads the sums of the first rounds, if the settings say so.
  void spreadSums(std::size_t rounds, Execution& execution);
  /// Of the rounds for which spreadSums() was called.
  ErrorEstimate errorEstimate(std::size_t rounds) const;
  /// `isSame`: no photon has changed since the last call.
  void estimateNearest(bool isSame, Execution& execution);
  template <class Store>
  const Store& storeOf(std::unique_ptr<Store>& store, Execution& execution);
  void forgetPhotonStores();
  void updatePhotonStores(const PhotonChanges& changes, Execution& execution);

  bool isValid_ = false; ///< the state below belongs to objects_ and settings_
  std::uint64_t state_ = 0;
  SceneObjects objects_;
  SceneCells cells_;
  EngineSettings settings_;
  Scene scene_;
  Contacts contacts_; ///< of this frame
  WalkSet walks_;
  CellSpread spread_;
  NearestCells nearestCells_;                        ///< empty unless asked for
  CellSums spreadSums_, spreadStaleSums_;            ///< empty unless sums are spread
  std::unique_ptr<SpecularPhotons> specularPhotons_; ///< null until asked for
  std::unique_ptr<LeafPhotons> leafPhotons_;         ///< null until asked for
  Surfaces surfaces_;                                ///< empty until asked for
  double reached_ = 0;
  EngineStatistics statistics_;
};

}

#endif
