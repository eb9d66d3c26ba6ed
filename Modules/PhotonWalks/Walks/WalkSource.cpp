// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/WalkSource.h"

#include "Gathering/DimLights.h"
#include "Gathering/GatherPilot.h"
#include "Surfaces/MeanReflectance.h"

#include <algorithm>
#include <array>
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

/// How a light is best known.
enum class Known
{
  Dim,     ///< walks start at it, and rays find it
  Shot,    ///< walks start at it
  Gathered ///< cells look for it
};

std::vector<Known> knownBy(const WalkSource& source, const FirstHits& hits, const DimLights& dim)
{
  const std::vector<Light>& lights = source.lights.lights();
  std::vector<Known> known(lights.size(), Known::Gathered);
  std::array<double, 3> flux{};
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    known[i] = dim.contains(lights[i]) ? Known::Dim
      : hits.nearLights()[i]           ? Known::Shot
                                       : Known::Gathered;
    flux[static_cast<std::size_t>(known[i])] += lights[i].totalFlux();
  }
  // No part is to be worth less than a walk of each replicate.
  const double least =
    source.lights.flux() / source.plan.walksAfter(1) * source.plan.replicates().count();
  const auto isWeak = [&](Known part) { return flux[static_cast<std::size_t>(part)] <= least; };
  const auto join = [&](Known part, Known other) {
    std::replace(known.begin(), known.end(), part, other);
    flux[static_cast<std::size_t>(other)] += std::exchange(flux[static_cast<std::size_t>(part)], 0);
  };
  for (const Known part : { Known::Dim, Known::Shot })
  {
    if (isWeak(part))
    {
      join(part, Known::Gathered);
    }
  }
  if (isWeak(Known::Gathered) && flux[static_cast<std::size_t>(Known::Gathered)] > 0)
  {
    isWeak(Known::Shot) ? join(Known::Dim, Known::Gathered) : join(Known::Gathered, Known::Shot);
  }
  return known;
}

/// Those of a source that are known in this way.
LightTable lightsOf(const WalkSource& source, const std::vector<Known>& known, Known part)
{
  std::vector<bool> chosen(known.size());
  std::transform(
    known.begin(), known.end(), chosen.begin(), [part](Known its) { return its == part; });
  return source.lights.only(chosen);
}

/// Parts a source by how its lights are best known. `reflected`: the mean part of static cells.
std::vector<WalkSource> partsOf(const SceneObjects& objects, const WalkSource& source,
  const FirstHits& hits, const DimLights& dim, double reflected, const FewestSamples& fewestSamples)
{
  std::vector<Known> known = knownBy(source, hits, dim);
  bool areHardToFind = false;
  WalkSource gathered{ lightsOf(source, known, Known::Gathered), source.plan, CellPart{} };
  gathered.density = { GatherPilot::kMostWalks, fewestSamples };
  if (!gathered.lights.isEmpty())
  {
    gathered.lamps = std::make_shared<const LampPieces>(gathered.lights);
    const std::optional<double> walks = GatherPilot(objects, *gathered.lamps)
                                          .walksPerSample(hits.returned(), powerOfStart(reflected));
    gathered.density.walksPerSample = walks.value_or(GatherPilot::kMostWalks);
    areHardToFind = !walks;
    if (areHardToFind)
    {
      std::replace(known.begin(), known.end(), Known::Gathered, Known::Shot);
    }
  }
  std::vector<WalkSource> parts;
  for (const Known part : { Known::Dim, Known::Shot })
  {
    WalkSource some{ lightsOf(source, known, part), source.plan };
    some.areFoundByRays = part == Known::Dim;
    some.areNear = part == Known::Shot && !areHardToFind;
    if (!some.lights.isEmpty())
    {
      parts.push_back(std::move(some));
    }
  }
  const bool isGathered =
    parts.empty() || std::find(known.begin(), known.end(), Known::Gathered) != known.end();
  if (isGathered)
  {
    parts.push_back(std::move(gathered));
  }
  if (parts.size() > 1)
  {
    deal(parts, source.plan, isGathered ? timesAtLights(reflected, source.plan) : 1);
  }
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
  std::vector<FirstHits> hits;
  hits.reserve(sources.size());
  for (const WalkSource& source : sources)
  {
    hits.emplace_back(objects, source.lights);
  }
  const DimLights dim(objects, hits, reflected);
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    for (WalkSource& part : partsOf(objects, sources[i], hits[i], dim, reflected, fewestSamples))
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
      auto own = source.lamps ? std::make_shared<LampPieces>(*source.lamps)
                              : std::make_shared<LampPieces>(source.lights);
      own->setQuantaPerWalk(source.lights.quantaPerWalk()); // walks were dealt since
      lamps = std::move(own);
    }
    source.lamps = lamps;
  }
}

}
