// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/TargetLever.h"

namespace irradiance
{

namespace
{

/// A segment that hits a cell brings it what a walk carries, and so does a sample of direct light.
double segmentsOf(const WalkSets& walks, std::size_t rounds)
{
  const CellSums& sums = walks.sums();
  double quanta = 0;
  sums.numbers().forEach([&](const SceneCell& cell) {
    for (int band = 0; band < sums.bands(); ++band)
    {
      quanta += sums.sum({ cell }, band, rounds);
    }
  });
  return quanta / static_cast<double>(walks.quantaPerWalk());
}

}

std::optional<TargetLever> chooseLever(const TargetMiss& miss, const EstimateRounds& rounds,
  const WalkSets& walks, const CellEstimator& estimator)
{
  const bool hasWalks = rounds.walks < walks.plan().rounds().size();
  // Without walks, rays alone have to bring enough area to the target.
  const bool hasRays = rounds.rays < estimator.mostRayRounds() && miss.byRays > 0 &&
    (hasWalks || miss.beyondRays <= 1 - ErrorEstimate::kConfidence);
  if (!hasWalks || !hasRays)
  {
    return hasWalks ? std::optional(TargetLever::Walks)
      : hasRays     ? std::optional(TargetLever::Rays)
                    : std::nullopt;
  }
  const double segments = segmentsOf(walks, rounds.walks);
  const auto ofRays = static_cast<double>(estimator.raySegments());
  return miss.byRays * segments > miss.byWalks * ofRays ? TargetLever::Rays : TargetLever::Walks;
}

}
