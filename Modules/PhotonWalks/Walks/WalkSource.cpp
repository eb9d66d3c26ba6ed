// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSource.h"

#include "Gathering/FirstHits.h"
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

/// Shares the walks of a plan by flux; those that start at lights are `atLights` times as many.
void deal(std::vector<WalkSource>& sources, const WalkPlan& plan, double atLights = 1)
{
  const std::uint32_t first = plan.walksAfter(1), replicates = plan.replicates().count();
  const std::uint32_t times = std::uint32_t{ 1 } << std::ilogb(plan.most() / first);
  const double flux = std::accumulate(sources.begin(), sources.end(), 0.0,
    [](double sum, const WalkSource& source) { return sum + source.lights.flux(); });
  std::uint32_t firstWalk = plan.replicates().firstWalk();
  for (WalkSource& source : sources)
  {
    LightTable& lights = source.lights;
    const double share = lights.flux() / flux * first;
    const double number = source.cells ? share : share * atLights;
    const std::uint32_t walks =
      replicates * std::max(1u, static_cast<std::uint32_t>(number / replicates));
    source.plan = WalkPlan(walks, walks * times, replicates, firstWalk);
    firstWalk += walks * times;
    lights.setQuantaPerWalk(std::max<std::int64_t>(
      1, std::llround(static_cast<double>(lights.quantaPerWalk()) * (share / walks))));
  }
}

/// Where little of the light returns, what is gathered is nearly all light, and deserves most of the work.
double walksPerSample(double returned)
{
  constexpr double kUsual = 36, kFewest = 3, kMuch = 0.5;
  return std::clamp(kUsual * returned / kMuch, kFewest, kUsual);
}

/// Where little is reflected, many weak walks are of no use.
double powerOfStart(double reflected)
{
  return std::clamp(reflected, 0.0625, 1.0);
}

/// How many times as many walks those near lights shoot, beside which others start at cells: with as little power,
/// as the noise of both is to cost alike.
double timesAtLights(double reflected, const WalkPlan& plan)
{
  constexpr double kLeast = 0.25;
  constexpr std::uint32_t kMost = std::uint32_t{ 1 } << 28; // walks have numbers of 32 bits
  return plan.most() < kMost ? 1 / std::clamp(reflected, kLeast, 1.0) : 1;
}

/// Parts a source in two, with the lights that are near static cells and with all others; no part that is
/// worth less than a walk of each replicate. `reflected`: the mean part of static cells.
std::vector<WalkSource> partedByNearness(const SceneObjects& objects, const WalkSource& source,
  double reflected, const FewestSamples& fewestSamples)
{
  const FirstHits hits(objects, source.lights);
  std::vector<bool> chosen = hits.nearLights();
  std::vector<WalkSource> parts{ { source.lights.only(chosen), source.plan },
    { {}, source.plan, CellPart{} } };
  parts[1].density = { walksPerSample(hits.returned()), fewestSamples };
  chosen.flip();
  parts[1].lights = source.lights.only(chosen);
  const double least =
    source.lights.flux() / source.plan.walksAfter(1) * source.plan.replicates().count();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (parts[i].lights.flux() <= least)
    {
      parts[1 - i].lights = source.lights;
      return { parts[1 - i] };
    }
  }
  deal(parts, source.plan, timesAtLights(reflected, source.plan));
  return parts;
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

std::vector<WalkSource> gatheredSourcesOf(const SceneObjects& objects,
  const std::vector<WalkSource>& sources, const FewestSamples& fewestSamples)
{
  std::vector<WalkSource> gathered, all;
  std::uint32_t end = 0; // of the numbers of walks that start at lights
  const double reflected = meanReflectance(objects.staticObject);
  for (const WalkSource& source : sources)
  {
    for (WalkSource& part : partedByNearness(objects, source, reflected, fewestSamples))
    {
      if (!part.cells)
      {
        const WalkPlan& plan = part.plan;
        part.plan = WalkPlan(plan.walksAfter(1), plan.most(), plan.replicates().count(), end);
        end = part.plan.endWalk();
      }
      (part.cells ? gathered : all).push_back(std::move(part));
    }
  }
  // How many walks are born is not known yet: static cells have half of the numbers, the others share the rest evenly.
  const std::vector<CellPart> parts = cellParts(objects);
  const auto groups = static_cast<std::uint32_t>(std::max<std::size_t>(1, gathered.size()));
  const auto others = static_cast<std::uint32_t>(parts.size() - 1);
  const std::uint32_t share = (std::numeric_limits<std::uint32_t>::max() - end) / groups;
  const std::uint32_t ofStatic = others > 0 ? share / 2 : share;
  for (const WalkSource& source : gathered)
  {
    for (const CellPart& part : parts)
    {
      all.push_back(source);
      all.back().cells = part;
      all.back().quantaPerStart = std::max<std::int64_t>(1,
        std::llround(powerOfStart(reflected) * static_cast<double>(source.lights.quantaPerWalk())));
      all.back().firstWalk = end;
      end += part.isStatic() ? ofStatic : (share - ofStatic) / std::max(1u, others);
    }
  }
  return all;
}

void addLamps(std::vector<WalkSource>& sources)
{
  std::shared_ptr<const LampPieces> lamps;
  for (WalkSource& source : sources)
  {
    if (!source.isDynamic())
    {
      lamps = std::make_shared<const LampPieces>(source.lights);
    }
    source.lamps = lamps;
  }
}

}
