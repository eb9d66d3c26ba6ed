// SPDX-License-Identifier: BSD-3-Clause
#include "Views/SensorGather.h"

#include "Views/ReplicateParts.h"
#include "Views/SensorPlace.h"

#include <algorithm>
#include <limits>
#include <numeric>

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
  : noShapes_(engine.objects(), engine.space().triangles, 0, 0)
  , gather_(checked(engine), noShapes_, rays, false, execution)
  , direct_(
      lightsOf(engine.walks(), engine.gatherSpace(), engine.settings().seed, gather_.scene().rays))
{
}

std::vector<SensorGather::Light> SensorGather::at(
  const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers) const
{
  const GatherScene& scene = gather_.scene();
  std::vector<std::optional<LitPoint>> places;
  const PathSums brought = gather_.follow([&](GatherPaths& paths) {
    for (const std::size_t number : numbers)
    {
      places.push_back(sensorPlace(scene.space.scene.bounds(), sensors[number]));
      if (places.back())
      {
        paths.addPoint(scene, *places.back(), number);
      }
    }
  });
  std::vector<Light> found;
  std::size_t start = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    found.push_back(
      places[i] ? lightOf(replicatesOf(brought, start++, *places[i], numbers[i])) : unknownLight());
  }
  return found;
}

std::vector<SensorGather::Bands> SensorGather::replicatesOf(
  const PathSums& brought, std::size_t start, const LitPoint& point, std::size_t number) const
{
  // Radiance is radiosity / pi; the density of rays is cos(theta) / pi, or 1 / (4 pi).
  std::vector<Bands> replicates = gather_.replicatesOf(brought, start, point.hasNormal() ? 1 : 4);
  for (const PointDirectLight& lights : direct_)
  {
    lights.add(point, number, replicates);
  }
  return replicates;
}

SensorGather::Light SensorGather::lightOf(const std::vector<Bands>& replicates)
{
  Light light{};
  std::vector<double> parts(replicates.size());
  for (std::size_t band = 0; band < light.value.size(); ++band)
  {
    std::transform(replicates.begin(), replicates.end(), parts.begin(),
      [band](const Bands& replicate) { return replicate[band]; });
    light.value[band] = std::accumulate(parts.begin(), parts.end(), 0.0);
    light.standardError[band] = standardErrorOf(parts);
  }
  return light;
}

}
