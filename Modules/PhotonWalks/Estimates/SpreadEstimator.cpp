// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SpreadEstimator.h"

#include <algorithm>

namespace irradiance
{

void SpreadEstimator::update(const EstimateRounds& rounds, Execution& execution)
{
  const SceneObjects& objects = frame().objects;
  const CellSums& all = walks().sums();
  const std::uint32_t count = walks().plan().walksAfter(rounds.walks);
  plan_ = WalkPlan(count, count, all.plan().replicates().count());
  spread_.update(
    objects, all, rounds.walks, photons_, static_cast<double>(walks().quantaPerWalk()), execution);
  sums_ = spread_.spread(objects, all, rounds.walks, execution);
  if (const CellSums* stale = walks().staleSums())
  {
    staleSums_ = spread_.spread(objects, *stale, 1, execution);
  }
}

double SpreadEstimator::staleIrradiance(const CellSide& cell, int band) const
{
  // What is spread is rounded at each step, so the part may come out larger than the whole.
  return walks().staleSums()
    ? perArea(std::min(staleSums_.sum(cell, band), sums_.sum(cell, band)), cell)
    : 0.0;
}

}
