// SPDX-License-Identifier: BSD-3-Clause
#include "Views/SensorGather.h"

#include "Views/SensorPlace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace irradiance
{

namespace
{

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Before anything is counted.
const IrradianceEngine& checked(const IrradianceEngine& engine)
{
  checkLights(engine.objects(), "Estimate");
  return engine;
}

SensorGather::Light unknownLight()
{
  SensorGather::Light light{};
  light.value.fill(kUnknown);
  light.standardError.fill(kUnknown);
  return light;
}

}

SensorGather::SensorGather(const IrradianceEngine& engine, std::uint32_t rays, Execution& execution)
  : engine_(checked(engine))
  , replicates_(engine.walks().plan().replicates().count())
  , sums_(engine.walks(), engine.objects(), execution)
  , noShapes_(engine.objects(), engine.space().triangles, 0, 0)
  , direct_(lightsOf(
      engine.walks(), engine.gatherSpace(), engine.settings().seed, dealtRays(rays, replicates_)))
  , lights_(lightsOf(engine.walks(), engine.gatherSpace(), engine.settings().seed, kSamplesOfHit))
  , scene_{ engine.gatherSpace(), engine.objects(), engine.cells(), noShapes_,
    CellRoles(
      engine.cells(), engine.numberOfWalks(), engine.hasLights() ? rays : 0, GatherOn::Small),
    { sums_.sums(), nullptr, nullptr, sums_.sums().rounds() }, lights_,
    dealtRays(rays, replicates_), 1 / engine.watts(1.0), engine.settings().seed, false }
{
}

std::vector<SensorGather::Light> SensorGather::at(
  const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers) const
{
  std::unique_ptr<GatherPaths> paths = paths_.take();
  paths->begin(scene_);
  std::vector<std::optional<LitPoint>> places;
  for (const std::size_t number : numbers)
  {
    places.push_back(sensorPlace(scene_.space.scene.bounds(), sensors[number]));
    if (places.back())
    {
      paths->addPoint(scene_, *places.back(), number);
    }
  }
  paths->run(scene_);
  const std::size_t numberOfPlaces = paths->followed().size() / scene_.rays;
  PathSums brought;
  brought.read(scene_, paths->followed(), numberOfPlaces);
  std::vector<Light> found;
  std::size_t start = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    found.push_back(
      places[i] ? lightOf(replicatesOf(brought, start++, *places[i], numbers[i])) : unknownLight());
  }
  paths_.giveBack(std::move(paths));
  return found;
}

std::vector<SensorGather::Bands> SensorGather::replicatesOf(
  const PathSums& brought, std::size_t start, const LitPoint& point, std::size_t number) const
{
  // Radiance is radiosity / pi; the density of rays is cos(theta) / pi, or 1 / (4 pi).
  const double perRay = point.hasNormal() ? 1 : 4;
  std::vector<Bands> replicates(replicates_);
  for (std::uint32_t k = 0; k < replicates_; ++k)
  {
    const PathSums::Bands& quanta = brought.found(start, k);
    std::transform(quanta.begin(), quanta.end(), replicates[k].begin(),
      [&](double quantaPerArea) { return engine_.watts(perRay * quantaPerArea); });
  }
  for (const PointDirectLight& lights : direct_)
  {
    lights.add(point, number, replicates);
  }
  return replicates;
}

/// Each replicate has its part of the whole.
SensorGather::Light SensorGather::lightOf(const std::vector<Bands>& replicates) const
{
  Light light{};
  for (std::size_t band = 0; band < light.value.size(); ++band)
  {
    double sum = 0, squares = 0;
    for (const Bands& replicate : replicates)
    {
      sum += replicate[band];
    }
    const double count = replicates_;
    for (const Bands& replicate : replicates)
    {
      squares += std::pow(count * replicate[band] - sum, 2);
    }
    light.value[band] = sum;
    light.standardError[band] =
      replicates_ > 1 && sum > 0 ? std::sqrt(squares / (count * (count - 1))) : kUnknown;
  }
  return light;
}

}
