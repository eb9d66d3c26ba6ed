// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FinalGather.h"

#include "Execution/SlicedPass.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace irradiance
{

namespace
{

/// Rays of each side that are cast together.
constexpr std::size_t kRaysTogether = 4096;

}

FinalGather::FinalGather(const GatherScene& scene, Execution& execution)
  : indirect_(scene.objects, 2, scene.known.all.plan(), 1)
  , stale_(scene.objects, 2, {}, scene.known.stale ? 1 : 0)
{
  const CellNumbers& numbers = scene.cells.numbers();
  numbers.forEach([&](const SceneCell& cell) {
    if (scene.roles.gathers(cell))
    {
      gatherers_.push_back({ cell, numbers[cell] });
    }
  });
  Ranks& ranks = execution.ranks();
  const std::size_t together = std::max<std::size_t>(1, kRaysTogether / scene.rays);
  SlicedPass pass{ (gatherers_.size() + together - 1) / together, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    if (unit % ranks.count() == ranks.rank())
    {
      gather(scene, unit * together, std::min((unit + 1) * together, gatherers_.size()));
    }
    return true;
  };
  pass.run(execution);
  if (ranks.areSeveral())
  {
    indirect_.sumOver(ranks, cancelPointOf(execution, 1));
    stale_.sumOver(ranks, cancelPointOf(execution, 1));
  }
}

void FinalGather::gather(const GatherScene& scene, std::size_t first, std::size_t end)
{
  std::unique_ptr<GatherPaths> paths = paths_.take();
  paths->begin(scene);
  std::vector<CellSide> sides;
  for (std::size_t i = first; i < end; ++i)
  {
    const CellShape& shape = scene.shapes[gatherers_[i].shape];
    for (const int side : { 0, 1 })
    {
      if (!(side == 0 ? shape.isFrontDark : shape.isBackDark))
      {
        // Numbered among those that gather: cells that are away have numbers of their own in a frame that
        // follows others.
        paths->addSide(
          scene, gatherers_[i].shape, side == 0, 2 * i + static_cast<std::size_t>(side));
        sides.push_back({ gatherers_[i].cell, side });
      }
    }
  }
  paths->run(scene);
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    store(scene, *paths, i, sides[i]);
  }
  paths_.giveBack(std::move(paths));
}

void FinalGather::store(
  const GatherScene& scene, const GatherPaths& paths, std::size_t number, const CellSide& side)
{
  const double area = scene.cells.area(side);
  for (int band = 0; band < indirect_.bands(); ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    for (std::uint32_t k = 0; k < indirect_.plan().replicates().count(); ++k)
    {
      indirect_.set(side, band, k, nearestQuanta(area * paths.found(number, k)[i]));
    }
    if (scene.known.stale)
    {
      stale_.set(side, band, 0, nearestQuanta(area * paths.stale(number)[i]));
    }
  }
}

}
