// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SpreadEstimator_h
#define irradiance_SpreadEstimator_h

#include "Estimates/CellEstimator.h"
#include "Estimates/CellSpread.h"

namespace irradiance
{

/// From the sums of the cell and of the cells around it, see CellSpread. Direct light that cells
/// gathered stays where it is: so the edges of shadows stay sharp.
class SpreadEstimator : public CellEstimator
{
public:
  /// `photons`: on how many a small cell is to draw, on average.
  SpreadEstimator(const Frame& frame, const WalkSets& walks, double photons, bool areSidesApart)
    : CellEstimator(frame, walks)
    , photons_(photons)
    , spread_(areSidesApart ? 2 : 1)
  {
  }

  void update(const EstimateRounds& rounds, Execution& execution) override;
  double irradiance(const CellSide& cell, int band) const override
  {
    return perArea(sums_.sum(cell, band), cell);
  }
  double staleIrradiance(const CellSide& cell, int band) const override;
  ErrorEstimate errorEstimate() const override
  {
    return { sums_, plan_, 1, walks().largestStart(), &spread_ };
  }

private:
  double photons_;
  WalkPlan plan_; ///< of the walks that count, in one round
  CellSpread spread_;
  CellSums sums_, staleSums_; ///< spread
};

}

#endif
