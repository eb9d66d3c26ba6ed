// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/RaySet.h"

#include "../../PhotonWalks/CosineHemisphere.h"
#include "Sampling/SobolSequence.h"

#include <algorithm>
#include <cmath>

using namespace irradiance;

namespace
{

const SobolSequence kSamples(1);

Ray asFloats(const Vector3& origin, const Vector3& direction)
{
  return { origin.cast<float>().cast<double>(), direction.cast<float>().cast<double>(), {} };
}

/// From the triangles, by area.
std::vector<Ray> fromSurfaces(
  const std::vector<Triangle>& triangles, double offset, std::uint32_t count)
{
  double area = 0;
  std::vector<double> upTo;
  for (const Triangle& triangle : triangles)
  {
    area += triangle.areaVector().norm();
    upTo.push_back(area);
  }
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const double u = kSamples.sample(i, 0, SampleUse::Light)[0];
    const auto found = std::upper_bound(upTo.begin(), upTo.end() - 1, u * area);
    const Triangle& triangle = triangles[static_cast<std::size_t>(found - upTo.begin())];
    const Vector3 weights = sampleTriangle(kSamples.sample(i, 0, SampleUse::Position));
    const Vector3 normal = triangle.areaVector().normalized();
    const Vector3 point =
      weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
    rays.push_back(asFloats(point + offset * normal,
      test::sampleCosineHemisphere(normal, kSamples.sample(i, 0, SampleUse::Direction))));
  }
  return rays;
}

/// Every second bit of a number below 256: one coordinate of a place on the Morton curve.
std::uint32_t everySecondBit(std::uint32_t morton)
{
  return (morton & 1) | (morton >> 1 & 2) | (morton >> 2 & 4) | (morton >> 3 & 8);
}

/// The directions are stratified on a grid, which is gone through in tiles of 16 x 16.
std::vector<Ray> fromLight(const AreaLight& light, std::uint32_t count)
{
  const std::uint32_t tiles = (count + 255) / 256;
  const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(tiles)));
  const std::uint32_t rows = (tiles + columns - 1) / columns;
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t tile = i / 256, place = i % 256;
    const std::array<double, 2> jitter = kSamples.sample(i, 0, SampleUse::Direction);
    const double x = 16 * (tile % columns) + everySecondBit(place) + jitter[0];
    const double y = 16 * (tile / columns) + everySecondBit(place >> 1) + jitter[1];
    const std::array<double, 2> at = kSamples.sample(i, 0, SampleUse::Position);
    rays.push_back(asFloats(light.center + light.edge * Vector3(at[0] - 0.5, at[1] - 0.5, 0),
      test::sampleCosineHemisphere(-Vector3::UnitZ(), { x / (16 * columns), y / (16 * rows) })));
  }
  return rays;
}

}

std::vector<RaySet> makeRaySets(const BenchmarkScene& scene, std::uint32_t count)
{
  std::vector<Triangle> triangles = worldTriangles(scene.objects);
  const double offset = 1e-5 * TriangleMesh(triangles).bounds().extent().maxCoeff();
  std::vector<RaySet> sets = { { 'I', fromSurfaces(triangles, offset, count) },
    { 'P', fromLight(scene.light, count) } };
  if (scene.numberOfWallTriangles > 0)
  {
    triangles.erase(triangles.begin(),
      triangles.begin() + static_cast<std::ptrdiff_t>(scene.numberOfWallTriangles));
    sets.push_back({ 'O', fromSurfaces(triangles, offset, count) });
  }
  return sets;
}
