// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"
#include "IrradianceEngine.h"
#include "Repair/BudgetedRepair.h"
#include "Shooting/WalkBatch.h"

#include <algorithm>
#include <atomic>
#include <utility>

/// How the engine updates the stored walks when something has moved.
namespace irradiance
{

void IrradianceEngine::verifyAndRepair(const std::vector<bool>& moved, Execution& execution)
{
  if (!settings_.cacheStaticHits)
  {
    std::for_each(
      history_.begin(), history_.end(), [](WalkBlock& block) { block.forgetAllStaticHits(); });
  }
  const bool hasMotion = std::any_of(moved.begin(), moved.end(), [](bool b) { return b; });
  if ((!hasMotion && (!stale_ || stale_->isEmpty())) || emitters_.isEmpty())
  {
    return;
  }
  Clock::time_point start = Clock::now();
  const double verified = hasMotion ? 0.5 : 0; // progress between verification and repair
  ProgressSpan verification(execution, 0, verified), rest(execution, verified, 1);
  const SobolSequence samples(settings_.seed, plan_.replicates());
  const WalkShooter shooter(scene_, objects_, emitters_, samples, &contacts_);
  std::vector<std::vector<StaleSegment>> found;
  if (hasMotion)
  {
    commitScene(moved, verification);
    found = verify(shooter, moved, verification);
  }
  if (hasBudget() && !stale_)
  {
    stale_ = std::make_unique<StaleWalks>(
      objects_, settings_.separateSides ? 2 : 1, plan_, history_.size(), samples);
  }
  if (stale_)
  {
    ProgressSpan atItsEnd(verification, 1, 1);
    stale_->add(found, history_, atItsEnd);
  }
  statistics_.verifySeconds = hasMotion ? secondsSince(start) : 0;

  start = Clock::now();
  if (stale_)
  {
    const double seconds = hasBudget() ? settings_.repairTimeBudget : kInfinity;
    SharedBalance balance(balance_);
    BudgetedRepair budgeted({ shooter, plan_, history_, pointFrame_, sums_, balance, *stale_, found,
                              settings_.cacheStaticHits },
      execution, seconds);
    statistics_.repairedSegments = budgeted.run(rest);
    statistics_.repairSeconds = budgeted.seconds();
  }
  else
  {
    repair(shooter, found, rest);
    statistics_.repairSeconds = secondsSince(start);
  }
}

std::vector<std::vector<StaleSegment>> IrradianceEngine::verify(
  const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution)
{
  // Stored points may lie where objects were in earlier frames.
  clearance_ = std::max(clearance_, scene_.clearance());
  pointReach_ = std::max(pointReach_, reachInFrame());
  SegmentScan scan(pointFrame_, pointReach_);
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    if (moved[i] && !objects_.dynamicObjects[i].body->mesh().isEmpty())
    {
      scan.addBody(scene_.shadowBound(i, clearance_));
      scan.addMoved(i + 1);
    }
  }
  const WalkVerifier verifier(shooter, plan_, history_, moved, scan, clearance_);
  std::vector<std::vector<StaleSegment>> stale(history_.size());
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

void IrradianceEngine::repair(const WalkShooter& shooter,
  const std::vector<std::vector<StaleSegment>>& stale, Execution& execution)
{
  std::atomic<std::int64_t> repaired{ 0 };
  // A block has few stale walks. Those of several blocks are shot together, as long as that leaves
  // enough batches for all threads.
  constexpr std::size_t kBatches = 32, kMostTogether = 16;
  BatchPass pass{ 0, history_.size(),
    std::clamp<std::size_t>(history_.size() / kBatches, 1, kMostTogether), &pointFrame_, {}, {} };
  pass.fill = [&](std::size_t block, WalkBatch& batch) {
    const WalkBlock& walks = history_[block];
    for (const StaleSegment& segment : stale[block])
    {
      const std::uint32_t walk = plan_.firstWalkOf(block) + segment.walkInBlock;
      batch.resume(walk, segment.bounce, segment.ray, segment.hit,
        walks.power(segment.walkInBlock, segment.bounce));
      for (std::uint32_t i = segment.bounce; i < walks.size(segment.walkInBlock); ++i)
      {
        const TriangleId id = walks.hit(segment.walkInBlock, i).id;
        if (id != TriangleId{})
        {
          sums_.prefetch(walk, id.object, sums_.cellOf(id)); // will be subtracted
        }
      }
    }
  };
  pass.finish = [&](const WalkBatch& batch, WalkTally& tally, PowerBalance&) {
    for (const WalkBatch::Tail& tail : batch.tails())
    {
      const WalkPlan::Place place = plan_.placeOf(tail.walk);
      tally.remove(history_[place.block], place.walkInBlock, tail.walk, tail.bounce);
    }
    batch.store(plan_, history_);
    repaired += batch.numberOfSegments();
  };
  run(pass, shooter, execution);
  for (std::size_t block = 0; block < stale.size(); ++block)
  {
    for (const StaleSegment& segment : stale[block])
    {
      history_[block].updateStaticHit(segment.walkInBlock, segment.bounce, segment.old, segment.hit,
        settings_.cacheStaticHits && !segment.wasTouching);
    }
  }
  statistics_.repairedSegments = repaired;
}

}
