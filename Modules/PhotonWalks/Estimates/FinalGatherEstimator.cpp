// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/FinalGatherEstimator.h"

#include "FinalGather/DarkShapes.h"
#include "FinalGather/NearLampLight.h"
#include "FinalGather/PathLights.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

void FinalGatherEstimator::update(const EstimateRounds& rounds, Execution& execution)
{
  rounds_ = rounds;
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  const CellSums& all = walks().sums();
  CellSums direct = CellSums::ofGathered(frame().objects, all.plan(), all.rounds());
  direct.addGathered(all, cancelPoint);
  // The walks of the first round decide which cells cast rays: all rounds have the same paths, and
  // a cell does not stop casting rays because more walks are shot.
  roles_.emplace(frame().cells, walks().plan().walksAfter(1),
    walks().isEmpty() ? 0 : settings_.gatherRays, settings_.gathersEverywhere,
    !settings_.unbiasedGather);
  const CellShapes shapes = darkShapesOf(walks(), frame(), cancelPoint);
  const std::deque<PointDirectLight> lights = lightsOf(walks(), frame(), seed_, kSamplesOfHit);
  const FoundLamps foundLamps(walks(), frame().cells.numbers());
  const UnevenCells unevenCells(shapes, *roles_, walks(), cancelPoint);
  FinalGatherScene scene{ frame(), shapes, *roles_,
    { all, settings_.unbiasedGather ? nullptr : &direct, walks().staleSums(), rounds.walks },
    lights, foundLamps, unevenCells, static_cast<std::uint32_t>(rays().after(1)),
    1 / walks().watts(1.0, rounds.walks), seed_, keepsPaths() || mostRays_ > 0 };
  scene.tellsNoise = mostRays_ > 0;
  for (const WalkSet& set : walks().sets())
  {
    if (!set.source().cells && !set.source().areFoundByRays && !set.lights().isEmpty())
    {
      addNearLampLight(scene, set, rounds.walks, direct, execution);
    }
  }
  gather_.update(scene, rounds.rays, execution);
  putTogether(scene, direct, cancelPoint);
}

void FinalGatherEstimator::putTogether(
  const FinalGatherScene& scene, const CellSums& direct, const CancelPoint& cancelPoint)
{
  const KnownLight& known = scene.known;
  const std::uint32_t count = walks().plan().walksAfter(known.rounds);
  const std::uint32_t replicates = known.all.plan().replicates().count();
  sums_ = CellSums::ofGathered(scene.frame.objects, WalkPlan(count, count, replicates));
  staleSums_ = CellSums::ofGathered(scene.frame.objects, {}, known.stale ? 1 : 0);
  ThrottledCancelPoint pace(cancelPoint);
  known.all.numbers().forEach([&](const SceneCell& cell) {
    const bool gathers = roles_->gathers(cell);
    const CellSums& own = gathers ? direct : known.all;
    forEachSide(cell, true, [&](const CellSide& side) {
      for (std::uint32_t i = 0; i < replicates; ++i)
      {
        Bands sum = own.sums(side, i, known.rounds);
        sum += gathers ? gather_.indirect().sums(side, i, 1) : Bands{};
        sums_.setGathered(side, i, sum);
      }
      if (known.stale)
      {
        staleSums_.setGathered(
          side, 0, (gathers ? gather_.stale() : *known.stale).sums(side, 0, 1));
      }
    });
    pace.step();
  });
}

RayRounds FinalGatherEstimator::rays() const
{
  return { dealtRays(settings_.gatherRays, walks().plan().replicates().count()), mostRays_ };
}

/// Of a single ray nothing is known: its noise counts for all that there is.
std::optional<double> FinalGatherEstimator::rayVariance(const CellSide& cell, int band) const
{
  if (!roles_->gathers(cell))
  {
    return {};
  }
  if (numberOfRays() == walks().plan().replicates().count())
  {
    return kInfinity;
  }
  double variance = 0;
  forEachSide(cell, true, [&](const CellSide& side) {
    const bool counts = cell.side == CellSide::kBoth || cell.side == side.side;
    variance += counts ? std::pow(gather_.noise().sum(side, band), 2) : 0;
  });
  return variance;
}

/// Each ray reads a cell that expects fewestToRead() photons at least; one that reads none is worth
/// one.
double FinalGatherEstimator::photonShare(const CellSide& cell) const
{
  const double eachDraws = settings_.unbiasedGather ? 1 : roles_->fewestToRead();
  const double drawn = eachDraws * static_cast<double>(numberOfRays()) * roles_->timesOf(cell);
  const WalkPlan& plan = walks().plan();
  const double expected = roles_->expectedOn(frame().cells.area(cell)) *
    (static_cast<double>(plan.walksAfter(rounds_.walks)) / plan.walksAfter(1));
  return roles_->gathers(cell) ? std::min(1.0, expected / drawn) : 1.0;
}

}
