// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellEstimate.h"

#include "Estimates/NearestPhotonEstimator.h"
#include "Estimates/SpreadEstimator.h"

namespace irradiance
{

std::unique_ptr<CellEstimator> makeCellEstimator(
  const EstimateSettings& settings, const EstimateSource& source)
{
  switch (settings.cellEstimate)
  {
    case CellEstimate::Spread:
      return std::make_unique<SpreadEstimator>(source, settings.spreadPhotons);
    case CellEstimate::Nearest:
      return std::make_unique<NearestPhotonEstimator>(source, settings.spreadPhotons);
    default:
      return std::make_unique<SumEstimator>(source);
  }
}

bool needsPhotons(CellEstimate estimate)
{
  return estimate == CellEstimate::Nearest;
}

/// The nearest photons are others in each replicate and round.
std::string conflictOf(const EstimateSettings& settings, const WalkSettings& walks)
{
  const char* other = walks.targetRelativeError > 0 ? "TargetRelativeError"
    : walks.replicates > 1                          ? "ComputeStandardError"
    : walks.repairTimeBudget > 0                    ? "RepairTimeBudget"
                                                    : nullptr;
  return other && settings.cellEstimate == CellEstimate::Nearest
    ? std::string("CellEstimate Nearest and ") + other +
      " exclude each other: what is known of the error is known of sums, also spread ones"
    : std::string();
}

}
