// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSet.h"

#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"
#include "Execution/Stopwatch.h"
#include "History/PointFrame.h"
#include "Repair/WalkRepair.h"
#include "Shooting/WalkBatch.h"
#include "Tally/WalkTally.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <optional>
#include <utility>

namespace irradiance
{

void WalkSet::setSettings(const WalkSettings& settings)
{
  if (settings_.cacheStaticHits && !settings.cacheStaticHits)
  {
    history_.forgetAllStaticHits();
  }
  settings_ = settings;
  statistics_ = {};
}

void WalkSet::start(const WalkSpace& space, Execution& execution)
{
  sums_ = CellSums(space.objects, sides(), plan(), 0);
  balance_ = {};
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  while (history_.size() > 0) // freeing many walks takes a while
  {
    history_.removeLast();
    cancelPoint();
  }
  blocks_ = dealt(execution.ranks(), settings_.allOnEachRank);
  history_ = WalkHistory(plan(), pointFrame(space.objects, bounds(space.scene)),
    space.objects.staticObject.material->bands, Power{ { lights().quantaPerWalk() } }, blocks_);
  stale_.reset();
  repaired_ = {};
  hasSides_ = settings_.keepPhotons || settings_.separateSides;
  clearance_ = space.scene.clearance();
  pointReach_ = reachInFrame(space.scene);
}

void WalkSet::shootRound(
  std::size_t round, bool isStored, const WalkSpace& space, Execution& execution)
{
  const Stopwatch stopwatch;
  const WalkRound& walks = plan().rounds()[round];
  sums_.setRounds(round + 1, cancelPointOf(execution, 0));
  while (isStored && history_.size() < blocks_.before(walks.endBlock))
  {
    history_.append();
  }
  shootBlocks(walks, isStored, space, execution);
  statistics_.shootSeconds += stopwatch.seconds();
}

void WalkSet::shootBlocks(
  const WalkRound& walks, bool isStored, const WalkSpace& space, Execution& execution)
{
  const SobolSequence samples = this->samples();
  const WalkTracer tracer = this->tracer(space, samples);
  SharedBalance total(balance_);
  const std::size_t first = blocks_.before(walks.firstBlock);
  std::vector<std::unique_ptr<WalkBatch>> open(blocks_.before(walks.endBlock) - first);
  SlicedPass pass{ lights().isEmpty() ? 0 : open.size(), {} };
  pass.work = [&](std::size_t i, const Deadline& deadline) {
    const std::size_t block = blocks_[first + i];
    if (!open[i])
    {
      std::vector<std::uint32_t> numbers(plan().walksIn(block));
      std::iota(numbers.begin(), numbers.end(), plan().firstWalkOf(block));
      open[i] =
        std::make_unique<WalkBatch>(tracer, isStored ? &history_.frame() : nullptr, hasSides_);
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
        history_.blockOf(plan().firstWalkOf(block)).makeRoom(open[i]->sizes());
        open[i]->store(history_);
      }
      open[i].reset();
    }
    total.add(balance);
    return isDone;
  };
  pass.run(execution);
}

void WalkSet::dropRounds(std::size_t kept, const CancelPoint& cancelPoint)
{
  const std::size_t blocks = blocks_.before(plan().rounds()[kept - 1].endBlock);
  while (history_.size() > blocks)
  {
    WalkTally tally(sums_, balance_);
    const WalkBlock& last = history_.block(history_.size() - 1);
    for (std::uint32_t walk = last.firstWalk(); walk < last.endWalk(); ++walk)
    {
      balance_.emitted -= last.power({ walk, 0 });
      tally.remove(last, { walk, 0 });
    }
    history_.removeLast();
    cancelPoint();
  }
  sums_.setRounds(kept, cancelPoint);
}

void WalkSet::follow(const std::vector<bool>& moved, const WalkSpace& space, PhotonChanges* changes,
  Execution& execution)
{
  const bool hasMotion = std::any_of(moved.begin(), moved.end(), [](bool b) { return b; });
  const double verified = hasMotion ? 0.5 : 0; // progress between verification and repair
  ProgressSpan verification(execution, 0, verified), rest(execution, verified, 1);
  const SobolSequence samples = this->samples();
  const WalkTracer tracer = this->tracer(space, samples);
  const Stopwatch stopwatch;
  Found found;
  if (hasMotion)
  {
    found = verify(tracer, moved, space, verification);
  }
  if (hasBudget() && !stale_)
  {
    stale_ = std::make_unique<StaleWalks>(space.objects, sides(), history_.size(), samples);
  }
  if (stale_)
  {
    ProgressSpan atItsEnd(verification, 1, 1);
    stale_->add(found, history_, atItsEnd);
  }
  statistics_.verifySeconds = hasMotion ? stopwatch.seconds() : 0;
  repair(tracer, found, changes, rest);
}

