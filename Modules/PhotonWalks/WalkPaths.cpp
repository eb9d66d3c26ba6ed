// SPDX-License-Identifier: BSD-3-Clause
#include "WalkPaths.h"

#include "Execution/SlicedPass.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace irradiance
{

WalkPaths::WalkPaths(const IrradianceEngine& engine)
  : engine_(engine)
  , samples_(engine.samples())
  , shooter_(engine.shooter(samples_))
  , bounds_(engine.walkBounds())
{
  assert(engine.keepsPhotons());
  const double diagonal = bounds_.isEmpty() ? 0.0 : bounds_.extent().norm();
  bounds_.inflate(diagonal > 0 ? diagonal / 8 : 1.0); // a point light alone has no size
}

std::vector<std::uint32_t> WalkPaths::first(std::size_t most) const
{
  const std::size_t all = engine_.hasEmitters() ? engine_.numberOfWalks() : 0;
  std::vector<std::uint32_t> walks(std::min(most, all));
  std::iota(walks.begin(), walks.end(), 0u);
  return walks;
}

std::vector<std::uint32_t> WalkPaths::touching(
  const SceneCell& cell, std::size_t most, Execution& execution) const
{
  const std::vector<WalkBlock>& history = engine_.history();
  const bool isLight = emits(cell);
  std::vector<std::vector<std::uint32_t>> found(engine_.hasEmitters() ? history.size() : 0);
  SlicedPass pass{ found.size(), {} };
  pass.work = [&](std::size_t number, const Deadline&) {
    const WalkBlock& block = history[number];
    const std::uint32_t firstWalk = engine_.plan().firstWalkOf(number);
    for (std::uint32_t i = 0; i < block.numberOfWalks() && found[number].size() < most; ++i)
    {
      if (isHit(block, i, cell) || (isLight && shooter_.rules().lightCellOf(firstWalk + i) == cell))
      {
        found[number].push_back(firstWalk + i);
      }
    }
    return true;
  };
  pass.run(execution);
  std::vector<std::uint32_t> walks;
  for (const std::vector<std::uint32_t>& some : found)
  {
    const std::size_t count = std::min(some.size(), most - walks.size());
    walks.insert(walks.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return walks;
}

/// Else no sample has to be drawn to know that no walk starts there.
bool WalkPaths::emits(const SceneCell& cell) const
{
  const Material& material = *engine_.objects()[cell.object].material;
  const auto bands = static_cast<std::ptrdiff_t>(material.bands);
  const auto isPositive = [](double exitance) { return exitance > 0; };
  const auto first = material.exitance.begin() + bands * static_cast<std::ptrdiff_t>(cell.cell);
  return (!material.exitance.empty() && std::any_of(first, first + bands, isPositive)) ||
    std::any_of(material.pointLights.begin(), material.pointLights.end(),
      [&](const PointLight& light) { return light.cell == cell.cell; });
}

bool WalkPaths::isHit(
  const WalkBlock& block, std::uint32_t walkInBlock, const SceneCell& cell) const
{
  for (std::uint32_t bounce = 0; bounce < block.size(walkInBlock); ++bounce)
  {
    const TriangleId id = block.hit(walkInBlock, bounce).id;
    if (id.object == cell.object && shooter_.rules().cellOf(id) == cell.cell)
    {
      return true;
    }
  }
  return false;
}

std::vector<WalkPath> WalkPaths::paths(
  const std::vector<std::uint32_t>& walks, Execution& execution) const
{
  constexpr std::size_t kPerUnit = 64;
  std::vector<WalkPath> paths(walks.size());
  SlicedPass pass{ (walks.size() + kPerUnit - 1) / kPerUnit, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    const std::size_t begin = unit * kPerUnit;
    find(walks.data() + begin, std::min(kPerUnit, walks.size() - begin), paths.data() + begin);
    return true;
  };
  pass.run(execution);
  return paths;
}

void WalkPaths::find(const std::uint32_t* walks, std::size_t count, WalkPath* paths) const
{
  std::vector<WalkShooter::Stored> rayless; // first segments, and those that escape
  std::vector<std::size_t> escaping;
  for (std::size_t i = 0; i < count; ++i)
  {
    const WalkPlan::Place place = engine_.plan().placeOf(walks[i]);
    rayless.push_back({ &engine_.history()[place.block], place.walkInBlock, walks[i], 0 });
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    WalkShooter::Stored last = rayless[i];
    last.bounce = last.block->size(last.walkInBlock) - 1;
    paths[i].escapes = !last.block->hit(last.walkInBlock, last.bounce);
    if (paths[i].escapes)
    {
      rayless.push_back(last);
      escaping.push_back(i);
    }
  }
  std::vector<Ray> rays(rayless.size());
  shooter_.raysOf(rayless.data(), rayless.size(), rays.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    paths[i].walk = walks[i];
    paths[i].power = shooter_.rules().powerOf(walks[i]);
    paths[i].points.push_back(rays[i].origin);
    addHits(rayless[i], paths[i]);
  }
  for (std::size_t i = 0; i < escaping.size(); ++i)
  {
    paths[escaping[i]].points.push_back(endOf(rays[count + i]));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    addMarks(engine_.plan().placeOf(walks[i]), paths[i]);
  }
}

void WalkPaths::addHits(const WalkShooter::Stored& walk, WalkPath& path) const
{
  const std::uint32_t size = walk.block->size(walk.walkInBlock);
  for (std::uint32_t bounce = 0; bounce < size; ++bounce)
  {
    if (const Hit hit = walk.block->hit(walk.walkInBlock, bounce))
    {
      path.points.push_back(
        surfacePoint(shooter_.rules().triangleOf(hit.id), weightsOf(hit)).position);
    }
  }
}

void WalkPaths::addMarks(const WalkPlan::Place& place, WalkPath& path) const
{
  const std::vector<RepairedTail>& repaired = engine_.repaired();
  const auto tail =
    std::lower_bound(repaired.begin(), repaired.end(), RepairedTail{ path.walk, 0 });
  const bool isRepaired = tail != repaired.end() && tail->walk == path.walk;
  path.firstRepaired = isRepaired ? std::size_t{ tail->bounce } + 1 : path.points.size();
  constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
  path.isStale = engine_.stale() && place.block < engine_.stale()->numberOfBlocks() &&
    irradiance::isStale(engine_.stale()->marks(place.block), { place.walkInBlock, kLast });
}

Vector3 WalkPaths::endOf(const Ray& ray) const
{
  double length = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double wall = ray.direction[axis] > 0 ? bounds_.upper[axis] : bounds_.lower[axis];
    if (ray.direction[axis] != 0)
    {
      length = std::min(length, (wall - ray.origin[axis]) / ray.direction[axis]);
    }
  }
  return ray.origin + length * ray.direction;
}

}
