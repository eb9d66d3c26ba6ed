// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellEstimate.h"

#include "Estimates/FinalGatherEstimator.h"
#include "Estimates/SpreadEstimator.h"
#include "Estimates/SumEstimator.h"

#include <algorithm>

namespace irradiance
{

std::unique_ptr<CellEstimator> makeCellEstimator(const EstimateSettings& settings,
  const WalkSettings& walkSettings, const Frame& frame, const WalkSets& walks)
{
  switch (settings.cellEstimate)
  {
    case CellEstimate::Spread:
      return std::make_unique<SpreadEstimator>(
        frame, walks, settings.spreadPhotons, settings.separateSides);
    case CellEstimate::Gathered:
      return std::make_unique<FinalGatherEstimator>(frame, walks,
        FinalGatherEstimator::Settings{ settings.gatherRays,
          walkSettings.targetRelativeError > 0 ? settings.maximumGatherRays : 0,
          settings.gathersEverywhere, settings.unbiasedGather, walkSettings.seed,
          walkSettings.verify });
    default:
      return std::make_unique<SumEstimator>(frame, walks);
  }
}

FewestSamples fewestSamplesOf(const EstimateSettings& settings, const FewestSamples& asked)
{
  FewestSamples fewest = asked;
  if (settings.cellEstimate == CellEstimate::Gathered)
  {
    // Of few samples, the edges of shadows are the larger noise.
    constexpr std::uint32_t kFewest = 8;
    fewest = fewest.asMany();
    fewest.small = std::max({ fewest.small, kFewest, settings.gatherRays / 2 });
    fewest.large = std::max(fewest.large,
      settings.gathersEverywhere ? CellRoles::kTimesOfLarge * fewest.small : fewest.small);
  }
  return fewest;
}

std::string conflictOf(const EstimateSettings& settings, const WalkSettings& walks)
{
  return settings.cellEstimate == CellEstimate::Gathered && !walks.gathersDirectLight
    ? "CellEstimate Gathered needs DirectLight Gathered: what walks bring is else direct and "
      "indirect light in one sum"
    : "";
}

}
