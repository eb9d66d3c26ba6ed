// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FinalGatherEstimator_h
#define irradiance_FinalGatherEstimator_h

#include "Estimates/CellEstimate.h"
#include "Estimates/CellEstimator.h"
#include "FinalGather/FinalGather.h"

#include <optional>

namespace irradiance
{

/**
 * Small cells: from their direct light, which they gathered, and a final gather of the indirect
 * light, see FinalGatherPaths. All others: from their own sums. Needs gathered direct light. Paths
 * are kept from update to update, see FinalGather; all else is made anew.
 *
 * The sums that rays read are means over the cells that they hit: this is a bias, which shrinks
 * with the size of these. Unbiased estimates read none. See Documentation/Theory.md, 5.7.
 */
class FinalGatherEstimator
  : public CellEstimator
  , private PhotonShares
{
public:
  FinalGatherEstimator(const Frame& frame, const WalkSets& walks, const EstimateSettings& settings,
    const WalkSettings& walkSettings)
    : CellEstimator(frame, walks)
    , settings_(settings)
    , seed_(walkSettings.seed)
    , mostRays_(walkSettings.targetRelativeError > 0 ? settings.maximumGatherRays : 0)
    , mayFollow_(walkSettings.verify)
  {
  }

  /// There must be no unseenLight().
  void update(const EstimateRounds& rounds, Execution& execution) override;
  ErrorEstimate errorEstimate() const override
  {
    return { sums_, sums_.plan(), 1, walks().largestStart(), this };
  }

  std::size_t mostRayRounds() const override { return roundsWithin(firstRays(), mostRays_); }
  std::uint64_t numberOfRays() const override { return raysAfter(firstRays(), rounds_.rays); }
  std::int64_t raySegments() const override { return gather_.segments(); }
  void dropRayRounds(std::size_t kept) override { gather_.dropRounds(keepsPaths() ? kept : 0); }
  std::size_t bytes() const override
  {
    return gather_.bytes() + sums_.bytes() + staleSums_.bytes();
  }
  std::int64_t followedPaths() const override { return gather_.numberFollowed(); }

private:
  const CellSums& sums() const override { return sums_; }
  /// Linear in what the walks of the cells hit have stale; of direct light nothing is stale.
  const CellSums& staleSums() const override { return staleSums_; }
  double photonShare(const CellSide& cell) const override;
  std::optional<double> rayVariance(const CellSide& cell, int band) const override;
  std::uint32_t firstRays() const;
  /// For frames to come.
  bool keepsPaths() const { return mayFollow_ && !frame().objects.dynamicObjects.empty(); }
  /// From what cells have themselves, and what was gathered for them.
  /// `direct`: without what rays find.
  void putTogether(
    const FinalGatherScene& scene, const CellSums& direct, const CancelPoint& cancelPoint);

  EstimateSettings settings_;
  std::uint64_t seed_;
  std::uint32_t mostRays_; ///< of a side, if a target takes more; 0: no target
  bool mayFollow_;         ///< motions
  FinalGather gather_;
  EstimateRounds rounds_;          ///< of the last update
  std::optional<CellRoles> roles_; ///< of the last update
  CellSums sums_, staleSums_;
};

}

#endif
