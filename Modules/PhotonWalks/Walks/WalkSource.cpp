// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSource.h"

#include "DirectLight/PowerClasses.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

/// The sky of a table, or all else.
LightTable partOf(const LightTable& table, bool isSky)
{
  std::vector<bool> chosen;
  for (const Light& light : table.lights())
  {
    chosen.push_back((light.distant() && light.distant()->isSky()) == isSky);
  }
  return table.only(chosen);
}

/// Of a walk: rounding them changes its power by less than .2 %.
constexpr double kFewestQuanta = 256;

}

void deal(std::vector<WalkSource>& sources, const WalkPlan& plan, double atLights, double alike)
{
  const std::uint32_t first = plan.walksAfter(1), replicates = plan.replicates().count();
  const std::uint32_t times = std::uint32_t{ 1 } << std::ilogb(plan.most() / first);
  const double flux = std::accumulate(sources.begin(), sources.end(), 0.0,
    [](double sum, const WalkSource& source) { return sum + source.lights.flux(); });
  std::uint32_t firstWalk = plan.replicates().firstWalk();
  double sum = 0;
  std::int64_t given = 0; // walks of each replicate
  for (WalkSource& source : sources)
  {
    LightTable& lights = source.lights;
    const double share = lights.flux() / flux * first;
    const double dealt = (1 - alike) * share + alike * first / static_cast<double>(sources.size());
    const double number = std::min(source.cells ? dealt : dealt * atLights,
      share * static_cast<double>(lights.quantaPerWalk()) / kFewestQuanta);
    sum += number / replicates; // rounded as a whole, so that none gets lost
    const auto ofReplicate = std::max<std::int64_t>(1, std::llround(sum) - given);
    given += ofReplicate;
    const std::uint32_t walks = replicates * static_cast<std::uint32_t>(ofReplicate);
    source.plan = WalkPlan(walks, walks * times, replicates, firstWalk);
    firstWalk += walks * times;
    lights.setQuantaPerWalk(std::max<std::int64_t>(
      1, std::llround(static_cast<double>(lights.quantaPerWalk()) * (share / walks))));
  }
}

std::vector<WalkSource> sourcesOf(
  const SceneObjects& objects, const WalkPlan& plan, const LightWalls& walls)
{
  // A class is worth a few walks of each replicate, of enough quanta.
  constexpr double kFewestWalks = 4;
  const double walks = plan.walksAfter(1) / (kFewestWalks * plan.replicates().count());
  const LightTable lights(objects, plan.most(), walls);
  std::vector<WalkSource> sources;
  bool haveClasses = false;
  for (const bool isSky : { false, true })
  {
    const LightTable part = partOf(lights, isSky);
    if (part.isEmpty())
    {
      continue;
    }
    std::vector<LightTable> classes = powerClassesOf(
      part, objects, kFewestQuanta / (static_cast<double>(part.quantaPerWalk()) * walks));
    haveClasses = haveClasses || classes.size() > 1;
    for (LightTable& some : classes)
    {
      sources.push_back({ std::move(some), plan });
    }
  }
  if (sources.empty())
  {
    sources.push_back({ {}, plan });
  }
  if (sources.size() > 1)
  {
    constexpr double kAlike = 0.9;
    deal(sources, plan, 1, haveClasses ? kAlike : 0);
  }
  return sources;
}

}
