// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FinalGather.h"

#include "Execution/SlicedPass.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace irradiance
{

void FinalGather::update(const GatherScene& scene, Execution& execution)
{
  indirect_ = CellSums(scene.objects, 2, scene.known.all.plan(), 1);
  stale_ = CellSums(scene.objects, 2, {}, scene.known.stale ? 1 : 0);
  excess_.assign(scene.checksReadings ? scene.replicates() : 0, 0);
  followed_ = 0;
  findGatherers(scene);
  Ranks& ranks = execution.ranks();
  Origin origin = originOf(scene, ranks);
  const std::optional<GatherMotion> motion = motionTo(scene, origin);
  origin_.reset(); // until the end is reached
  const std::size_t together = startsTogether(scene);
  const std::size_t units = (gatherers_.size() + together - 1) / together;
  if (!motion)
  {
    units_ = std::vector<Unit>(units);
  }
  SlicedPass pass{ units, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    if (unit % ranks.count() == ranks.rank())
    {
      gather(scene, motion ? &*motion : nullptr, unit);
    }
    return true;
  };
  pass.run(execution);
  if (ranks.areSeveral())
  {
    indirect_.sumOver(ranks, cancelPointOf(execution, 1));
    stale_.sumOver(ranks, cancelPointOf(execution, 1));
    ranks.sum(excess_.data(), excess_.size());
  }
  if (scene.keepsPaths)
  {
    origin_ = std::move(origin);
  }
  else
  {
    units_.clear();
  }
}

std::size_t FinalGather::bytes() const
{
  return std::accumulate(
    units_.begin(), units_.end(), std::size_t{ 0 }, [](std::size_t sum, const Unit& unit) {
      return sum + unit.paths.bytes() + unit.checks.bytes();
    });
}

void FinalGather::findGatherers(const GatherScene& scene)
{
  gatherers_.clear();
  const CellNumbers& numbers = scene.cells.numbers();
  numbers.forEach([&](const SceneCell& cell) {
    if (scene.roles.gathers(cell))
    {
      gatherers_.push_back({ cell, numbers[cell] });
    }
  });
}

FinalGather::Origin FinalGather::originOf(const GatherScene& scene, const Ranks& ranks) const
{
  Origin origin{ pathsOriginOf(scene), ranks.rank(), ranks.count(), {} };
  for (const Gatherer& gatherer : gatherers_)
  {
    origin.gatherers.push_back(gatherer.cell);
  }
  return origin;
}

std::optional<GatherMotion> FinalGather::motionTo(
  const GatherScene& scene, const Origin& origin) const
{
  const bool isSame = origin_ && origin.rank == origin_->rank && origin.ranks == origin_->ranks &&
    origin.gatherers == origin_->gatherers;
  return isSame ? motionSince(scene, origin.paths, origin_->paths) : std::nullopt;
}

std::vector<FinalGather::Side> FinalGather::sidesOf(
  const GatherScene& scene, std::size_t unit) const
{
  const std::size_t together = startsTogether(scene);
  const std::size_t end = std::min((unit + 1) * together, gatherers_.size());
  std::vector<Side> sides;
  for (std::size_t i = unit * together; i < end; ++i)
  {
    const CellShape& shape = scene.shapes[gatherers_[i].shape];
    for (const int side : { 0, 1 })
    {
      if (!(side == 0 ? shape.isFrontDark : shape.isBackDark))
      {
        sides.push_back({ i, side, scene.roles.timesOf(gatherers_[i].cell) });
      }
    }
  }
  return sides;
}

void FinalGather::gather(const GatherScene& scene, const GatherMotion* motion, std::size_t number)
{
  Unit& unit = units_[number];
  std::vector<Side> sides = sidesOf(scene, number);
  const bool isKept = motion && sides == unit.sides;
  unit.sides = std::move(sides);
  if (!isKept || !motion->isNone())
  {
    follow(scene, isKept ? motion : nullptr, unit);
  }
  if (scene.checksReadings)
  {
    addExcess(unit.checks.excess(scene));
  }
  PathSums brought;
  brought.read(scene, unit.paths, unit.paths.size() / scene.rays);
  std::size_t start = 0;
  for (const Side& side : unit.sides)
  {
    store(scene, brought, start, side);
    start += side.starts;
  }
}

void FinalGather::addExcess(const std::vector<double>& excess)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t k = 0; k < excess.size(); ++k)
  {
    excess_[k] += nearestQuanta(excess[k]);
  }
}

void FinalGather::follow(const GatherScene& scene, const GatherMotion* motion, Unit& unit)
{
  std::unique_ptr<GatherPaths> paths = paths_.take();
  paths->begin(scene);
  std::vector<std::size_t> from;
  std::vector<std::uint32_t> rays;
  for (const Side& side : unit.sides)
  {
    const Gatherer& gatherer = gatherers_[side.gatherer];
    rays.clear();
    for (std::uint32_t ray = 0; ray < side.starts * scene.rays; ++ray)
    {
      const bool isAnew = !motion || motion->hasMoved(gatherer.cell.object) ||
        motion->mayChange(unit.paths[from.size()]);
      from.push_back(isAnew ? FollowedPaths::kAnew : from.size());
      if (isAnew)
      {
        rays.push_back(ray);
      }
    }
    if (!rays.empty())
    {
      paths->addSide(scene, gatherer.shape, side.side == 0, numberOf(side), rays);
    }
  }
  paths->run(scene);
  followed_ += static_cast<std::int64_t>(paths->followed().size());
  unit.paths = motion ? paths->followed().mergedWith(unit.paths, from) : paths->takeFollowed();
  if (scene.checksReadings)
  {
    followed_ +=
      unit.checks.update(scene, unit.paths, startsOf(scene, unit), { motion, from }, *paths);
  }
  paths_.giveBack(std::move(paths));
}

std::vector<ReadingChecks::Start> FinalGather::startsOf(
  const GatherScene& scene, const Unit& unit) const
{
  std::vector<ReadingChecks::Start> starts;
  for (const Side& side : unit.sides)
  {
    const double area = scene.cells.area(gatherers_[side.gatherer].cell) / side.starts;
    for (std::uint64_t start = 0; start < side.starts; ++start)
    {
      starts.push_back({ start << 40 | numberOf(side), area });
    }
  }
  return starts;
}

void FinalGather::store(
  const GatherScene& scene, const PathSums& brought, std::size_t start, const Side& side)
{
  const CellSide cell{ gatherers_[side.gatherer].cell, side.side };
  const double areaOfStart = scene.cells.area(cell) / side.starts;
  for (int band = 0; band < indirect_.bands(); ++band)
  {
    const auto sumOf = [&](const auto& found) {
      double sum = 0;
      for (std::size_t i = start; i < start + side.starts; ++i)
      {
        sum += found(i)[static_cast<std::size_t>(band)];
      }
      return nearestQuanta(areaOfStart * sum);
    };
    for (std::uint32_t k = 0; k < indirect_.plan().replicates().count(); ++k)
    {
      indirect_.set(cell, band, k, sumOf([&](std::size_t i) { return brought.found(i, k); }));
    }
    if (scene.known.stale)
    {
      stale_.set(cell, band, 0, sumOf([&](std::size_t i) { return brought.stale(i); }));
    }
  }
}

}
