// SPDX-License-Identifier: BSD-3-Clause
#include "IrradianceEngine.h"

#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"
#include "History/PointFrame.h"
#include "Repair/SceneChange.h"
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

WalkPlan planOf(const EngineSettings& settings)
{
  assert(settings.replicates >= (settings.targetRelativeError > 0 ? 2u : 1u));
  return { settings.numberOfWalks,
    settings.targetRelativeError > 0 ? settings.maximumNumberOfWalks : settings.numberOfWalks,
    settings.replicates };
}

}

void IrradianceEngine::update(
  const SceneObjects& objects, const EngineSettings& settings, Execution& execution)
{
  const WalkPlan plan = planOf(settings);
  // A wall that a point light touches may have moved.
  bool sameLights = isValid_ && plan == plan_ && areLightsUnchanged(objects, objects_) &&
    emitters_.pointBounds().isEmpty();
  if (!sameLights)
  {
    const bool wasValid = std::exchange(isValid_, false);
    EmitterTable emitters(objects, plan.most(), &contacts_, checkpointOf(execution, 0));
    isValid_ = wasValid;
    sameLights = isValid_ && emitters == emitters_;
    emitters_ = std::move(emitters);
  }
  const bool repair = sameLights && canRepair(objects, settings);
  const std::vector<bool> moved = repair ? findMoved(objects, objects_) : std::vector<bool>();
  const bool replaces = repair && hasReplaced(objects, objects_);
  const bool forgetsHits = settings_.cacheStaticHits && !settings.cacheStaticHits;
  const bool isStill = repair && !replaces && !stale_ && !forgetsHits &&
    std::none_of(moved.begin(), moved.end(), [](bool isMoved) { return isMoved; });
  const std::size_t bytes = statistics_.historyBytes, blocks = history_.size();
  isValid_ = false; // until the end is reached
  ++state_;
  objects_ = objects;
  cells_.update(objects_, checkpointOf(execution, 0));
  surfaces_.forgetOthers(objects_);
  // What is stored stays, for those who ask again.
  const bool keepsPhotons = settings.keepPhotons || (repair && settings_.keepPhotons);
  settings_ = settings;
  settings_.keepPhotons = keepsPhotons;
  plan_ = plan;
  statistics_ = {};
  const bool hasTarget = settings.targetRelativeError > 0;
  const double begun = repair ? (hasTarget ? 0.5 : 1) : 0; // what comes after a repair is not known
  ProgressSpan first(execution, 0, begun), rest(execution, begun, 1);
  if (replaces)
  {
    sums_.replace(objects_, checkpointOf(execution, 0));
    stale_.reset(); // nothing is stale, see canRepair()
    forgetPhotonStores();
  }
  if (repair)
  {
    if (forgetsHits)
    {
      history_.forgetAllStaticHits();
    }
    verifyAndRepair(moved, first);
  }
  else
  {
    startAnew(execution);
  }
  const bool isStale = stale_ && !stale_->isEmpty();
  if (hasTarget && !isStale)
  {
    reachTarget(rest);
  }
  else
  {
    reached_ = isStale ? std::numeric_limits<double>::quiet_NaN() : 0;
    if (!repair)
    {
      shootRound(0, execution);
    }
    ProgressSpan atItsEnd(execution, 1, 1);
    spreadSums(sums_.rounds(), atItsEnd);
  }
  // Rounds may have been added or dropped.
  if (stale_ && stale_->isEmpty() && (!hasBudget() || stale_->numberOfBlocks() != history_.size()))
  {
    stale_.reset();
  }
  const bool isSame = isStill && history_.size() == blocks;
  ProgressSpan estimating(execution, 1, 1);
  estimateNearest(isSame, estimating);
  // To count them takes longer than all else where nothing has moved.
  statistics_.historyBytes = isSame ? bytes : historyBytes();
  isValid_ = true;
}

std::size_t IrradianceEngine::historyBytes() const
{
  const std::size_t others =
    (stale_ ? stale_->bytes() : 0) + repaired_.capacity() * sizeof(SegmentRef);
  return others + history_.bytes();
}

bool IrradianceEngine::canRepair(const SceneObjects& objects, const EngineSettings& settings) const
{
  // Rounds of walks that were not stored cannot be taken back.
  const bool mayKeepAll = !objects.dynamicObjects.empty() || settings.targetRelativeError == 0;
  return isValid_ && settings.verify && settings_.verify && mayKeepAll &&
    (!settings.keepPhotons || keepsPhotons()) && planOf(settings) == plan_ &&
    settings.seed == settings_.seed && settings.separateSides == settings_.separateSides &&
    differsOnlyByMotion(objects, objects_) &&
    (!stale_ || stale_->isEmpty() || !hasReplaced(objects, objects_));
}

void IrradianceEngine::commitScene(const std::vector<bool>& moved, Execution& execution)
{
  scene_.setTraversalMode(settings_.traversalMode);
  scene_.setStatic(objects_.staticObject.body);
  scene_.setDynamic(objects_.dynamicBodies());
  scene_.setPointSources(emitters_.pointBounds());
  const Checkpoint checkpoint = checkpointOf(execution, 0);
  scene_.commit(moved, checkpoint);
  contacts_.update(objects_, checkpoint);
}

