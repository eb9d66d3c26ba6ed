// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSource.h"

#include "Surfaces/MeanReflectance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

std::uint32_t numberOfGroups(const SceneObjects& objects)
{
  std::uint32_t groups = 1;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    if (objects[i].emits() && !objects[i].emission->groups.empty())
    {
      const std::vector<std::uint32_t>& some = objects[i].emission->groups;
      groups = std::max(groups, *std::max_element(some.begin(), some.end()) + 1);
    }
  }
  return groups;
}

/// Shares the walks of a plan.
void deal(std::vector<WalkSource>& sources, const WalkPlan& plan)
{
  const std::uint32_t first = plan.walksAfter(1), replicates = plan.replicates().count();
  const std::uint32_t times = std::uint32_t{ 1 } << std::ilogb(plan.most() / first);
  const double flux = std::accumulate(sources.begin(), sources.end(), 0.0,
    [](double sum, const WalkSource& source) { return sum + source.lights.flux(); });
  std::vector<std::uint32_t> walks;
  std::uint32_t firstWalk = 0;
  for (WalkSource& source : sources)
  {
    const double share = source.lights.flux() / flux * first / replicates;
    walks.push_back(replicates * std::max(1u, static_cast<std::uint32_t>(share)));
    source.plan = WalkPlan(walks.back(), walks.back() * times, replicates, firstWalk);
    firstWalk += walks.back() * times;
  }
  const double all = std::accumulate(walks.begin(), walks.end(), 0.0);
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    LightTable& lights = sources[i].lights;
    const double quanta =
      static_cast<double>(lights.quantaPerWalk()) * (lights.flux() / flux) * (all / walks[i]);
    lights.setQuantaPerWalk(std::max<std::int64_t>(1, std::llround(quanta)));
  }
}

}

std::vector<WalkSource> sourcesOf(
  const SceneObjects& objects, const WalkPlan& plan, const LightWalls& walls)
{
  std::vector<WalkSource> sources;
  for (std::uint32_t group = 0; group < numberOfGroups(objects); ++group)
  {
    WalkSource source{ LightTable(objects, plan.most(), walls, group), plan };
    if (!source.lights.isEmpty())
    {
      sources.push_back(std::move(source));
    }
  }
  if (sources.empty())
  {
    sources.push_back({ {}, plan });
  }
  if (sources.size() > 1)
  {
    deal(sources, plan);
  }
  return sources;
}

std::vector<WalkSource> gatheredSourcesOf(
  const SceneObjects& objects, const std::vector<WalkSource>& sources)
{
  std::vector<WalkSource> gathered;
  const bool hasDynamic = !objects.dynamicObjects.empty();
  const auto count = static_cast<std::uint32_t>(sources.size() * (hasDynamic ? 2 : 1));
  // Where little is reflected, many weak walks are of no use.
  constexpr double kLeast = 0.0625;
  const double reflected = std::clamp(meanReflectance(objects.staticObject), kLeast, 1.0);
  for (const WalkSource& source : sources)
  {
    for (const CellPart part : { CellPart::Static, CellPart::Dynamic })
    {
      if (part == CellPart::Static || hasDynamic)
      {
        // How many walks are born is not known yet: numbers are shared evenly.
        const auto number = static_cast<std::uint32_t>(gathered.size());
        gathered.push_back(source);
        gathered.back().cells = part;
        gathered.back().quantaPerStart = std::max<std::int64_t>(
          1, std::llround(reflected * static_cast<double>(source.lights.quantaPerWalk())));
        gathered.back().firstWalk = number * (std::numeric_limits<std::uint32_t>::max() / count);
      }
    }
  }
  return gathered;
}

}
