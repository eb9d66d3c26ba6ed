// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SumEstimator_h
#define irradiance_SumEstimator_h

#include "Estimates/CellEstimator.h"

namespace irradiance
{

/// From the photons that arrived in the cell itself.
class SumEstimator : public CellEstimator
{
public:
  using CellEstimator::CellEstimator;

  void update(const EstimateRounds& rounds, Execution& /*execution*/) override
  {
    rounds_ = rounds.walks;
  }
  double irradiance(const CellSide& cell, int band) const override
  {
    return perArea(walks().sums().sum(cell, band), cell);
  }
  double staleIrradiance(const CellSide& cell, int band) const override
  {
    const CellSums* stale = walks().staleSums();
    return stale ? perArea(stale->sum(cell, band), cell) : 0.0;
  }
  ErrorEstimate errorEstimate() const override
  {
    return { walks().sums(), walks().plan(), rounds_, walks().largestStart() };
  }

private:
  std::size_t rounds_ = 0;
};

}

#endif
