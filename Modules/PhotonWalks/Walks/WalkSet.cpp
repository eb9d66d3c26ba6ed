// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSet.h"

#include "Shooting/StoredRays.h"

#include <atomic>
#include <iterator>
#include <mutex>
#include <numeric>
#include <optional>

namespace irradiance
{

namespace
{

EnclosingEllipsoid enclose(const Box& box)
{
  const Eigen::AlignedBox3d all(box.lower, box.upper);
  std::vector<Vector3> corners(8);
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
  {
    corners[corner] = all.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
  }
  return encloseByEllipsoid(corners);
}

}

void WalkSet::start(const Frame& frame, Execution& execution)
{
  balance_ = {};
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  while (history_.size() > 0) // freeing many walks takes a while
  {
    history_.removeLast();
    cancelPoint();
  }
  blocks_ = dealt(execution.ranks(), settings_.allOnEachRank);
  gathered_.reset();
  CellPart gatherers;
  areCellsRenumbered_ = false;
  if (source_.cells && !lights().isEmpty())
  {
    gathered_ = std::make_unique<DirectRounds>(
      DirectGather::Settings{ *source_.cells, source_.plan.replicates().count(), source_.firstWalk,
        source_.quantaPerStart, source_.walksPerSample, source_.fewest, settings_.seed });
    gatherers = *source_.cells;
  }
  sums_ = CellSums(frame.objects, plan(), 0, gatherers);
  const int bands = frame.objects.staticObject.material->bands;
  Box bounds = frame.scene.bounds();
  bounds.add(lights().boundsInAir());
  history_ = {};
  history_ = WalkHistory(plan(), pointGrid(frame.objects, bounds, cancelPoint),
    frame.triangles.numbers(), bands, powerPerWalk(), arenaFor(bands), blocks_);
  stale_.reset();
  unborn_.clear();
  repaired_ = {};
}

void WalkSet::beginRound(bool isStored, const Frame& frame, Execution& execution)
{
  const std::size_t round = sums_.rounds();
  ProgressSpan beginning(execution, 0, 0);
  const CancelPoint cancelPoint = cancelPointOf(beginning, 0);
  if (gathered_)
  {
    const WalkRound& walks = source_.plan.rounds()[round];
    gathered_->append(frame, *source_.lamps, walks.endWalk - walks.firstWalk, beginning);
    history_.extend(plan());
    sums_.setRounds(plan(), cancelPoint);
    gathered_->rounds()[round]->addTo(totals(), 1, cancelPoint);
  }
  else
  {
    sums_.setRounds(round + 1, cancelPoint);
  }
  while (isStored && history_.size() < blocks_.before(plan().rounds()[round].endBlock))
  {
    history_.append();
  }
}

void WalkSet::shootBlocks(
  const WalkRound& walks, bool isStored, const Frame& frame, Execution& execution)
{
  constexpr std::size_t kBlocksTogether = WalkFront::kUsualSize / WalkPlan::kWalksPerBlock;
  const double start = steadySeconds();
  const SobolSequence samples = this->samples();
  const WalkTracer tracer = this->tracer(frame, samples);
  std::mutex mutex;
  std::atomic<std::int64_t> shot{ 0 };
  const std::size_t first = blocks_.before(walks.firstBlock), end = blocks_.before(walks.endBlock);
  const std::size_t units =
    lights().isEmpty() ? 0 : (end - first + kBlocksTogether - 1) / kBlocksTogether;
  std::vector<std::unique_ptr<WalkBatch>> open(units);
  runSliced(units, execution, [&](std::size_t unit, const auto& hasToStop) {
    PowerBalance balance;
    bool isDone = true;
    {
      constexpr std::size_t kUsualPhotons = 4 * WalkFront::kUsualSize;
      FrontTally tally(frame.triangles, sums_, balance, tracer.powerPerWalk(), kUsualPhotons);
      if (!open[unit])
      {
        open[unit] = batches_->take();
        open[unit]->begin(tracer, isStored ? &history_ : nullptr);
        const std::size_t begin = first + unit * kBlocksTogether;
        fill(*open[unit], begin, std::min(begin + kBlocksTogether, end), walks.firstWalk,
          tracer.stages().bands());
        shot += static_cast<std::int64_t>(open[unit]->front().size);
        open[unit]->start(tally);
      }
      isDone = open[unit]->run(tally, hasToStop);
    }
    if (isDone)
    {
      batches_->giveBack(std::move(open[unit]));
    }
    addLocked(balance, balance_, mutex);
    return isDone;
  });
  statistics_.shotWalks += shot;
  statistics_.shootSeconds += steadySeconds() - start;
}

void WalkSet::fill(
  WalkBatch& batch, std::size_t first, std::size_t end, std::uint32_t beginning, int bands) const
{
  WalkFront& front = batch.front();
  for (std::size_t i = first; i < end; ++i)
  {
    const std::uint32_t ofBlock = plan().firstWalkOf(blocks_[i]);
    const std::uint32_t firstWalk = std::max(ofBlock, beginning);
    const std::uint32_t count = ofBlock + plan().walksIn(blocks_[i]) - firstWalk;
    front.reserve(front.size + count, bands);
    std::uint32_t* const begin = front.walk.data() + front.size;
    std::iota(begin, begin + count, firstWalk);
    const auto isUnborn = [&](std::uint32_t walk) { return !gathered_->isBorn(walk); };
    const auto born = static_cast<std::size_t>(
      (gathered_ ? std::remove_if(begin, begin + count, isUnborn) : begin + count) - begin);
    std::fill_n(front.block.data() + front.size, born, static_cast<std::uint32_t>(i));
    front.size += born;
  }
}

void WalkSet::dropBlocks(
  std::size_t kept, const SceneTriangles& triangles, const CancelPoint& cancelPoint)
{
  const int bands = history_.bands();
  WalkFront old;
  while (history_.size() > kept)
  {
    const BounceBlock& last = history_.block(history_.size() - 1);
    old.size = 0;
    Power starting;
    last.forEach([&](std::uint32_t slot) {
      addStored(last, slot, bands, old);
      starting += slot < last.numberOfWalks() ? last.power(slot) : Power{};
    });
    FrontTally tally(triangles, sums_, balance_, history_.powerPerWalk(), old.size);
    tally.remove(old, starting);
    gathered_ ? tally.unrelease(starting) : tally.unemit(starting);
    history_.removeLast();
    cancelPoint();
  }
}

void WalkSet::resize(
  bool areStored, const SceneTriangles& triangles, const CancelPoint& cancelPoint)
{
  const std::uint32_t before = sums_.plan().most();
  const WalkRound& round = plan().rounds().front();
  missing_ = round;
  missing_.firstBlock = std::min(before, plan().most()) / WalkPlan::kWalksPerBlock;
  // A stored block of fewer walks than it is to have is shot again.
  missing_.firstWalk +=
    areStored ? static_cast<std::uint32_t>(missing_.firstBlock) * WalkPlan::kWalksPerBlock : before;
  dropBlocks(blocks_.before(missing_.firstBlock), triangles, cancelPoint);
  const std::int64_t quantaBefore = history_.powerPerWalk()[0], quanta = source_.quantaPerWalk();
  sums_.rescale(plan(), quantaBefore, quanta);
  if (quanta != quantaBefore) // then all photons are alike
  {
    balance_.rescale(quantaBefore, quanta);
  }
  history_.replan(plan(), powerPerWalk());
  while (areStored && history_.size() < blocks_.before(round.endBlock))
  {
    history_.append();
  }
  stale_.reset(); // nothing is stale
}

void WalkSet::follow(const Frame& frame, PhotonChanges* changes, Execution& execution)
{
  const double start = steadySeconds();
  const bool startsAgain =
    gathered_ && frame.hasChanged() && (hasOtherCells(frame) || areCellsRenumbered_);
  if (startsAgain)
  {
    startAgain(frame, execution);
  }
  else if (gathered_ && hasMotion(frame.moved))
  {
    followGathered(frame, execution);
  }
  const double gatherSeconds = steadySeconds() - start;
  // Walks that start again are shot in this frame, so nothing has changed for them.
  startsAgain
    ? followWalks(std::vector<bool>(frame.moved.size(), false), {}, frame, changes, execution)
    : followWalks(frame.moved, frame.repainted, frame, changes, execution);
  statistics_.verifySeconds += gathered_ && frame.hasChanged() ? gatherSeconds : 0;
}

void WalkSet::followWalks(const std::vector<bool>& moved, const Repainted& repainted,
  const Frame& frame, PhotonChanges* changes, Execution& execution)
{
  const bool hasChanged = hasMotion(moved) || !repainted.empty() || !frame.kept.areAll();
  const SobolSequence samples = this->samples();
  const WalkTracer tracer = this->tracer(frame, samples);
  const BounceScan scan = scanOf(moved, frame);
  const ChangedReflections reflections(frame.objects, history_.numbers(), samples, repainted);
  const WalkVerifier verifier(
    tracer, history_, moved, scan, reflections, frame.kept, settings_.cacheStaticHits);
  repaired_ = {};
  WalkRepair repair({ tracer, verifier, history_, sums_, balance_, *repairs_, changes,
    settings_.listRepaired ? &repaired_ : nullptr });
  if (hasBudget() && !stale_)
  {
    stale_ = std::make_unique<StaleWalks>(frame.objects, history_.size(), samples);
    staleRounds_ = sums_.rounds();
  }
  else if (stale_ && !frame.repainted.empty())
  {
    stale_->repaint(frame.objects, history_);
  }
  if (stale_ && stale_->isEmpty())
  {
    stale_->setMayMeetOthers(frame.kept.mayMeetOthers());
  }
  // Progress between verification, births and repair.
  const double verified = !hasChanged ? 0 : stale_ ? 0.5 : 1;
  const double born = !stale_ ? 1 : unborn_.empty() ? verified : 0.75;
  ProgressSpan verification(execution, 0, verified), bearing(execution, verified, born),
    rest(execution, born, 1);
  const double start = steadySeconds();
  if (hasChanged && stale_)
  {
    repair.verifyAndMark(*stale_, verification);
    statistics_.verifySeconds = steadySeconds() - start;
  }
  else if (hasChanged)
  {
    repair.verifyAndRepair(verification);
    // Both take turns on each thread.
    const WalkRepair::Figures& figures = repair.figures();
    const double share =
      figures.verifySeconds / (figures.verifySeconds + figures.repairSeconds + 1e-12);
    statistics_.verifySeconds = share * (steadySeconds() - start);
    statistics_.repairSeconds = (1 - share) * (steadySeconds() - start);
  }
  std::optional<TimeBudget> limit;
  if (hasBudget())
  {
    limit.emplace(execution, settings_.repairTimeBudget);
  }
  TimeBudget* const budget = limit ? &*limit : nullptr;
  const double repairStart = steadySeconds();
  unborn_ = repair.shootBorn(unborn_, budget, bearing);
  if (stale_)
  {
    repair.repair(*stale_, budget, rest);
    stale_->setUnborn(unborn_, [&](std::uint32_t walk) { return gathered_->powerOf(walk); });
  }
  statistics_.repairSeconds += budget ? budget->elapsed() : steadySeconds() - repairStart;
  std::sort(repaired_.begin(), repaired_.end());
  statistics_.suspectSegments = verifier.numberOfSuspects();
  statistics_.invalidWalks += verifier.numberFound();
  statistics_.repairedSegments += repair.figures().repairedSegments;
}

template <class Chosen>
std::vector<std::uint32_t> WalkSet::walksOfBlocks(
  const Chosen& isChosen, const CancelPoint& cancelPoint) const
{
  std::vector<std::uint32_t> chosen;
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t i = 0; i < history_.size(); ++i)
  {
    const BounceBlock& block = history_.block(i);
    for (std::uint32_t walk = block.firstWalk(); walk < block.endWalk(); ++walk)
    {
      pace.step();
      if (isChosen(block, walk))
      {
        chosen.push_back(walk);
      }
    }
  }
  return chosen;
}

