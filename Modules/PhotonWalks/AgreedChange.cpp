// SPDX-License-Identifier: BSD-3-Clause
#include "AgreedChange.h"

#include "Surfaces/SceneHash.h"

namespace irradiance
{

namespace
{

/// Of all settings that change results.
std::uint64_t hashOf(const EngineSettings& settings)
{
  Hash hash;
  hash.add(settings.numberOfWalks);
  hash.add(settings.seed);
  hash.add(settings.verify);
  hash.add(settings.gathersDirectLight);
  hash.add(settings.fewestSamples.small);
  hash.add(settings.fewestSamples.large);
  hash.add(settings.fewestSamples.mostOfSmall);
  hash.add(settings.keepPhotons);
  hash.add(settings.allOnEachRank);
  hash.add(settings.listRepaired);
  hash.add(settings.replicates);
  hash.add(settings.targetRelativeError);
  hash.add(settings.maximumNumberOfWalks);
  hash.add(settings.repairTimeBudget);
  hash.add(static_cast<int>(settings.cellEstimate));
  hash.add(settings.spreadPhotons);
  hash.add(settings.gatherRays);
  hash.add(settings.maximumGatherRays);
  hash.add(settings.gathersEverywhere);
  hash.add(settings.unbiasedGather);
  hash.add(settings.separateSides);
  return hash.value();
}

}

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
  FrameChange agreed = fresh > 0 ? FrameChange{ FrameChange::Fresh, {} } : change;
  Hash hash;
  hash.add(static_cast<int>(agreed.kind));
  addScene(objects, fresh > 0 ? nullptr : &before, hash);
  ranks.expectSame(hash.value(), "other inputs than on the first process");
  return agreed;
}

}
