// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/LobeLight.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// The power heuristic: the weight of a sample of one density beside those of another, > 0.
double weightBeside(double density, double other)
{
  const double ratio = other / density;
  return 1 / (1 + ratio * ratio);
}

}

Bands lobeLight(const FinalGatherScene& scene, const PathVertex& from, const PhongLobe& lobe,
  std::uint64_t number, std::uint32_t share)
{
  const Vector3& normal = from.point.normal;
  const PointDirectLight::Part part = [&](const Vector3& along, double density) {
    const Vector3 toLight = -along.normalized();
    const double ofLobe = lobe.value(normal, toLight, -from.incoming) * toLight.dot(normal);
    return ofLobe > 0 ? kPi * ofLobe * weightBeside(density, ofLobe) : 0;
  };
  Bands sum{};
  for (const PointDirectLight& lights : scene.lights)
  {
    sum += lights.taken(from.point, part, number, share);
  }
  return sum;
}

double lampWeight(const FinalGatherScene& scene, const Ray& ray, double density,
  const TriangleId& lamp, const Vector3& place)
{
  const Vector3 front = scene.frame.scene.worldTriangle(ray.start).areaVector().normalized();
  const Vector3 normal = front.dot(ray.direction) > 0 ? front : Vector3(-front);
  double asked = 0;
  for (const PointDirectLight& lights : scene.lights)
  {
    asked += lights.density({ ray.origin, normal, ray.start }, lamp, place);
  }
  return asked > 0 ? weightBeside(density, asked) : 1;
}

}
