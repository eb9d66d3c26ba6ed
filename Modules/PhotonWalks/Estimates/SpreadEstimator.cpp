// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SpreadEstimator.h"

#include "Estimates/SeparateSums.h"

#include <algorithm>
#include <optional>

namespace irradiance
{

void SpreadEstimator::update(const EstimateRounds& rounds, Execution& execution)
{
  const SceneObjects& objects = source().space.objects;
  const WalkSets& walks = source().walks;
  const std::optional<SeparateSums> separate =
    separateSums(walks, objects, rounds.walks, execution);
  const CellSums& shot = separate ? separate->indirect : walks.sums();
  const std::size_t shotRounds = separate ? 1 : rounds.walks;
  spread_.update(
    objects, shot, shotRounds, photons_, static_cast<double>(walks.quantaPerWalk()), execution);
  sums_ = spread_.spread(objects, shot, shotRounds, execution);
  if (separate)
  {
    sums_.add(separate->direct, cancelPointOf(execution, 1));
  }
  if (const CellSums* stale = walks.staleSums())
  {
    staleSums_ = spread_.spread(objects, *stale, 1, execution);
  }
}

double SpreadEstimator::staleIrradiance(const CellSide& cell, int band) const
{
  // What is spread is rounded at each step, so the part may come out larger than the whole.
  return source().walks.staleSums()
    ? perArea(std::min(staleSums_.sum(cell, band), sums_.sum(cell, band)), cell)
    : 0.0;
}

}
