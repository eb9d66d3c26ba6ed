// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/NearLights.h"

#include "Sampling/DirectionSampling.h"
#include "Sampling/SobolPoint.h"
#include "Scene/Scene.h"
#include "Surfaces/Touching.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr std::uint32_t kRays = 16; ///< from each light

/// Near is what is hit within so many edges of a square of two such triangles: from there on samples do as well.
constexpr double kNear = 0.5;

/// As light leaves the light, from points of low discrepancy that are the same for all lights.
std::array<Ray, kRays> raysFrom(const AreaLight& light)
{
  std::array<Ray, kRays> rays;
  for (std::uint32_t i = 0; i < kRays; ++i)
  {
    const std::array<double, 2> place = SobolPoint::inUnitSquare(i, SampleKeys(splitMix(1)));
    const std::array<double, 2> turn = SobolPoint::inUnitSquare(i, SampleKeys(splitMix(2)));
    const SurfacePoint start = surfacePoint(light.triangle, sampleTriangle(place));
    rays[i] = { start.clearPosition(),
      directionAround(start.normal, std::sqrt(1 - turn[0]), std::sqrt(turn[0]), turn[1]),
      light.id.isDynamic() ? TriangleId{} : light.id }; // dynamic ones are not there
  }
  return rays;
}

/// Not if it touches the light: then it receives exactly what the light emits at its place.
bool isNear(const Scene& scene, const Hit& hit)
{
  const Triangle triangle = scene.worldTriangle(hit.id);
  return hit.distance < kNear * std::sqrt(2 * triangle.area()) &&
    hit.distance > 8 * kTouching * triangle.bounds().magnitude();
}

}

std::vector<bool> findNearLights(const SceneObjects& objects, const LightTable& lights)
{
  Scene scene;
  scene.setStatic(objects.staticObject.body);
  scene.commit({});
  std::vector<bool> near;
  for (const Light& light : lights.lights())
  {
    std::array<Hit, kRays> hits;
    if (const auto* const area = std::get_if<AreaLight>(&light.kind))
    {
      scene.cast(raysFrom(*area).data(), kRays, hits.data());
    }
    const auto count = std::count_if(
      hits.begin(), hits.end(), [&](const Hit& hit) { return hit && isNear(scene, hit); });
    near.push_back(2 * count > kRays);
  }
  return near;
}

}
