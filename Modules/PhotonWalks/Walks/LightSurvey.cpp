// SPDX-License-Identifier: BSD-3-Clause
#include "Walks/LightSurvey.h"

#include "DirectLight/DirectPilot.h"
#include "DirectLight/FirstHits.h"
#include "Surfaces/MeanReflectance.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace irradiance
{

namespace
{

std::vector<Known> knownBy(
  const WalkSource& source, const FirstHits& hits, const std::vector<bool>& areDim)
{
  const std::vector<Light>& lights = source.lights.lights();
  std::vector<Known> known(lights.size(), Known::Gathered);
  std::array<double, 3> flux{};
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    known[i] = areDim[i] ? Known::Dim : hits.nearLights()[i] ? Known::Shot : Known::Gathered;
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

LightSurvey::Group groupOf(
  const SceneObjects& objects, const WalkSource& source, const FirstHits& hits, double reflected)
{
  LightSurvey::Group group;
  group.known = knownBy(source, hits, hits.dimLights(objects, source.lights, reflected));
  const LightTable gathered = group.lightsOf(source, Known::Gathered);
  if (gathered.isEmpty())
  {
    return group;
  }
  group.lamps = std::make_shared<const LampPieces>(gathered);
  const DirectPilot pilot(objects, *group.lamps);
  group.variance = pilot.variance();
  const DirectPilot::Sampling sampling = pilot.best(
    hits.arrived() / source.lights.flux(), hits.returned(), LightSurvey::powerOfStart(reflected));
  group.cost = sampling.cost;
  group.areHardToFind = sampling.cost >= 1;
  group.walksPerSample = sampling.walksPerSample;
  if (group.areHardToFind)
  {
    std::replace(group.known.begin(), group.known.end(), Known::Gathered, Known::Shot);
  }
  return group;
}

/// Of static objects, W.
double staticFlux(const LightTable& table)
{
  return std::accumulate(
    table.lights().begin(), table.lights().end(), 0.0, [](double sum, const Light& light) {
      return sum + (light.cell.object == 0 ? light.totalFlux() : 0);
    });
}

/// What different groups send is not alike in its places: their product is that of their means.
double unevennessOf(const std::vector<WalkSource>& sources, const std::vector<FirstHits>& hits,
  const std::vector<LightSurvey::Group>& groups)
{
  const double area = hits.front().area();
  double power = 0, squares = 0; // W, W2/m2
  const auto add = [&](double more, double moreSquares) {
    squares += moreSquares + (area > 0 ? 2 * power * more / area : 0);
    power += more;
  };
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    add(hits[i].reflected(), hits[i].reflectedSquares());
    double emitted = 0, emittedSquares = 0;
    const std::vector<Light>& lights = sources[i].lights.lights();
    for (std::size_t light = 0; light < lights.size(); ++light)
    {
      if (groups[i].known[light] == Known::Dim && lights[light].cell.object == 0)
      {
        const double flux = lights[light].totalFlux();
        emitted += flux;
        emittedSquares += flux * flux / lights[light].surface()->area();
      }
    }
    add(emitted, emittedSquares);
  }
  return power > 0 ? std::max(1.0, squares * area / (power * power)) : 1;
}

}

double LightSurvey::powerOfStart(double reflected)
{
  return std::clamp(reflected, 0.0625, 1.0);
}

LightTable LightSurvey::Group::lightsOf(const WalkSource& source, Known part) const
{
  std::vector<bool> chosen(known.size());
  std::transform(
    known.begin(), known.end(), chosen.begin(), [part](Known its) { return its == part; });
  return source.lights.only(chosen);
}

LightSurvey::LightSurvey(const SceneObjects& objects, const std::vector<WalkSource>& sources)
{
  const double reflected = meanReflectance(objects.staticObject);
  std::vector<FirstHits> hits;
  hits.reserve(sources.size());
  for (const WalkSource& source : sources)
  {
    hits.emplace_back(objects, source.lights);
  }
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    groups_.push_back(groupOf(objects, sources[i], hits[i], reflected));
  }
  unevenness_ = unevennessOf(sources, hits, groups_);
}

double LightSurvey::hiddenVariance() const
{
  double most = 0;
  for (const Group& group : groups_)
  {
    most = group.areHardToFind ? std::max(most, group.variance) : most;
  }
  return most;
}

double LightSurvey::gatheredVariance() const
{
  double sum = 0, flux = 0;
  for (const Group& group : groups_)
  {
    if (group.isGathered())
    {
      sum += group.variance * staticFlux(group.lamps->lights());
      flux += group.lamps->lights().flux();
    }
  }
  return flux > 0 ? sum / flux : 0;
}

double LightSurvey::gatheringCost() const
{
  double sum = 0, flux = 0;
  bool hasLights = false;
  for (const Group& group : groups_)
  {
    hasLights = hasLights || !group.known.empty();
    if (group.lamps)
    {
      sum += group.cost * group.lamps->lights().flux();
      flux += group.lamps->lights().flux();
    }
  }
  return flux > 0 ? sum / flux : hasLights ? 1 : 0;
}

}