void WalkSet::startAgain(const Frame& frame, Execution& execution)
{
  const std::size_t rounds = sums_.rounds();
  const auto isStored = [](const BounceBlock& block, std::uint32_t walk) {
    return block.begin(walk) != BounceBlock::kNone;
  };
  statistics_.invalidWalks = static_cast<std::int64_t>(walksOfBlocks(isStored, {}).size());
  start(frame, execution);
  while (sums_.rounds() < rounds)
  {
    beginRound(true, frame, execution); // else there is nothing to follow
  }
  unborn_ = walksOfBlocks(
    [this](const BounceBlock&, std::uint32_t walk) { return gathered_->isBorn(walk); },
    cancelPointOf(execution, 0));
}

void WalkSet::followGathered(const Frame& frame, Execution& execution)
{
  ProgressSpan beginning(execution, 0, 0);
  std::vector<std::uint32_t> born, gone;
  for (const std::uint32_t walk : gathered_->follow(frame, totals(), beginning))
  {
    if (isDealt(walk))
    {
      (gathered_->isBorn(walk) ? born : gone).push_back(walk);
    }
  }
  // Those that are still to be born are not stored.
  std::vector<std::uint32_t> stored, waiting;
  std::set_difference(
    gone.begin(), gone.end(), unborn_.begin(), unborn_.end(), std::back_inserter(stored));
  std::set_difference(
    unborn_.begin(), unborn_.end(), gone.begin(), gone.end(), std::back_inserter(waiting));
  unborn_.clear();
  std::merge(waiting.begin(), waiting.end(), born.begin(), born.end(), std::back_inserter(unborn_));
  statistics_.invalidWalks = static_cast<std::int64_t>(stored.size());
  WalkFront old;
  Power starting;
  const CancelPoint cancelPoint = cancelPointOf(beginning, 0);
  ThrottledCancelPoint pace(cancelPoint);
  for (const std::uint32_t walk : stored)
  {
    pace.step(16);
    if (stale_)
    {
      stale_->forget(history_, walk);
    }
    const SegmentPlace place = history_.placeOf({ walk, 0 });
    starting += history_.power(place);
    history_.removeFrom(place, [&](std::uint32_t slot) {
      addStored(history_.block(place.block), slot, history_.bands(), old);
    });
  }
  FrontTally tally(frame.triangles, sums_, balance_, powerPerWalk(), old.size);
  tally.remove(old, starting);
  tally.unrelease(starting);
}

