// SPDX-License-Identifier: BSD-3-Clause
#include "Execution/ProgressSpan.h"
#include "Execution/SlicedPass.h"
#include "IrradianceEngine.h"
#include "Repair/WalkRepair.h"

#include <algorithm>
#include <optional>
#include <utility>

/// How the engine updates the stored walks when something has moved.
namespace irradiance
{

void IrradianceEngine::verifyAndRepair(const std::vector<bool>& moved, Execution& execution)
{
  const bool hasMotion = std::any_of(moved.begin(), moved.end(), [](bool b) { return b; });
  if (!hasMotion && (!stale_ || stale_->isEmpty()))
  {
    return;
  }
  if (emitters_.isEmpty()) // there are no walks, but others look at the scene
  {
    commitScene(moved, execution);
    return;
  }
  Clock::time_point start = Clock::now();
  const double verified = hasMotion ? 0.5 : 0; // progress between verification and repair
  ProgressSpan verification(execution, 0, verified), rest(execution, verified, 1);
  const SobolSequence samples = this->samples();
  const WalkShooter shooter = this->shooter(samples);
  std::vector<std::vector<StaleSegment>> found;
  if (hasMotion)
  {
    commitScene(moved, verification);
    found = verify(shooter, moved, verification);
  }
  if (hasBudget() && !stale_)
  {
    stale_ = std::make_unique<StaleWalks>(
      objects_, settings_.separateSides ? 2 : 1, history_.size(), samples);
  }
  if (stale_)
  {
    ProgressSpan atItsEnd(verification, 1, 1);
    stale_->add(found, history_, atItsEnd);
  }
  statistics_.verifySeconds = hasMotion ? secondsSince(start) : 0;

  start = Clock::now();
  std::optional<TimeBudget> budget;
  if (hasBudget())
  {
    budget.emplace(execution, settings_.repairTimeBudget);
  }
  PhotonChanges changes;
  repaired_ = {};
  WalkRepair repair({ shooter, history_, sums_, balance_, settings_.cacheStaticHits, hasSides_,
    found, stale_.get(), budget ? &*budget : nullptr, hasPhotonStores() ? &changes : nullptr,
    settings_.listRepaired ? &repaired_ : nullptr });
  statistics_.repairedSegments = repair.run(rest);
  updatePhotonStores(changes, execution);
  statistics_.repairSeconds = budget ? budget->elapsed() : secondsSince(start);
}

std::vector<std::vector<StaleSegment>> IrradianceEngine::verify(
  const WalkShooter& shooter, const std::vector<bool>& moved, Execution& execution)
{
  // Stored points may lie where objects were in earlier frames.
  clearance_ = std::max(clearance_, scene_.clearance());
  pointReach_ = std::max(pointReach_, reachInFrame());
  SegmentScan scan(history_.frame(), pointReach_);
  for (std::uint32_t i = 0; i < moved.size(); ++i)
  {
    const SceneObject& object = objects_.dynamicObjects[i];
    if (moved[i] && !object.body->mesh().isEmpty())
    {
      scan.addMoved(i + 1);
      if (!object.isEmpty())
      {
        scan.addBody(scene_.shadowBound(i, clearance_));
      }
    }
  }
  const WalkVerifier verifier(shooter, history_, moved, scan, clearance_);
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

}
