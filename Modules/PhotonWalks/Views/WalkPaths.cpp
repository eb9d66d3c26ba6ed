// SPDX-License-Identifier: BSD-3-Clause
#include "Views/WalkPaths.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <iterator>
#include <limits>

namespace irradiance
{

namespace
{

/// Ranks send integers.
void write(const WalkPath& path, std::vector<std::int64_t>& numbers)
{
  numbers.insert(numbers.end(),
    { path.walk, path.escapes ? 1 : 0, path.isStale ? 1 : 0,
      static_cast<std::int64_t>(path.firstRepaired),
      static_cast<std::int64_t>(path.points.size()) });
  numbers.insert(numbers.end(), path.power.quanta.begin(), path.power.quanta.end());
  for (const Vector3& point : path.points)
  {
    std::array<std::int64_t, 3> bits;
    std::memcpy(bits.data(), point.data(), sizeof bits);
    numbers.insert(numbers.end(), bits.begin(), bits.end());
  }
}

/// Leaves `next` behind what write() wrote.
WalkPath read(const std::int64_t*& next)
{
  WalkPath path{};
  path.walk = static_cast<std::uint32_t>(*next++);
  path.escapes = *next++ != 0;
  path.isStale = *next++ != 0;
  path.firstRepaired = static_cast<std::size_t>(*next++);
  path.points.resize(static_cast<std::size_t>(*next++));
  for (std::int64_t& quanta : path.power.quanta)
  {
    quanta = *next++;
  }
  for (Vector3& point : path.points)
  {
    std::memcpy(point.data(), next, 3 * sizeof *next);
    next += 3;
  }
  return path;
}

/// The paths that all ranks have, ordered by walk. Throws RankFailed.
std::vector<WalkPath> pathsOfAll(const std::vector<WalkPath>& own, Ranks& ranks)
{
  std::vector<std::int64_t> numbers;
  for (const WalkPath& path : own)
  {
    write(path, numbers);
  }
  numbers = ranks.concatenate(numbers);
  std::vector<WalkPath> all;
  for (const std::int64_t* next = numbers.data(); next != numbers.data() + numbers.size();)
  {
    all.push_back(read(next));
  }
  std::sort(
    all.begin(), all.end(), [](const WalkPath& a, const WalkPath& b) { return a.walk < b.walk; });
  return all;
}

/// In order.
std::vector<std::uint32_t> walksOfAll(const std::vector<std::uint32_t>& own, Ranks& ranks)
{
  const std::vector<std::int64_t> all = ranks.concatenate({ own.begin(), own.end() });
  std::vector<std::uint32_t> walks(all.size());
  std::transform(all.begin(), all.end(), walks.begin(),
    [](std::int64_t walk) { return static_cast<std::uint32_t>(walk); });
  std::sort(walks.begin(), walks.end());
  return walks;
}

}

WalkPaths::WalkPaths(const IrradianceEngine& engine)
  : engine_(engine)
  , walks_(engine.walks(), engine.frame())
  , bounds_(engine.walkBounds())
{
  assert(engine.storesWalks());
  const double diagonal = bounds_.isEmpty() ? 0.0 : bounds_.extent().norm();
  bounds_.inflate(diagonal > 0 ? diagonal / 8 : 1.0); // a point light alone has no size
}

std::vector<std::uint32_t> WalkPaths::first(std::size_t most) const
{
  const std::vector<WalkSet>& sets = engine_.walks().sets();
  const bool hasGathered = std::any_of(
    sets.begin(), sets.end(), [](const WalkSet& set) { return set.gathered() != nullptr; });
  return hasGathered ? firstBorn(most) : engine_.walks().first(most);
}

/// Those whose numbers, read backwards as fractions, are the smallest: every second, fourth or
/// eighth.
std::vector<std::uint32_t> WalkPaths::firstBorn(std::size_t most) const
{
  std::vector<std::pair<std::uint64_t, std::uint32_t>> walks; // with what they are ordered by
  for (const WalkSet& set : engine_.walks().sets())
  {
    const std::uint32_t first = set.plan().rounds().front().firstWalk;
    const std::uint32_t all =
      set.lights().isEmpty() ? 0 : set.plan().walksAfter(set.sums().rounds());
    for (std::uint32_t i = 0; i < all; ++i)
    {
      if (!set.gathered() || set.gathered()->isBorn(first + i))
      {
        walks.emplace_back(SobolPoint::reversed(i), first + i);
      }
    }
  }
  const std::size_t count = std::min(most, walks.size());
  std::partial_sort(walks.begin(), walks.begin() + static_cast<std::ptrdiff_t>(count), walks.end());
  std::vector<std::uint32_t> chosen(count);
  std::transform(walks.begin(), walks.begin() + static_cast<std::ptrdiff_t>(count), chosen.begin(),
    [](const auto& walk) { return walk.second; });
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

bool WalkPaths::beginsOn(const SceneCell& cell, const WalkSet& set, std::uint32_t walk) const
{
  if (set.gathered())
  {
    const DirectSample& sample = set.gathered()->sampleOf(walk);
    const TriangleId id = engine_.frame().triangles.idOf(sample.triangle);
    return engine_.sums().cellOf(id) == cell || set.lights()[sample.light].cell == cell;
  }
  // Of a cell that does not emit no sample has to be drawn.
  const auto& emission = engine_.objects()[cell.object].emission;
  return emission && emission->emits(cell.cell) && walks_.stages(walk).lightOf(walk).cell == cell;
}

std::vector<std::uint32_t> WalkPaths::touching(
  const SceneCell& cell, std::size_t most, Execution& execution) const
{
  std::vector<std::pair<const WalkSet*, std::size_t>> blocks;
  for (const WalkSet& set : engine_.walks().sets())
  {
    for (std::size_t i = 0; i < set.history().size() && engine_.hasLights(); ++i)
    {
      blocks.emplace_back(&set, i);
    }
  }
  std::vector<std::vector<std::uint32_t>> found(blocks.size());
  forEachSliced(found.size(), execution, [&](std::size_t number) {
    const auto& [set, index] = blocks[number];
    const BounceBlock& block = set->history().block(index);
    for (std::uint32_t walk = block.firstWalk();
         walk < block.endWalk() && found[number].size() < most; ++walk)
    {
      const bool isBorn = block.begin(walk) != BounceBlock::kNone;
      if (isBorn && (isHit(set->history(), index, walk, cell) || beginsOn(cell, *set, walk)))
      {
        found[number].push_back(walk);
      }
    }
  });
  std::vector<std::uint32_t> walks;
  for (const std::vector<std::uint32_t>& some : found)
  {
    const std::size_t count = std::min(some.size(), most - walks.size());
    walks.insert(walks.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(count));
  }
  if (engine_.walks().areShared())
  {
    walks = walksOfAll(walks, execution.ranks());
    walks.resize(std::min(walks.size(), most));
  }
  return walks;
}

bool WalkPaths::isHit(
  const WalkHistory& history, std::size_t block, std::uint32_t walk, const SceneCell& cell) const
{
  bool isHit = false;
  history.forEachPhotonFrom({ block, history.block(block).begin(walk) }, { walk, 0 },
    [&](const Photon& photon) { isHit = isHit || engine_.sums().cellOf(photon.id) == cell; });
  return isHit;
}

std::vector<WalkPath> WalkPaths::paths(
  const std::vector<std::uint32_t>& all, Execution& execution) const
{
  constexpr std::size_t kPerUnit = 64;
  std::vector<std::uint32_t> walks; // of this rank
  std::copy_if(all.begin(), all.end(), std::back_inserter(walks),
    [this](std::uint32_t walk) { return walks_.setOf(walk).has(walk); });
  std::vector<WalkPath> paths(walks.size());
  forEachSliced((walks.size() + kPerUnit - 1) / kPerUnit, execution, [&](std::size_t unit) {
    const std::size_t begin = unit * kPerUnit;
    find(walks.data() + begin, std::min(kPerUnit, walks.size() - begin), paths.data() + begin);
  });
  return engine_.walks().areShared() ? pathsOfAll(paths, execution.ranks()) : paths;
}

void WalkPaths::find(const std::uint32_t* walks, std::size_t count, WalkPath* paths) const
{
  std::vector<SegmentRef> rayless; // first segments, and those that escape
  std::vector<std::size_t> escaping;
  for (std::size_t i = 0; i < count; ++i)
  {
    rayless.push_back({ walks[i], 0 });
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const WalkHistory& history = walks_.historyOf(walks[i]);
    const BounceBlock& block = history.block(history.indexOf(walks[i]));
    const SegmentRef last = block.segmentAt(block.lastOf(walks[i]));
    paths[i].escapes = !history.hit(last);
    if (paths[i].escapes)
    {
      rayless.push_back(last);
      escaping.push_back(i);
    }
  }
  std::vector<Ray> rays(rayless.size());
  walks_.raysOf(rayless, rays.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    paths[i].walk = walks[i];
    addStart(rays[i], paths[i]);
    addHits(paths[i]);
  }
  for (std::size_t i = 0; i < escaping.size(); ++i)
  {
    paths[escaping[i]].points.push_back(endOf(rays[count + i]));
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    addMarks(paths[i]);
  }
}

void WalkPaths::addStart(const Ray& first, WalkPath& path) const
{
  const DirectRounds* const gathered = walks_.setOf(path.walk).gathered();
  if (!gathered)
  {
    path.power = walks_.stages(path.walk).powerOf(path.walk);
    path.points.push_back(first.origin);
    return;
  }
  const DirectSample& sample = gathered->sampleOf(path.walk);
  const double b = sample.weightB, c = sample.weightC;
  path.power = gathered->powerOf(path.walk);
  path.points.push_back(sample.from);
  path.points.push_back(
    surfacePoint(engine_.scene().worldTriangle(first.start), { 1 - b - c, b, c }).position);
}

void WalkPaths::addHits(WalkPath& path) const
{
  const WalkHistory& history = walks_.historyOf(path.walk);
  const SegmentRef first{ path.walk, 0 };
  history.forEachPhotonFrom(history.placeOf(first), first, [&](const Photon& photon) {
    const Hit hit{ 0, photon.id, photon.weights };
    path.points.push_back(
      surfacePoint(engine_.scene().worldTriangle(hit.id), weightsOf(hit)).position);
  });
}

void WalkPaths::addMarks(WalkPath& path) const
{
  const WalkSet& set = walks_.setOf(path.walk);
  const std::vector<SegmentRef>& repaired = set.repaired();
  const auto tail = std::lower_bound(repaired.begin(), repaired.end(), SegmentRef{ path.walk, 0 });
  const bool isRepaired = tail != repaired.end() && tail->walk == path.walk;
  const std::size_t before = set.gathered() ? 2 : 1; // points before the first hit
  path.firstRepaired = isRepaired ? tail->bounce + before : path.points.size();
  constexpr std::uint32_t kLast = std::numeric_limits<std::uint32_t>::max();
  const std::size_t block = set.history().indexOf(path.walk);
  path.isStale = set.stale() && block < set.stale()->numberOfBlocks() &&
    irradiance::isStale(set.stale()->marks(block), { path.walk, kLast });
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