WalkSet::Found WalkSet::verify(const WalkTracer& tracer, const std::vector<bool>& moved,
  const WalkSpace& space, Execution& execution)
{
  // Stored points may lie where objects were in earlier frames.
  clearance_ = std::max(clearance_, space.scene.clearance());
  pointReach_ = std::max(pointReach_, reachInFrame(space.scene));
  SegmentScan scan(history_.frame(), pointReach_);
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    const SceneObject& object = space.objects.dynamicObjects[i];
    if (moved[i] && !object.body->mesh().isEmpty())
    {
      scan.addMoved(i + 1);
      if (!object.isEmpty())
      {
        scan.addBody(space.scene.shadowBound(i, clearance_));
      }
    }
  }
  const WalkVerifier verifier(tracer, history_, moved, scan, clearance_);
  Found stale(history_.size());
  std::vector<const StaleMarks*> known;
  for (std::size_t block = 0; stale_ && block < history_.size(); ++block)
  {
    known.push_back(&std::as_const(*stale_).marks(block));
  }
  constexpr std::size_t kBlocksPerUnit = 16; // in a row for a thread, which prefetches the next
  SlicedPass pass{ (stale.size() + kBlocksPerUnit - 1) / kBlocksPerUnit, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    verifier.find(
      unit * kBlocksPerUnit, std::min((unit + 1) * kBlocksPerUnit, stale.size()), known, stale);
    return true;
  };
  pass.run(execution);
  statistics_.suspectSegments = verifier.numberOfSuspects();
  for (const auto& found : stale)
  {
    statistics_.invalidWalks += static_cast<std::int64_t>(found.size());
  }
  return stale;
}

void WalkSet::repair(
  const WalkTracer& tracer, const Found& found, PhotonChanges* changes, Execution& execution)
{
  const Stopwatch stopwatch;
  std::optional<TimeBudget> budget;
  if (hasBudget())
  {
    budget.emplace(execution, settings_.repairTimeBudget);
  }
  repaired_ = {};
  WalkRepair repair(
    { tracer, history_, sums_, balance_, settings_.cacheStaticHits, hasSides_, found, stale_.get(),
      budget ? &*budget : nullptr, changes, settings_.listRepaired ? &repaired_ : nullptr });
  statistics_.repairedSegments = repair.run(execution);
  statistics_.repairSeconds = budget ? budget->elapsed() : stopwatch.seconds();
}

void WalkSet::replaceCells(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  sums_.replace(objects, cancelPoint);
  stale_.reset(); // nothing is stale
}

void WalkSet::findSides(const WalkSpace& space, Execution& execution)
{
  if (hasSides_)
  {
    return;
  }
  const SobolSequence samples = this->samples();
  const WalkTracer tracer = this->tracer(space, samples);
  SlicedPass pass{ history_.size(), {} };
  pass.work = [&](std::size_t i, const Deadline&) {
    WalkBlock& block = history_.block(i);
    std::vector<SegmentRef> ends;
    for (std::uint32_t walk = block.firstWalk(); walk < block.endWalk(); ++walk)
    {
      if (block.size(walk) > 0 && block.hit({ walk, block.size(walk) - 1 }))
      {
        ends.push_back({ walk, block.size(walk) - 1 });
      }
    }
    std::vector<Ray> rays(ends.size());
    tracer.raysOf(history_, ends, rays.data());
    for (std::size_t k = 0; k < ends.size(); ++k)
    {
      block.setSide(ends[k], tracer.sampler().hitsFront(rays[k], block.hit(ends[k]).id));
    }
    return true;
  };
  pass.run(execution);
  hasSides_ = true;
}

void WalkSet::forgetBudget()
{
  if (stale_ && stale_->isEmpty() && (!hasBudget() || stale_->numberOfBlocks() != history_.size()))
  {
    stale_.reset();
  }
}

std::size_t WalkSet::bytes() const
{
  return (stale_ ? stale_->bytes() : 0) + repaired_.capacity() * sizeof(SegmentRef) +
    history_.bytes();
}

Box WalkSet::bounds(const Scene& scene) const
{
  Box bounds = scene.bounds();
  bounds.add(lights().boundsInAir());
  return bounds;
}

double WalkSet::reachInFrame(const Scene& scene) const
{
  const Box world = bounds(scene);
  const UnitFrame& frame = history_.frame();
  return std::max(
           frame(world.lower).cwiseAbs().maxCoeff(), frame(world.upper).cwiseAbs().maxCoeff()) +
    clearance_ * frame.scale;
}

}
