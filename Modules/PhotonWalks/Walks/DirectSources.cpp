// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/DirectSources.h"

#include "Surfaces/MeanReflectance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace irradiance
{

namespace
{

/// How many times as many walks those near lights shoot, beside which others start at cells: with
/// as little power, as the noise of both is to cost alike.
double timesAtLights(double reflected, const WalkPlan& plan)
{
  constexpr double kLeast = 0.25;
  constexpr std::uint32_t kMost = std::uint32_t{ 1 } << 28; // walks have numbers of 32 bits
  return plan.most() < kMost ? 1 / std::clamp(reflected, kLeast, 1.0) : 1;
}

/// Parts a source by how its lights are best known. `atLights`: see deal().
std::vector<WalkSource> partsOf(const WalkSource& source, const LightSurvey::Group& group,
  double atLights, const FewestSamples& fewestSamples)
{
  std::vector<WalkSource> parts;
  for (const Known part : { Known::Dim, Known::Shot })
  {
    WalkSource some{ group.lightsOf(source, part), source.plan };
    some.areFoundByRays = part == Known::Dim;
    some.areNear = part == Known::Shot && !group.areHardToFind;
    if (group.lamps && group.lamps->lights() == some.lights)
    {
      some.lamps = group.lamps;
    }
    if (!some.lights.isEmpty())
    {
      parts.push_back(std::move(some));
    }
  }
  if (parts.empty() || group.isGathered())
  {
    WalkSource gathered{ group.lightsOf(source, Known::Gathered), source.plan, CellPart{} };
    gathered.lamps = group.lamps;
    gathered.walksPerSample = group.walksPerSample;
    gathered.fewest = fewestSamples.atVariance(group.variance);
    parts.push_back(std::move(gathered));
  }
  if (parts.size() > 1 || !parts.front().cells)
  {
    deal(parts, source.plan, atLights);
  }
  return parts;
}

}

std::vector<WalkSource> directSourcesOf(const SceneObjects& objects,
  const std::vector<WalkSource>& sources, const LightSurvey& survey,
  const FewestSamples& fewestSamples)
{
  std::vector<WalkSource> gathered, all;
  std::uint32_t end = 0; // of the numbers of walks that start at lights
  const double reflected = meanReflectance(objects.staticObject);
  const bool isAnyGathered = std::any_of(
    survey.groups().begin(), survey.groups().end(), std::mem_fn(&LightSurvey::Group::isGathered));
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    const double atLights = isAnyGathered ? timesAtLights(reflected, sources[i].plan) : 1;
    for (WalkSource& part : partsOf(sources[i], survey.groups()[i], atLights, fewestSamples))
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
  // How many walks are born is not known yet: static cells have half of the numbers, the others
  // share the rest evenly.
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
        std::llround(LightSurvey::powerOfStart(reflected) *
          static_cast<double>(source.lights.quantaPerWalk())));
      all.back().fewest = part.isStatic() ? fewestSamples.asMany() : source.fewest;
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
    if (source.areFoundByRays)
    {
      continue; // nothing asks them
    }
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