void IrradianceEngine::startAnew(Execution& execution)
{
  commitScene({}, execution);
  sums_ = CellSums(objects_, settings_.separateSides ? 2 : 1, plan_, 0);
  balance_ = {};
  const Checkpoint checkpoint = checkpointOf(execution, 0);
  while (history_.size() > 0) // freeing many walks takes a while
  {
    history_.removeLast();
    checkpoint();
  }
  history_ = WalkHistory(plan_, pointFrame(objects_, walkBounds()),
    objects_.staticObject.material->bands, Power{ { emitters_.photon() } });
  stale_.reset();
  repaired_ = {};
  forgetPhotonStores();
  hasSides_ = settings_.keepPhotons || settings_.separateSides;
  clearance_ = scene_.clearance();
  pointReach_ = reachInFrame();
}

void IrradianceEngine::shootRound(std::size_t round, Execution& execution)
{
  const Clock::time_point start = Clock::now();
  const WalkRound& walks = plan_.rounds()[round];
  const bool keep = settings_.keepPhotons || (settings_.verify && !objects_.dynamicObjects.empty());
  forgetPhotonStores(); // they are collected again, with this round
  sums_.setRounds(round + 1, checkpointOf(execution, 0));
  for (std::size_t block = walks.firstBlock; keep && block < walks.endBlock; ++block)
  {
    history_.append();
  }
  shootBlocks(walks, keep, execution);
  statistics_.shootSeconds += secondsSince(start);
}

void IrradianceEngine::shootBlocks(const WalkRound& walks, bool isStored, Execution& execution)
{
  const SobolSequence samples = this->samples();
  const WalkShooter shooter = this->shooter(samples);
  SharedBalance total(balance_);
  std::vector<std::unique_ptr<WalkBatch>> open(walks.endBlock - walks.firstBlock);
  SlicedPass pass{ emitters_.isEmpty() ? 0 : open.size(), {} };
  pass.work = [&](std::size_t i, const Deadline& deadline) {
    const std::size_t block = walks.firstBlock + i;
    if (!open[i])
    {
      std::vector<std::uint32_t> numbers(plan_.walksIn(block));
      std::iota(numbers.begin(), numbers.end(), plan_.firstWalkOf(block));
      open[i] =
        std::make_unique<WalkBatch>(shooter, isStored ? &history_.frame() : nullptr, hasSides_);
      open[i]->shoot(numbers);
    }
    PowerBalance balance;
    WalkTally tally(sums_, balance);
    const bool isDone = open[i]->run(tally, [&] { return deadline.hasPassed(); });
    if (isDone)
    {
      balance.emitted += open[i]->emitted();
      if (isStored)
      {
        history_.blockOf(plan_.firstWalkOf(block)).makeRoom(open[i]->sizes());
        open[i]->store(history_);
      }
      open[i].reset();
    }
    total.add(balance);
    return isDone;
  };
  pass.run(execution);
}

Box IrradianceEngine::walkBounds() const
{
  Box bounds = scene_.bounds();
  bounds.add(emitters_.pointBounds());
  return bounds;
}

double IrradianceEngine::reachInFrame() const
{
  const Box world = walkBounds();
  const UnitFrame& frame = history_.frame();
  return std::max(
           frame(world.lower).cwiseAbs().maxCoeff(), frame(world.upper).cwiseAbs().maxCoeff()) +
    clearance_ * frame.scale;
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
  spread_.update(objects_, sums_, rounds, settings_.spreadPhotons,
    static_cast<double>(emitters_.photon()), execution);
  spreadSums_ = spread_.spread(objects_, sums_, rounds, execution);
  if (stale_)
  {
    spreadStaleSums_ = spread_.spread(objects_, stale_->sums(), 1, execution);
  }
}

ErrorEstimate IrradianceEngine::errorEstimate(std::size_t rounds) const
{
  const auto photon = emitters_.largestStart();
  return isSpread() ? ErrorEstimate(spreadSums_, spreadSums_.plan(), 1, photon, &spread_)
                    : ErrorEstimate(sums_, plan_, rounds, photon);
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
  const CellSums& sums = isSpread() ? spreadSums_ : sums_;
  const double area = cells_.area(cell);
  return area > 0 ? watts(sums.sum(cell, band)) / area : 0.0;
}

double IrradianceEngine::staleIrradiance(const CellSide& cell, int band) const
{
  const double area = cells_.area(cell);
  if (!stale_ || !(area > 0))
  {
    return 0;
  }
  const auto quanta = [&](const CellSums& sums) { return sums.sum(cell, band); };
  // What is spread is rounded at each step, so the part may come out larger than the whole.
  return watts(isSpread() ? std::min(quanta(spreadStaleSums_), quanta(spreadSums_))
                          : quanta(stale_->sums())) /
    area;
}

}
