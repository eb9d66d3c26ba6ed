// SPDX-License-Identifier: BSD-3-Clause
#include "IrradianceEngine.h"

#include "Estimates/AutomaticChoice.h"
#include "FinalGather/PathLights.h"
#include "Surfaces/SceneHash.h"

#include <limits>
#include <optional>

namespace irradiance
{

namespace
{

/// Of all settings that change results.
std::uint64_t hashOf(const EngineSettings& settings)
{
  Hash hash;
  hash.add(settings.numberOfWalks, settings.seed, settings.verify, settings.gathersDirectLight,
    settings.fewestSamples.small, settings.fewestSamples.large, settings.fewestSamples.mostOfSmall,
    settings.keepPhotons, settings.allOnEachRank, settings.listRepaired, settings.replicates,
    settings.targetRelativeError, settings.maximumNumberOfWalks, settings.repairTimeBudget,
    static_cast<int>(settings.cellEstimate), settings.spreadPhotons, settings.gatherRays,
    settings.maximumGatherRays, settings.gathersEverywhere, settings.unbiasedGather,
    settings.separateSides);
  return hash.value();
}

/// What all ranks do for a frame: a fresh start if one of them needs it. `before`: the objects of
/// the frame before. Throws RankFailed if they have not been given the same.
FrameChange agreedChange(const FrameChange& change, const SceneObjects& objects,
  const SceneObjects& before, const EngineSettings& settings, Ranks& ranks)
{
  if (!ranks.areSeveral())
  {
    return change;
  }
  ranks.expectSame(hashOf(settings), "other settings than on the first process");
  std::int64_t fresh = change.kind == FrameChange::Fresh ? 1 : 0;
  ranks.sum(&fresh, 1);
  FrameChange agreed = fresh > 0 ? FrameChange{ FrameChange::Fresh } : change;
  Hash hash;
  hash.add(static_cast<int>(agreed.kind));
  addScene(objects, fresh > 0 ? nullptr : &before, hash);
  ranks.expectSame(hash.value(), "other inputs than on the first process");
  return agreed;
}

}

EngineSettings IrradianceEngine::chosen(const LeftToScene& left, const SceneObjects& objects,
  const EngineSettings& settings, Execution& execution)
{
  EngineSettings chosen = settings;
  if (left.directLight || left.cellEstimate)
  {
    const CancelPoint cancelPoint = cancelPointOf(execution, 0);
    cellsToChoose_.update(objects, cancelPoint);
    const auto survey = [&]() -> const LightSurvey& {
      lights_.update(objects, WalkSets::planOf(settings), frame_.sides, cancelPoint);
      return lights_.survey();
    };
    chooseByScene(left, objects, cellsToChoose_, survey, chosen, chosen);
  }
  return chosen;
}

void IrradianceEngine::update(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  assert(conflictOf(settings, settings).empty());
  if (settings.cellEstimate == CellEstimate::Gathered)
  {
    checkLights(objects, "Method Gathered"); // before anything is shot
  }
  const FrameChange own = changeTo(objects, settings, execution);
  isValid_ = false; // until the end is reached
  const FrameChange change =
    agreedChange(own, objects, frame_.objects, settings, execution.ranks());
  const bool isFresh = change.kind == FrameChange::Fresh;
  const std::size_t blocks = walks_.numberOfBlocks(), rays = rounds_.rays;
  ++state_;
  adopt(objects, settings, change, execution);
  const bool hasTarget = settings_.targetRelativeError > 0;
  const double begun = isFresh ? 0 : hasTarget ? 0.5 : 1; // what comes after a repair is not known
  ProgressSpan following(execution, 0, begun), shooting(execution, begun, 1);
  isFresh ? start(execution) : follow(change, following);
  hasTarget && !walks_.hasStale() ? reachTarget(shooting) : shootOnce(isFresh, shooting);
  walks_.forgetBudget();
  estimator_->dropRayRounds(rounds_.rays);
  statistics_ += walks_.statistics();
  // To count the bytes takes longer than all else where nothing has moved.
  if (change.kind != FrameChange::Still || walks_.numberOfBlocks() != blocks ||
    rounds_.rays != rays)
  {
    statistics_.historyBytes = walks_.bytes() + estimator_->bytes();
  }
  isValid_ = true;
}

FrameChange IrradianceEngine::changeTo(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  const WalkPlan plan = WalkSets::planOf(settings);
  const bool sameStarts = settings.gathersDirectLight == settings_.gathersDirectLight &&
    settings.fewestOfCells() == settings_.fewestOfCells();
  const bool samePlan = sameStarts && plan == WalkSets::planOf(settings_);
  bool resizes = false;
  // A wall that a point light touches may have moved.
  bool sameLights =
    isValid_ && samePlan && areLightsUnchanged(objects, frame_.objects) && !walks_.mayTouchWalls();
  if (!sameLights)
  {
    const bool wasValid = std::exchange(isValid_, false);
    lights_.update(objects, plan, frame_.sides, cancelPointOf(execution, 0));
    std::vector<WalkSource> sources = settings.gathersDirectLight
      ? directSourcesOf(objects, lights_.sources(), lights_.survey(), settings.fewestOfCells())
      : lights_.sources();
    isValid_ = wasValid;
    sameLights = isValid_ && walks_.hasSources(sources);
    if (!sameLights)
    {
      resizes = isValid_ && sameStarts && walks_.areResizedBy(sources, storesWalks());
      if (settings.gathersDirectLight)
      {
        addLamps(sources);
      }
      walks_.setSources(std::move(sources));
    }
  }
  const bool hasAsMany = !isValid_ || objects.size() == frame_.objects.size();
  const SceneObjects aligned = hasAsMany ? SceneObjects() : withAsMany(frame_.objects, objects);
  const SceneObjects& before = hasAsMany ? frame_.objects : aligned;
  KeptParts kept = isValid_ ? keptParts(objects, frame_.objects) : KeptParts();
  const bool replaces = isValid_ && (!kept.areAll() || hasReplaced(objects, before));
  // Within a time budget ranks that all keep all walks would not repair the same ones.
  const bool mayStay = settings.repairTimeBudget == 0;
  const bool all = settings.allOnEachRank || (settings_.allOnEachRank && mayStay);
  if (!(resizes || (sameLights && samePlan)) || !canRepair(objects, before, kept, settings) ||
    !walks_.areOf(execution.ranks(), all) || (replaces && walks_.hasStale()))
  {
    return { FrameChange::Fresh };
  }
  FrameChange change{ FrameChange::Still, findMoved(objects, before),
    findRepainted(objects, before), std::move(kept), resizes };
  const bool forgetsHits = settings_.cacheStaticHits && !settings.cacheStaticHits;
  if (replaces || hasMotion(change.moved) || !change.repainted.empty() || resizes ||
    walks_.staleSums() || forgetsHits)
  {
    change.kind = replaces ? FrameChange::Replace : FrameChange::Repair;
  }
  return change;
}

bool IrradianceEngine::canRepair(const SceneObjects& objects, const SceneObjects& before,
  const KeptParts& kept, const EngineSettings& settings) const
{
  // Rounds of walks that were not stored cannot be taken back.
  const bool mayKeepAll = !objects.dynamicObjects.empty() || settings.targetRelativeError == 0;
  return isValid_ && settings.verify && settings_.verify && mayKeepAll &&
    (!settings.keepPhotons || storesWalks()) && settings.seed == settings_.seed &&
    hasAllCells(objects, before) &&
    (storesWalks() || (kept.areAll() && findRepainted(objects, before).empty())) &&
    (kept.areAll() ||
      (kept.isAnyStatic && irradiance::storesWalks(objects, settings) &&
        !settings.gathersDirectLight));
}

void IrradianceEngine::adopt(const SceneObjects& objects, const EngineSettings& settings,
  const FrameChange& change, Execution& execution)
{
  frame_.objects = objects;
  frame_.moved = change.moved;
  frame_.repainted = change.repainted;
  frame_.kept = change.kept;
  // Walks that are kept for their photons stay: a filter may need them again.
  const bool isFresh = change.kind == FrameChange::Fresh;
  const bool keepsPhotons = settings.keepPhotons || (!isFresh && settings_.keepPhotons);
  const bool allOnEachRank = settings.allOnEachRank || (!isFresh && settings_.allOnEachRank);
  if (!estimator_ || !isSameEstimate(settings, settings_) || settings.seed != settings_.seed ||
    settings.verify != settings_.verify)
  {
    estimator_ = makeCellEstimator(settings, settings, frame_, walks_);
  }
  settings_ = settings;
  settings_.keepPhotons = keepsPhotons;
  settings_.allOnEachRank = allOnEachRank;
  statistics_ = { {}, statistics_.historyBytes, 0 };
  ProgressSpan beginning(execution, 0, 0);
  frame_.cells.update(frame_.objects, cancelPointOf(beginning, 0));
  if (change.kind != FrameChange::Still) // else they are those of before
  {
    frame_.triangles.update(frame_.objects, cancelPointOf(beginning, 0));
  }
  surfaces_.forgetOthers(frame_.objects);
  WalkSettings walks = settings_;
  walks.fewestSamples = settings_.fewestOfCells();
  walks_.setSettings(walks);
  if (change.kind == FrameChange::Replace)
  {
    walks_.replaceCells(frame_, beginning);
    photons_.reset();
  }
  if (change.resizes)
  {
    walks_.resize(storesWalks(), frame_, beginning);
    photons_.reset();
  }
}

void IrradianceEngine::commitScene(Execution& execution)
{
  Scene& scene = frame_.scene;
  scene.setTraversalMode(settings_.traversalMode);
  scene.setStatic(objects().staticObject.body);
  scene.setDynamic(objects().dynamicBodies());
  scene.setPointSources(walks_.boundsInAir());
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  scene.commit(frame_.moved, cancelPoint);
  const bool didTouch = !frame_.contacts.isEmpty();
  frame_.contacts.update(
    objects(), frame_.kept.areAll() ? frame_.moved : std::vector<bool>(), frame_.sides, execution);
  frame_.kept.mayTouch = !frame_.kept.areAll() && (didTouch || !frame_.contacts.isEmpty());
  if (settings_.gathersDirectLight)
  {
    frame_.sides.find(objects(), cancelPoint);
  }
}

void IrradianceEngine::follow(const FrameChange& change, Execution& execution)
{
  const bool hasChanged = frame_.hasChanged();
  if (hasChanged)
  {
    const double start = steadySeconds();
    commitScene(execution);
    statistics_.verifySeconds = steadySeconds() - start;
  }
  const bool repairs = !walks_.isEmpty() && (hasChanged || walks_.hasStale());
  const double repaired = !change.resizes ? 1 : repairs ? 0.5 : 0; // of the progress
  ProgressSpan repairing(execution, 0, repaired), shooting(execution, repaired, 1);
  if (repairs)
  {
    if (settings_.gathersDirectLight)
    {
      photons_.reset(); // walks that are born are not among the changes
    }
    PhotonChanges changes;
    walks_.follow(frame_, photons_ ? &changes : nullptr, repairing);
    const double start = steadySeconds();
    if (photons_)
    {
      photons_->apply(objects(), walks_.histories(), changes, repairing);
    }
    statistics_.repairSeconds = steadySeconds() - start;
  }
  if (change.resizes)
  {
    walks_.shootMissing(storesWalks(), frame_, shooting);
  }
}

void IrradianceEngine::reachTarget(Execution& execution)
{
  const std::vector<WalkRound>& plan = walks_.plan().rounds();
  EstimateRounds rounds{ 0, 1 };
  double progress = 0, next = double(plan.front().endWalk) / walks_.plan().most();
  std::optional<TargetLever> lever = TargetLever::Walks;
  while (lever)
  {
    // Less may have been expected before. Progress then waits rather than going back.
    const double from = progress;
    progress = std::max(from, next);
    ProgressSpan span(execution, from, progress), still(execution, progress, progress);
    ++(lever == TargetLever::Walks ? rounds.walks : rounds.rays);
    if (rounds.walks > sums().rounds())
    {
      shootRound(rounds.walks - 1, span);
    }
    checkReceived(balance());
    estimate(rounds, lever == TargetLever::Walks ? still : span);
    miss_ = errorEstimate().missOf(
      settings_.targetRelativeError, frame_.cells, settings_.separateSides, still);
    lever = miss_.reached > settings_.targetRelativeError
      ? chooseLever(miss_, rounds, walks_, *estimator_)
      : std::nullopt;
    next = 2 / expectedGrowth();
  }
  if (storesWalks() && sums().rounds() > rounds.walks)
  {
    photons_.reset();
  }
  ProgressSpan dropping(execution, progress, progress);
  walks_.dropRounds(rounds.walks, frame_, dropping);
  if (!execution.reportProgress(1))
  {
    throw Interrupted();
  }
}

}
