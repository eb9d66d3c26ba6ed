// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/CellEstimate.h"

#include "Estimates/CellSpread.h"
#include "Estimates/FinalGatherEstimator.h"

#include <algorithm>

namespace irradiance
{

namespace
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
  ErrorEstimate errorEstimate() const override
  {
    return { sums(), walks().plan(), rounds_, walks().largestStart() };
  }

private:
  const CellSums& sums() const override { return walks().sums(); }
  const CellSums& staleSums() const override { return *walks().staleSums(); }

  std::size_t rounds_ = 0;
};

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

  void update(const EstimateRounds& rounds, Execution& execution) override
  {
    const SceneObjects& objects = frame().objects;
    const CellSums& all = walks().sums();
    const std::uint32_t count = walks().plan().walksAfter(rounds.walks);
    plan_ = WalkPlan(count, count, all.plan().replicates().count());
    spread_.update(objects, all, rounds.walks, photons_,
      static_cast<double>(walks().quantaPerWalk()), execution);
    sums_ = spread_.spread(objects, all, rounds.walks, execution);
    if (const CellSums* stale = walks().staleSums())
    {
      staleSums_ = spread_.spread(objects, *stale, 1, execution);
    }
  }
  ErrorEstimate errorEstimate() const override
  {
    return { sums_, plan_, 1, walks().largestStart(), &spread_ };
  }

private:
  const CellSums& sums() const override { return sums_; }
  const CellSums& staleSums() const override { return staleSums_; }

  double photons_;
  WalkPlan plan_; ///< of the walks that count, in one round
  CellSpread spread_;
  CellSums sums_, staleSums_; ///< spread
};

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

std::unique_ptr<CellEstimator> makeCellEstimator(const EstimateSettings& settings,
  const WalkSettings& walkSettings, const Frame& frame, const WalkSets& walks)
{
  switch (settings.cellEstimate)
  {
    case CellEstimate::Spread:
      return std::make_unique<SpreadEstimator>(
        frame, walks, settings.spreadPhotons, settings.separateSides);
    case CellEstimate::Gathered:
      return std::make_unique<FinalGatherEstimator>(frame, walks, settings, walkSettings);
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
    fewest.ofSky = settings.gathersEverywhere ? kFewest : 0;
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
