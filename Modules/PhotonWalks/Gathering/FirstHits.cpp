// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/FirstHits.h"

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

constexpr std::uint32_t kRays = 16; ///< from each light at most
/// From each of many lights: fewer, as all together tell how much returns.
constexpr std::uint32_t kFewestRays = 4;
constexpr std::size_t kRaysOfAll = 4096;
using Rays = std::array<Ray, kRays>;
using Hits = std::array<Hit, kRays>;

/// Near is what is hit within so many edges of a square of two such triangles: from there on samples do as well.
constexpr double kNear = 0.5;

/// The same points of low discrepancy for all lights.
std::array<double, 2> pointOf(std::uint32_t ray, std::uint64_t use)
{
  return SobolPoint::inUnitSquare(ray, SampleKeys(splitMix(use)));
}

Ray diffuseRay(const SurfacePoint& point, const TriangleId& start, const std::array<double, 2>& u)
{
  return { point.clearPosition(), sampleHemisphere(point.normal, u), start };
}

/// As light leaves the light.
Rays raysFrom(const Light& light, std::uint32_t count)
{
  Rays rays;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    if (const auto* const area = std::get_if<AreaLight>(&light.kind))
    {
      const TriangleId start = area->id.isDynamic() ? TriangleId{} : area->id; // it is not there
      const Vector3 weights = sampleTriangle(pointOf(i, 1));
      rays[i] = diffuseRay(surfacePoint(area->triangle, weights), start, pointOf(i, 2));
    }
    else
    {
      rays[i] = light.leaving(pointOf(i, 2));
    }
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

/// The sum over hits of what is reflected and arrives again, for each of what arrives.
double returnedOf(const Scene& scene, const Material& material, const Rays& rays, const Hits& hits,
  std::uint32_t raysOfLight)
{
  Rays onwards;
  std::array<double, kRays> parts{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < raysOfLight; ++i)
  {
    if (hits[i])
    {
      SurfacePoint point = surfacePoint(scene.worldTriangle(hits[i].id), weightsOf(hits[i]));
      point.turn(point.normal.dot(rays[i].direction) < 0);
      onwards[count] = diffuseRay(point, hits[i].id, pointOf(i, 3));
      parts[count++] = material.reflectedOf(hits[i].id.triangle);
    }
  }
  Hits again;
  scene.cast(onwards.data(), count, again.data());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += again[i] ? parts[i] : 0;
  }
  return sum;
}

}

FirstHits::FirstHits(const SceneObjects& objects, const LightTable& lights)
{
  Scene scene;
  scene.setStatic(objects.staticObject.body);
  scene.commit({});
  const auto count = static_cast<std::uint32_t>(std::clamp(
    kRaysOfAll / (lights.lights().size() + 1), std::size_t{ kFewestRays }, std::size_t{ kRays }));
  double returned = 0;
  for (const Light& light : lights.lights())
  {
    const Rays rays = raysFrom(light, count);
    Hits hits;
    scene.cast(rays.data(), count, hits.data());
    const bool isArea = std::holds_alternative<AreaLight>(light.kind);
    const auto near = std::count_if(
      hits.begin(), hits.end(), [&](const Hit& hit) { return hit && isNear(scene, hit); });
    nearLights_.push_back(isArea && 2 * near > count);
    const double fluxOfRay = light.totalFlux() / count;
    arrived_ += fluxOfRay *
      static_cast<double>(std::count_if(
        hits.begin(), hits.end(), [](const Hit& hit) { return static_cast<bool>(hit); }));
    returned += fluxOfRay * returnedOf(scene, *objects.staticObject.material, rays, hits, count);
  }
  returned_ = arrived_ > 0 ? returned / arrived_ : 1;
}

}
