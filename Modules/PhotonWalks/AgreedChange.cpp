// SPDX-License-Identifier: BSD-3-Clause
#include "AgreedChange.h"

#include "Surfaces/SceneHash.h"

namespace irradiance
{

namespace
{

/// Of all settings that change results.
std::uint64_t hashOf(const WalkSettings& walks, const EstimateSettings& estimate)
{
  Hash hash;
  hash.add(walks.numberOfWalks);
  hash.add(walks.seed);
  hash.add(walks.verify);
  hash.add(walks.gathersDirectLight);
  hash.add(walks.fewestSamples.small);
  hash.add(walks.fewestSamples.large);
  hash.add(walks.fewestSamples.mostOfSmall);
  hash.add(walks.keepPhotons);
  hash.add(walks.allOnEachRank);
  hash.add(walks.listRepaired);
  hash.add(walks.replicates);
  hash.add(walks.targetRelativeError);
  hash.add(walks.maximumNumberOfWalks);
  hash.add(walks.repairTimeBudget);
  hash.add(static_cast<int>(estimate.cellEstimate));
  hash.add(estimate.spreadPhotons);
  hash.add(estimate.gatherRays);
  hash.add(estimate.maximumGatherRays);
  hash.add(estimate.gathersEverywhere);
  hash.add(estimate.unbiasedGather);
  hash.add(estimate.separateSides);
  return hash.value();
}

}

FrameChange agreedChange(const FrameChange& change, const FrameInput& input, Ranks& ranks)
{
  if (!ranks.areSeveral())
  {
    return change;
  }
  ranks.expectSame(hashOf(input.walks, input.estimate), "other settings than on the first process");
  std::int64_t fresh = change.kind == FrameChange::Fresh ? 1 : 0;
  ranks.sum(&fresh, 1);
  FrameChange agreed = fresh > 0 ? FrameChange{ FrameChange::Fresh, {} } : change;
  Hash hash;
  hash.add(static_cast<int>(agreed.kind));
  addScene(input.objects, fresh > 0 ? nullptr : &input.before, hash);
  ranks.expectSame(hash.value(), "other inputs than on the first process");
  return agreed;
}

}
