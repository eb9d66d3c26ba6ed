// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/FinalGatherEstimator.h"

#include "FinalGather/PathLights.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

/// As in a room, see DirectPlan.
constexpr double kWalksPerSample = 36;

/// Adds the direct light of lights from which walks start, near lamps see FirstHits, to the cells
/// that gather: their walks bring it together with the indirect light, which these cells do not
/// take from walks. They gather it as they do that of all other lights. `rounds`: of the walks that
/// divide the flux of the lights. `sums`: adds to their first round; all ranks add the same.
void addNearLampLight(const FinalGatherScene& scene, const WalkSet& set, std::size_t rounds,
  CellSums& sums, Execution& execution)
{
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  const LightTable& lights = set.lights();
  const std::uint32_t walks = set.source().plan.walksAfter(rounds);
  const std::uint32_t replicates = sums.plan().replicates().count();
  const double quantaPerWatt = static_cast<double>(lights.quantaPerWalk()) * walks / lights.flux();
  const std::shared_ptr<const LampPieces> known = set.source().knownLamps();
  const LampPieces& lamps = *known;
  CellShapes shapes = scene.shapes;
  scene.frame.cells.numbers().forEach([&](const SceneCell& cell) {
    if (!scene.roles.gathers(cell)) // counts as dark: it takes no samples
    {
      shapes.setDark(scene.frame.cells.numbers()[cell], true, true);
    }
  });
  const DirectPlan plan(shapes, lamps,
    { walks, kWalksPerSample, { scene.rays, scene.rays, 2 * scene.rays }, replicates },
    cancelPoint);
  DirectLight light(
    shapes, lamps, plan, splitMix(scene.seed + set.source().firstWalk), quantaPerWatt);
  light.gather(scene.frame, execution);
  light.addTo(sums, 0, 1, {}, cancelPoint);
}

/// The light of a sky to which rays escape; null: there is none.
const Light* skyOf(const WalkSets& walks)
{
  const auto set = std::find_if(walks.sets().begin(), walks.sets().end(),
    [](const WalkSet& some) { return some.source().isSky() && !some.lights().isEmpty(); });
  return set == walks.sets().end() ? nullptr : &set->lights()[0];
}

/// Takes from the sums of all ranks what cells gathered of the sky.
void takeSky(const WalkSets& walks, CellSums& sums, Execution& execution)
{
  const CancelPoint cancelPoint = cancelPointOf(execution, 1);
  for (const WalkSet& set : walks.sets())
  {
    std::size_t round = 0;
    const auto take = [&](const DirectGather& gathered) {
      gathered.light().addTo(sums, round++, -1, {}, cancelPoint);
    };
    if (set.source().isSky())
    {
      set.forEachGathered(take);
    }
  }
}

}

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
  const std::deque<PointDirectLight> lights =
    lightsOf(walks(), frame(), seed_, kSamplesOfHit, Asked::ButSky);
  const std::vector<bool> found = foundLamps(walks(), frame().cells.numbers());
  const std::vector<bool> uneven = unevenCells(shapes, *roles_, walks(), cancelPoint);
  FinalGatherScene scene{ frame(), shapes, *roles_, all,
    settings_.unbiasedGather ? nullptr : &direct, walks().staleSums(), rounds.walks, lights, found,
    uneven, firstRays(), 1 / walks().watts(1.0, rounds.walks), seed_,
    keepsPaths() || mostRays_ > 0 };
  scene.tellsNoise = mostRays_ > 0;
  scene.sky = skyOf(walks());
  for (const WalkSet& set : walks().sets())
  {
    if (!set.source().cells && !set.source().areFoundByRays && !set.lights().isEmpty())
    {
      addNearLampLight(scene, set, rounds.walks, direct, execution);
    }
  }
  gather_.update(scene, rounds.rays, execution);
  if (scene.sky)
  {
    takeSky(walks(), direct, execution);
  }
  putTogether(scene, direct, cancelPoint);
}

void FinalGatherEstimator::putTogether(
  const FinalGatherScene& scene, const CellSums& direct, const CancelPoint& cancelPoint)
{
  const std::uint32_t count = walks().plan().walksAfter(scene.knownRounds);
  const std::uint32_t replicates = scene.replicates();
  sums_ = CellSums::ofGathered(scene.frame.objects, WalkPlan(count, count, replicates));
  staleSums_ = CellSums::ofGathered(scene.frame.objects, {}, scene.knownStale ? 1 : 0);
  ThrottledCancelPoint pace(cancelPoint);
  scene.known.numbers().forEach([&](const SceneCell& cell) {
    const bool gathers = roles_->gathers(cell);
    const CellSums& own = gathers ? direct : scene.known;
    forEachSide(cell, true, [&](const CellSide& side) {
      for (std::uint32_t i = 0; i < replicates; ++i)
      {
        Bands sum = own.sums(side, i, scene.knownRounds);
        sum += gathers ? gather_.indirect().sums(side, i, 1) : Bands{};
        sums_.setGathered(side, i, sum);
      }
      if (scene.knownStale)
      {
        staleSums_.setGathered(
          side, 0, (gathers ? gather_.stale() : *scene.knownStale).sums(side, 0, 1));
      }
    });
    pace.step();
  });
}

std::uint32_t FinalGatherEstimator::firstRays() const
{
  return dealtRays(settings_.gatherRays, walks().plan().replicates().count());
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
