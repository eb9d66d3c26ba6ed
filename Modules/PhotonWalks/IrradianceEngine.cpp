// SPDX-License-Identifier: BSD-3-Clause
#include "IrradianceEngine.h"

#include "Execution/ProgressSpan.h"
#include "Execution/Stopwatch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace irradiance
{

void IrradianceEngine::update(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  const FrameChange change = changeTo(objects, settings, execution);
  const bool isFresh = change == FrameChange::Fresh;
  const std::vector<bool> moved = isFresh ? std::vector<bool>() : findMoved(objects, objects_);
  const std::size_t bytes = statistics_.historyBytes, blocks = history().size();
  isValid_ = false; // until the end is reached
  ++state_;
  objects_ = objects;
  // A history that is kept stays, for those who ask for photons again.
  const bool keepsPhotons = settings.keepPhotons || (!isFresh && settings_.keepPhotons);
  settings_ = settings;
  settings_.keepPhotons = keepsPhotons;
  statistics_ = {};
  const Checkpoint checkpoint = checkpointOf(execution, 0);
  cells_.update(objects_, checkpoint);
  surfaces_.forgetOthers(objects_);
  walks_.setSettings(settings_);
  if (change == FrameChange::Replace)
  {
    walks_.replaceCells(objects_, checkpoint);
    forgetPhotonStores();
  }
  const bool hasTarget = settings_.targetRelativeError > 0;
  const double begun = isFresh ? 0 : hasTarget ? 0.5 : 1; // what comes after a repair is not known
  ProgressSpan following(execution, 0, begun), shooting(execution, begun, 1), end(execution, 1, 1);
  if (isFresh)
  {
    start(execution);
  }
  else
  {
    follow(moved, following);
  }
  if (hasTarget && !walks_.hasStale())
  {
    reachTarget(shooting);
  }
  else
  {
    shootOnce(isFresh, shooting);
  }
  walks_.forgetBudget();
  const bool isSame = change == FrameChange::Still && history().size() == blocks;
  estimateNearest(isSame, end);
  statistics_ += walks_.statistics();
  // To count them takes longer than all else where nothing has moved.
  statistics_.historyBytes = isSame ? bytes : walks_.bytes();
  isValid_ = true;
}

FrameChange IrradianceEngine::changeTo(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  const WalkPlan plan = WalkSet::planOf(settings);
  const bool samePlan = plan == walks_.plan();
  // A wall that a point light touches may have moved.
  bool sameLights = isValid_ && samePlan && areLightsUnchanged(objects, objects_) &&
    walks_.emitters().pointBounds().isEmpty();
  if (!sameLights)
  {
    const bool wasValid = std::exchange(isValid_, false);
    EmitterTable emitters(objects, plan.most(), &contacts_, checkpointOf(execution, 0));
    isValid_ = wasValid;
    sameLights = isValid_ && emitters == walks_.emitters();
    walks_.setSource(std::move(emitters), plan);
  }
  if (!sameLights || !samePlan || !canRepair(objects, settings))
  {
    return FrameChange::Fresh;
  }
  if (hasReplaced(objects, objects_))
  {
    return FrameChange::Replace;
  }
  const std::vector<bool> moved = findMoved(objects, objects_);
  const bool forgetsHits = settings_.cacheStaticHits && !settings.cacheStaticHits;
  return stale() || forgetsHits || std::find(moved.begin(), moved.end(), true) != moved.end()
    ? FrameChange::Motion
    : FrameChange::Still;
}

bool IrradianceEngine::canRepair(const SceneObjects& objects, const EngineSettings& settings) const
{
  // Rounds of walks that were not stored cannot be taken back.
  const bool mayKeepAll = !objects.dynamicObjects.empty() || settings.targetRelativeError == 0;
  return isValid_ && settings.verify && settings_.verify && mayKeepAll &&
    (!settings.keepPhotons || keepsPhotons()) && settings.seed == settings_.seed &&
    settings.separateSides == settings_.separateSides && differsOnlyByMotion(objects, objects_) &&
    (!walks_.hasStale() || !hasReplaced(objects, objects_));
}

void IrradianceEngine::commitScene(const std::vector<bool>& moved, Execution& execution)
{
  scene_.setTraversalMode(settings_.traversalMode);
  scene_.setStatic(objects_.staticObject.body);
  scene_.setDynamic(objects_.dynamicBodies());
  scene_.setPointSources(walks_.emitters().pointBounds());
  const Checkpoint checkpoint = checkpointOf(execution, 0);
  scene_.commit(moved, checkpoint);
  contacts_.update(objects_, checkpoint);
}

void IrradianceEngine::start(Execution& execution)
{
  commitScene({}, execution);
  walks_.start(space(), execution);
  forgetPhotonStores();
}

void IrradianceEngine::follow(const std::vector<bool>& moved, Execution& execution)
{
  const bool hasMotion = std::find(moved.begin(), moved.end(), true) != moved.end();
  if (hasMotion)
  {
    const Stopwatch stopwatch;
    commitScene(moved, execution);
    statistics_.verifySeconds = stopwatch.seconds();
  }
  if (walks_.isEmpty() || !(hasMotion || walks_.hasStale()))
  {
    return;
  }
  PhotonChanges changes;
  walks_.follow(moved, space(), specularPhotons_ || leafPhotons_ ? &changes : nullptr, execution);
  const Stopwatch stopwatch;
  updatePhotonStores(changes, execution);
  statistics_.repairSeconds = stopwatch.seconds();
}

void IrradianceEngine::shootRound(std::size_t round, Execution& execution)
{
  forgetPhotonStores(); // they are collected again, with this round
  walks_.shootRound(round, keepsPhotons(), space(), execution);
}

void IrradianceEngine::shootOnce(bool isFresh, Execution& execution)
{
  if (isFresh)
  {
    shootRound(0, execution);
  }
  reached_ = walks_.hasStale() ? std::numeric_limits<double>::quiet_NaN() : 0;
  ProgressSpan end(execution, 1, 1);
  spreadSums(sums().rounds(), end);
}

void IrradianceEngine::reachTarget(Execution& execution)
{
  const std::vector<WalkRound>& plan = this->plan().rounds();
  double progress = 0;
  std::size_t rounds = 0;
  do
  {
    if (rounds == sums().rounds())
    {
      // Fewer walks may have been expected before. Progress then waits rather than going back.
      const double expected = expectedWalks(rounds);
      const double from = std::max(progress, plan[rounds].firstWalk / expected);
      progress = std::max(from, plan[rounds].endWalk / expected);
      ProgressSpan span(execution, from, progress);
      shootRound(rounds, span);
    }
    ++rounds;
    checkReceived(balance());
    ProgressSpan still(execution, progress, progress);
    spreadSums(rounds, still);
    reached_ = errorEstimate(rounds).relativeErrorOfMostArea(cells_, still);
  } while (reached_ > settings_.targetRelativeError && rounds < plan.size());
  if (history().size() > plan[rounds - 1].endBlock)
  {
    forgetPhotonStores();
  }
  walks_.dropRounds(rounds, checkpointOf(execution, progress));
  if (!execution.reportProgress(1))
  {
    throw Interrupted();
  }
}

double IrradianceEngine::expectedWalks(std::size_t rounds) const
{
  const std::vector<WalkRound>& plan = this->plan().rounds();
  const double most = this->plan().most(), next = plan[rounds].endWalk;
  if (rounds == 0)
  {
    return most;
  }
  // The error falls with the square root of the number of walks.
  const double ratio = reached_ / settings_.targetRelativeError;
  return std::clamp(plan[rounds - 1].endWalk * ratio * ratio, next, most);
}

void IrradianceEngine::spreadSums(std::size_t rounds, Execution& execution)
{
  if (!isSpread())
  {
    spread_ = {};
    spreadSums_ = {};
    spreadStaleSums_ = {};
    return;
  }
  spread_.update(objects_, sums(), rounds, settings_.spreadPhotons,
    static_cast<double>(walks_.emitters().photon()), execution);
  spreadSums_ = spread_.spread(objects_, sums(), rounds, execution);
  if (stale())
  {
    spreadStaleSums_ = spread_.spread(objects_, stale()->sums(), 1, execution);
  }
}

ErrorEstimate IrradianceEngine::errorEstimate(std::size_t rounds) const
{
  const auto photon = walks_.emitters().largestStart();
  return isSpread() ? ErrorEstimate(spreadSums_, spreadSums_.plan(), 1, photon, &spread_)
                    : ErrorEstimate(sums(), plan(), rounds, photon);
}

double IrradianceEngine::irradiance(const CellSide& cell, int band) const
{
  if (settings_.cellEstimate == CellEstimate::Nearest)
  {
    const double density = nearestCells_.density(cell, band);
    if (!std::isnan(density))
    {
      return watts(density);
    }
  }
  const CellSums& sums = isSpread() ? spreadSums_ : this->sums();
  const double area = cells_.area(cell);
  return area > 0 ? watts(sums.sum(cell, band)) / area : 0.0;
}

double IrradianceEngine::staleIrradiance(const CellSide& cell, int band) const
{
  const double area = cells_.area(cell);
  if (!stale() || !(area > 0))
  {
    return 0;
  }
  const auto quanta = [&](const CellSums& sums) { return sums.sum(cell, band); };
  // What is spread is rounded at each step, so the part may come out larger than the whole.
  return watts(isSpread() ? std::min(quanta(spreadStaleSums_), quanta(spreadSums_))
                          : quanta(stale()->sums())) /
    area;
}

const SpecularPhotons& IrradianceEngine::specularPhotons(Execution& execution)
{
  return storeOf(specularPhotons_, execution);
}

const LeafPhotons& IrradianceEngine::leafPhotons(Execution& execution)
{
  return storeOf(leafPhotons_, execution);
}

template <class Store>
const Store& IrradianceEngine::storeOf(std::unique_ptr<Store>& store, Execution& execution)
{
  assert(keepsPhotons());
  if (!store)
  {
    walks_.findSides(space(), execution);
    auto photons = std::make_unique<Store>(objects_);
    photons->add(history(), 0, history().size(), execution);
    store = std::move(photons);
  }
  return *store;
}

const Surfaces& IrradianceEngine::surfaces(Execution& execution)
{
  surfaces_.update(objects_, checkpointOf(execution, 0));
  return surfaces_;
}

void IrradianceEngine::forgetPhotonStores()
{
  specularPhotons_.reset();
  leafPhotons_.reset();
  nearestCells_ = {};
}

void IrradianceEngine::updatePhotonStores(const PhotonChanges& changes, Execution& execution)
{
  if (specularPhotons_)
  {
    specularPhotons_->apply(changes, execution);
  }
  if (leafPhotons_)
  {
    leafPhotons_->apply(objects_, history(), changes, execution);
    nearestCells_.note(changes);
  }
}

void IrradianceEngine::estimateNearest(bool isSame, Execution& execution)
{
  const bool isAsked = settings_.cellEstimate == CellEstimate::Nearest;
  const auto count = static_cast<std::uint32_t>(std::max(settings_.spreadPhotons, 2.0));
  if (isAsked && isSame && nearestCells_.count() == count)
  {
    return;
  }
  if (!isAsked)
  {
    nearestCells_ = {};
    return;
  }
  const LeafPhotons& leaves = leafPhotons(execution);
  const NearestPhotons nearest(leaves, surfaces(execution), objects_, history());
  nearestCells_.update(
    nearest, sums(), count, static_cast<double>(walks_.emitters().photon()), execution);
}

}
