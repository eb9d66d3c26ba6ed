// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/CellEstimate.h"
#include "Estimates/CellEstimator.h"
#include "FinalGather/FinalGather.h"
#include "FinalGather/PathLights.h"

#include <algorithm>
#include <cmath>
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
  void update(const EstimateRounds& rounds, Execution& execution) override
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
      settings_.unbiasedGather ? nullptr : &direct, walks().staleSums(), rounds.walks, lights,
      found, uneven, firstRays(), 1 / walks().watts(1.0, rounds.walks), seed_,
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
  /// As in a room, see DirectPlan.
  static constexpr double kWalksPerSample = 36;
  /// Adds the direct light of lights from which walks start, near lamps see FirstHits, to the cells
  /// that gather: their walks bring it together with the indirect light, which these cells do not
  /// take from walks. They gather it as they do that of all other lights. `rounds`: of the walks that
  /// divide the flux of the lights. `sums`: adds to their first round; all ranks add the same.
  static void addNearLampLight(const FinalGatherScene& scene, const WalkSet& set,
    std::size_t rounds, CellSums& sums, Execution& execution)
  {
    const CancelPoint cancelPoint = cancelPointOf(execution, 0);
    const LightTable& lights = set.lights();
    const std::uint32_t walks = set.source().plan.walksAfter(rounds);
    const std::uint32_t replicates = sums.plan().replicates().count();
    const double quantaPerWatt =
      static_cast<double>(lights.quantaPerWalk()) * walks / lights.flux();
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
  static const Light* skyOf(const WalkSets& walks)
  {
    const auto set = std::find_if(walks.sets().begin(), walks.sets().end(),
      [](const WalkSet& some) { return some.source().isSky() && !some.lights().isEmpty(); });
    return set == walks.sets().end() ? nullptr : &set->lights()[0];
  }
  /// Takes from the sums of all ranks what cells gathered of the sky.
  static void takeSky(const WalkSets& walks, CellSums& sums, Execution& execution)
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
  const CellSums& sums() const override { return sums_; }
  /// Linear in what the walks of the cells hit have stale; of direct light nothing is stale.
  const CellSums& staleSums() const override { return staleSums_; }
  /// Each ray reads a cell that expects fewestToRead() photons at least; one that reads none is worth
  /// one.
  double photonShare(const CellSide& cell) const override
  {
    const double eachDraws = settings_.unbiasedGather ? 1 : roles_->fewestToRead();
    const double drawn = eachDraws * static_cast<double>(numberOfRays()) * roles_->timesOf(cell);
    const WalkPlan& plan = walks().plan();
    const double expected = roles_->expectedOn(frame().cells.area(cell)) *
      (static_cast<double>(plan.walksAfter(rounds_.walks)) / plan.walksAfter(1));
    return roles_->gathers(cell) ? std::min(1.0, expected / drawn) : 1.0;
  }
  /// Of a single ray nothing is known: its noise counts for all that there is.
  std::optional<double> rayVariance(const CellSide& cell, int band) const override
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
  std::uint32_t firstRays() const
  {
    return dealtRays(settings_.gatherRays, walks().plan().replicates().count());
  }
  /// For frames to come.
  bool keepsPaths() const { return mayFollow_ && !frame().objects.dynamicObjects.empty(); }
  /// From what cells have themselves, and what was gathered for them.
  /// `direct`: without what rays find.
  void putTogether(
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