BounceScan WalkSet::scanOf(const std::vector<bool>& moved, const Frame& frame) const
{
  BounceScan scan(history_.grid());
  for (const Box& part : frame.kept.added)
  {
    const RigidObject& body = *frame.objects.staticObject.body;
    const double slack = body.tree().slack() / body.tree().frame().scale;
    scan.addBody({ enclose(part), part, {}, frame.scene.clearance() + slack });
  }
  if (frame.kept.mayTouch)
  {
    scan.addAll();
  }
  // What touches a segment's start may lie behind it.
  const double clearance = frame.contacts.hasDynamic() ? frame.scene.clearance() : 0;
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    const SceneObject& object = frame.objects.dynamicObjects[i];
    if (moved[i] && !object.body->mesh().isEmpty())
    {
      scan.addMoved(i + 1);
      if (!object.isEmpty())
      {
        const OwnBox own{ object.body->mesh().bounds(), object.worldFromObject,
          frame.scene.shadowPad(i, clearance) };
        scan.addBody(frame.scene.shadowBound(i, clearance), &own);
      }
    }
  }
  return scan;
}

void WalkSet::replaceCells(const Frame& frame, const CancelPoint& cancelPoint)
{
  if (!frame.kept.areAll())
  {
    history_.forgetHiddenHits();
  }
  // What hit parts that are gone counts as escaped until it is cast again.
  for (std::size_t i = 0; !frame.kept.areAll() && i < history_.size(); ++i)
  {
    BounceBlock& block = history_.block(i);
    block.forEach([&](std::uint32_t slot) {
      if (frame.kept.isGone(block.triangle(slot)))
      {
        const Power carried = block.power(slot);
        balance_.absorbed -= carried;
        balance_.received -= carried.total();
        balance_.escaped += carried;
        block.lose(slot);
      }
    });
    cancelPoint();
  }
  sums_.replace(frame.objects, frame.kept.staticCells, cancelPoint);
  history_.renumber(frame.triangles.numbers(), frame.kept.triangles);
  stale_.reset(); // nothing is stale
  areCellsRenumbered_ = source_.isDynamic();
}

Bands WalkSet::largestStart() const
{
  Bands largest = lights().largestStart();
  if (gathered_) // what is reflected may be of one band
  {
    std::transform(largest.begin(), largest.end(), largest.begin(), [&](double ofLight) {
      return ofLight > 0 ? static_cast<double>(source_.quantaPerStart) : 0.0;
    });
  }
  return largest;
}

}
