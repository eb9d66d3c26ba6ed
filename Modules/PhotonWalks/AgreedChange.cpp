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
  hash.add(settings.numberOfWalks, settings.seed, settings.verify, settings.gathersDirectLight,
    settings.fewestSamples.small, settings.fewestSamples.large, settings.fewestSamples.mostOfSmall,
    settings.keepPhotons, settings.allOnEachRank, settings.listRepaired, settings.replicates,
    settings.targetRelativeError, settings.maximumNumberOfWalks, settings.repairTimeBudget,
    static_cast<int>(settings.cellEstimate), settings.spreadPhotons, settings.gatherRays,
    settings.maximumGatherRays, settings.gathersEverywhere, settings.unbiasedGather,
    settings.separateSides);
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
