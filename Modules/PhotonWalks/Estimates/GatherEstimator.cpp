// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/GatherEstimator.h"

#include "Estimates/SeparateSums.h"
#include "FinalGather/DarkShapes.h"
#include "FinalGather/NearLampLight.h"
#include "FinalGather/PathLights.h"

#include <algorithm>

namespace irradiance
{

void GatherEstimator::update(std::size_t rounds, Execution& execution)
{
  const EstimateSource& from = source();
  const SceneObjects& objects = from.space.objects;
  const CancelPoint cancelPoint = cancelPointOf(execution, 0);
  const CellSums& all = from.walks.sums();
  std::optional<CellSums> direct = gatheredSums(from.walks, objects, cancelPoint);
  if (!direct) // all lights are near ones
  {
    direct.emplace(objects, all.sides(), all.plan(), all.rounds());
  }
  roles_.emplace(from.cells, from.walks.plan().walksAfter(rounds),
    from.walks.isEmpty() ? 0 : settings_.rays, settings_.on, !settings_.isUnbiased);
  const CellShapes shapes = darkShapesOf(from.walks, from.space, cancelPoint);
  const std::deque<PointDirectLight> lights =
    lightsOf(from.walks, from.space.gatherSpace(), settings_.seed, kSamplesOfHit, kWeightsOfHit);
  const GatherScene scene{ from.space.gatherSpace(), objects, from.cells, shapes, *roles_,
    { all, settings_.isUnbiased ? nullptr : &*direct, from.walks.staleSums(), rounds }, lights,
    numberOfRays(), 1 / from.walks.watts(1.0, rounds), settings_.seed,
    settings_.keepsPaths && !objects.dynamicObjects.empty(), all.plan().replicates().count() > 1 };
  for (const WalkSet& set : from.walks.sets())
  {
    if (!set.source().cells && !set.lights().isEmpty())
    {
      addNearLampLight(scene, set, rounds, *direct, execution);
    }
  }
  gather_.update(scene, execution);
  putTogether(scene, *direct, cancelPoint);
}

void GatherEstimator::putTogether(
  const GatherScene& scene, const CellSums& direct, const CancelPoint& cancelPoint)
{
  const KnownLight& known = scene.known;
  const std::uint32_t count = source().walks.plan().walksAfter(known.rounds);
  const std::uint32_t replicates = known.all.plan().replicates().count();
  sums_ = CellSums(scene.objects, sides(), WalkPlan(count, count, replicates));
  staleSums_ = CellSums(scene.objects, sides(), {}, known.stale ? 1 : 0);
  received_ = 0;
  ThrottledCancelPoint pace(cancelPoint);
  known.all.numbers().forEach([&](const SceneCell& cell) {
    const bool gathers = roles_->gathers(cell);
    const CellSums& own = gathers ? direct : known.all;
    for (int side = 0; side < sides(); ++side)
    {
      for (int band = 0; band < known.all.bands(); ++band)
      {
        for (std::uint32_t i = 0; i < replicates; ++i)
        {
          sums_.set({ cell, side }, band, i, sumOf({ cell, side }, [&](const CellSide& part) {
            return own.sum(part, band, i, known.rounds) +
              (gathers ? gather_.indirect().sum(part, band, i, 1) : 0);
          }));
        }
        received_ += gathers ? static_cast<double>(sums_.sum({ cell, side }, band)) : 0;
        if (known.stale)
        {
          const CellSums& stale = gathers ? gather_.stale() : *known.stale;
          staleSums_.set({ cell, side }, band, 0,
            sumOf({ cell, side }, [&](const CellSide& part) { return stale.sum(part, band); }));
        }
      }
    }
    pace.step();
  });
}

/// Of one side, or of both if they are not told apart.
template <class Quanta>
std::int64_t GatherEstimator::sumOf(const CellSide& cell, const Quanta& quanta) const
{
  return settings_.separatesSides ? quanta(cell) : quanta({ cell, 0 }) + quanta({ cell, 1 });
}

std::uint32_t GatherEstimator::numberOfRays() const
{
  return dealtRays(settings_.rays, source().walks.plan().replicates().count());
}

double GatherEstimator::staleIrradiance(const CellSide& cell, int band) const
{
  // Both are rounded, so the part may come out larger than the whole.
  return source().walks.staleSums()
    ? perArea(std::min(staleSums_.sum(cell, band), sums_.sum(cell, band)), cell)
    : 0.0;
}

GatheringBias GatherEstimator::gatheringBias() const
{
  const std::vector<std::int64_t>& excess = gather_.excess();
  return gatheringBiasOf({ excess.begin(), excess.end() }, received_);
}

/// Each ray reads a cell that expects fewestToRead() photons at least; one that reads none is worth one.
double GatherEstimator::photonShare(const CellSide& cell) const
{
  const double eachDraws = settings_.isUnbiased ? 1 : roles_->fewestToRead();
  const double drawn = eachDraws * numberOfRays() * roles_->timesOf(cell);
  return roles_->gathers(cell)
    ? std::min(1.0, roles_->expectedOn(source().cells.area(cell)) / drawn)
    : 1.0;
}

}
