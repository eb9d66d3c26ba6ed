#include "RaySet.h"

#include "Sampling/DirectionSampling.h"
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

/// World triangles, to be drawn by area.
class AreaTable
{
public:
  AreaTable(const SceneObjects& objects, std::size_t skipped)
  {
    for (std::uint32_t i = 0; i < objects.size(); ++i)
    {
      for (const Triangle& triangle : objects[i].body->mesh().triangles())
      {
        triangles_.push_back(transformed(objects[i].worldFromObject, triangle));
      }
    }
    triangles_.erase(triangles_.begin(), triangles_.begin() + static_cast<std::ptrdiff_t>(skipped));
    for (const Triangle& triangle : triangles_)
    {
      area_ += triangle.areaVector().norm();
      upTo_.push_back(area_);
    }
  }

  const Triangle& draw(double u) const
  {
    const auto found = std::upper_bound(upTo_.begin(), upTo_.end() - 1, u * area_);
    return triangles_[static_cast<std::size_t>(found - upTo_.begin())];
  }

private:
  std::vector<Triangle> triangles_;
  std::vector<double> upTo_;
  double area_ = 0;
};

std::vector<Ray> fromSurfaces(
  const SceneObjects& objects, std::size_t skipped, double offset, std::uint32_t count)
{
  const AreaTable table(objects, skipped);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const Triangle& triangle = table.draw(kSamples.sample(i, 0, SampleUse::Emitter)[0]);
    const Vector3 weights = sampleTriangle(kSamples.sample(i, 0, SampleUse::Position));
    const Vector3 normal = triangle.areaVector().normalized();
    const Vector3 point =
      weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
    rays.push_back(asFloats(point + offset * normal,
      sampleCosineHemisphere(normal, kSamples.sample(i, 0, SampleUse::Direction))));
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
      sampleCosineHemisphere(-Vector3::UnitZ(), { x / (16 * columns), y / (16 * rows) })));
  }
  return rays;
}

}

char letterOf(RaySet set)
{
  return set == RaySet::Surfaces ? 'I' : set == RaySet::Objects ? 'O' : 'P';
}

std::vector<RaySet> raySetsOf(const BenchmarkScene& scene)
{
  if (scene.numberOfWallTriangles == 0)
  {
    return { RaySet::Surfaces, RaySet::Light };
  }
  return { RaySet::Surfaces, RaySet::Light, RaySet::Objects };
}

std::vector<Ray> makeRays(const BenchmarkScene& scene, RaySet set, std::uint32_t count)
{
  if (set == RaySet::Light)
  {
    return fromLight(scene.light, count);
  }
  const double offset = 1e-5 * boundsOf(scene.objects).extent().maxCoeff();
  return fromSurfaces(
    scene.objects, set == RaySet::Objects ? scene.numberOfWallTriangles : 0, offset, count);
}
