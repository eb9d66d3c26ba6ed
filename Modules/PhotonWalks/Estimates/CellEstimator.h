// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/ErrorEstimate.h"
#include "Walks/WalkSets.h"

#include <algorithm>
#include <optional>

namespace irradiance
{

/// From how many rounds an estimate is made: of walks, and of rays from cells that gather, see
/// FinalGatherScene::inRound().
struct EstimateRounds
{
  std::size_t walks = 1, rays = 1;
};

/// Estimates the irradiance of cells from what walks brought. What follows from an estimate is
/// valid until the next update of it.
class CellEstimator
{
public:
  /// Both have to outlive it, and change from update to update.
  CellEstimator(const Frame& frame, const WalkSets& walks)
    : frame_(frame)
    , walks_(walks)
  {
  }
  virtual ~CellEstimator() = default;
  CellEstimator(const CellEstimator&) = delete;
  CellEstimator& operator=(const CellEstimator&) = delete;

  /// To a frame, and the first rounds of its walks and rays. Throws Interrupted; after that all
  /// walks have to be shot again.
  virtual void update(const EstimateRounds& rounds, Execution& execution) = 0;

  /// W/m2; 0 for a cell without area.
  double irradiance(const CellSide& cell, int band) const
  {
    return perArea(sums().sum(cell, band), cell);
  }
  /// The part of irradiance() that rests on stale walks.
  double staleIrradiance(const CellSide& cell, int band) const
  {
    // Both may be rounded, so the part may come out larger than the whole.
    return walks_.staleSums()
      ? perArea(std::min(staleSums().sum(cell, band), sums().sum(cell, band)), cell)
      : 0.0;
  }
  /// The errors of irradiance(), from the variance between replicates; what the estimate blurs is
  /// not in them.
  virtual ErrorEstimate errorEstimate() const = 0;

  /// Rounds of rays that there may be; those of walks are in the plan.
  virtual std::size_t mostRayRounds() const { return 1; }
  /// Of each side of a small cell in the last update; 0 if cells cast none.
  virtual std::uint64_t numberOfRays() const { return 0; }
  /// Of all paths that the last update read.
  virtual std::int64_t raySegments() const { return 0; }
  /// Forgets what later frames do not need.
  virtual void dropRayRounds(std::size_t /*kept*/) {}

  /// What it keeps for frames to come.
  virtual std::size_t bytes() const { return 0; }
  /// Paths that the last update followed, if it has any.
  virtual std::int64_t followedPaths() const { return 0; }

protected:
  const Frame& frame() const { return frame_; }
  const WalkSets& walks() const { return walks_; }

private:
  /// What cells are estimated to receive, in quanta, and what of it rests on stale walks, if walks
  /// may be stale.
  virtual const CellSums& sums() const = 0;
  virtual const CellSums& staleSums() const = 0;
  /// W/m2 of a sum on a cell.
  double perArea(double quanta, const CellSide& cell) const
  {
    const double area = frame_.cells.area(cell);
    return area > 0 ? walks_.watts(quanta) / area : 0.0;
  }

  const Frame& frame_;
  const WalkSets& walks_;
};

/// What may be doubled where a target is missed.
enum class TargetLever
{
  Walks,
  Rays
};

/**
 * The lever that promises more for its time, once the first `rounds` have missed a target; nothing
 * if none is left that may help. The time is counted, in segments that the lever would add. So the
 * choice is a pure function of the scene and the settings.
 */
std::optional<TargetLever> chooseLever(const TargetMiss& miss, const EstimateRounds& rounds,
  const WalkSets& walks, const CellEstimator& estimator);

}
