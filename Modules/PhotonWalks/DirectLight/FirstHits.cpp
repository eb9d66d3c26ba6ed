// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/FirstHits.h"

#include "Sampling/DirectionSampling.h"
#include "Sampling/SobolPoint.h"
#include "Scene/Scene.h"
#include "Surfaces/ClearSheets.h"
#include "Surfaces/CoincidentTriangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace irradiance
{

namespace
{

constexpr std::uint32_t kRays = 16; ///< cast together
/// From all lights, and from each of many.
constexpr std::size_t kRaysOfAll = 2048, kFewestRays = 4;
using Rays = std::array<Ray, kRays>;
using Ways = std::vector<ClearSheets::Way>;

/// The part of the flux of which more has to arrive: of less nothing is known.
constexpr double kLeastArrived = 0.1;

/// Near is what is hit within so many edges of a square of two such triangles: from there on
/// samples do as well.
constexpr double kNear = 0.5;

/// The rays of all lights go on with the same points: equal ones would send rays of different
/// lights to one place. Every other ray is of the second half, which knows nothing of the first.
std::uint32_t halfOf(std::uint32_t ray)
{
  return ray % 2;
}

std::array<double, 2> pointOf(std::uint32_t ray, std::uint64_t use)
{
  return SobolPoint::inUnitSquare(ray / 2, SampleKeys(splitMix(2 * use + halfOf(ray))));
}

/// As light leaves the light: some rays after the first ones. Dynamic triangles are not there.
Rays raysFrom(const Light& light, std::uint32_t first, std::uint32_t count)
{
  Rays rays;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    rays[i] = light.leaving(pointOf(first + i, 1), pointOf(first + i, 2));
    rays[i].start = rays[i].start.isDynamic() ? TriangleId{} : rays[i].start;
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

/// What a cell reflects, W, of the rays of each half.
using OnCell = std::array<double, 2>;

/// The sum over hits of what is reflected and arrives again, for each of what arrives.
double returnedOf(const Scene& scene, const Material& material, const Rays& rays, const Ways& ways,
  std::uint32_t first)
{
  Rays onwards;
  std::array<double, kRays> parts{};
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < ways.size(); ++i)
  {
    if (const Hit& hit = ways[i].hit)
    {
      SurfacePoint point = surfacePoint(scene.worldTriangle(hit.id), weightsOf(hit));
      point.turn(point.normal.dot(rays[i].direction) < 0);
      onwards[count] = { point.clearPosition(),
        sampleHemisphere(point.normal, pointOf(first + i, 3)), hit.id };
      parts[count++] = ways[i].passed * material.keptOf(hit.id.triangle);
    }
  }
  std::array<Hit, kRays> again;
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
  const Material& material = *objects.staticObject.material;
  Scene scene;
  scene.setStatic(objects.staticObject.body);
  scene.commit({});
  const ClearSheets sheets{ objects, scene };
  const auto noTarget = [](std::size_t) { return TriangleId{}; };
  // From each light as many, so that each is known to be near or not.
  const auto count = static_cast<std::uint32_t>(
    std::max(kFewestRays, kRaysOfAll / std::max<std::size_t>(1, lights.lights().size())));
  double returned = 0;
  std::uint32_t begin = 0; // of the rays of a light
  for (std::uint32_t number = 0; number < lights.lights().size(); ++number)
  {
    const Light& light = lights[number];
    const double fluxOfRay = light.totalFlux() / count;
    std::uint32_t near = 0;
    const std::uint32_t end = begin + count;
    for (std::uint32_t first = begin; first < end; first += kRays)
    {
      const std::uint32_t together = std::min(kRays, end - first);
      const Rays rays = raysFrom(light, first, together);
      const Ways ways = sheets.cast(rays.data(), together, noTarget, kInfinity);
      for (std::uint32_t i = 0; i < together; ++i)
      {
        if (const Hit& hit = ways[i].hit)
        {
          near += isNear(scene, hit) ? 1 : 0;
          const Vector3 normal = scene.worldTriangle(hit.id).areaVector();
          arrivals_.push_back({ number, hit.id.triangle, normal.dot(rays[i].direction) < 0,
            halfOf(first + i), ways[i].passed * fluxOfRay });
        }
      }
      returned += fluxOfRay * returnedOf(scene, material, rays, ways, first);
    }
    nearLights_.push_back(light.surface() && 2 * near > count);
    begin = end;
  }
  sumUp(objects.staticObject);
  returned_ = arrived_ > kLeastArrived * lights.flux() ? returned / arrived_ : 1;
}

void FirstHits::sumUp(const SceneObject& object)
{
  const Material& material = *object.material;
  std::vector<OnCell> cells(material.numberOfCells);
  for (const Arrival& arrival : arrivals_)
  {
    arrived_ += arrival.flux;
    cells[material.cellOfTriangle[arrival.triangle]][arrival.half] +=
      arrival.flux * material.keptOf(arrival.triangle);
  }
  const std::vector<double> areas = cellAreas(object);
  for (std::size_t cell = 0; cell < cells.size(); ++cell)
  {
    area_ += areas[cell];
    const auto [one, other] = cells[cell];
    reflected_ += one + other;
    // Each has half of the power. The square of one would have its noise in it.
    reflectedSquares_ += areas[cell] > 0 ? 4 * one * other / areas[cell] : 0;
  }
}

/// What arrives at first and returns at each reflection fills the static object evenly, roughly: as
/// much as its mean radiosity.
std::vector<bool> FirstHits::dimLights(
  const SceneObjects& objects, const LightTable& lights, double reflected) const
{
  // Times the mean radiosity. Twice as bright a ceiling is found with less noise by looking for it.
  constexpr double kBrightest = 1.5;
  constexpr double kMostReturned = 0.99; // what returns is known from few rays
  const double returned = std::min({ returned_, reflected, kMostReturned });
  const double brightest = area_ > 0 ? kBrightest * arrived_ / (1 - returned) / area_ : 0;
  std::vector<bool> areDim;
  for (const Light& light : lights.lights())
  {
    const SceneObject& object = objects[light.cell.object];
    const double* const exitance = light.surface() ? object.exitanceOf(light.cell.cell) : nullptr;
    areDim.push_back(exitance && !light.distribution() &&
      std::accumulate(exitance, exitance + object.emission->bands, 0.0) <= brightest);
  }
  return areDim;
}

}
