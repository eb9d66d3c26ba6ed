// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/NearestEstimate.h"

#include "Meshes/TriangleInSphere.h"

namespace irradiance
{

double facingArea(const NearestPhotons& photons, const Sensor& sensor, double radius)
{
  double area = 0;
  for (std::uint32_t i = 0; i < photons.objects().size(); ++i)
  {
    const SceneObject& object = photons.objects()[i];
    const PlacedTree& tree = photons.tree(i);
    if (!object.isPresent || tree.distanceAtLeast(sensor.position) > radius)
    {
      continue;
    }
    const Facing facing = tree.facing(sensor);
    const Matrix3 flattening = sensor.flattening();
    const AffineMap flattened{ flattening * object.worldFromObject.linear,
      flattening * (object.worldFromObject.translation - sensor.position) };
    const auto add = [&](std::uint32_t triangle) {
      const Triangle& model = object.body->mesh()[triangle];
      if (facing.side(model) != 0)
      {
        // A plane map keeps the ratios of areas.
        const Triangle flat = transformed(flattened, model);
        const double inside = areaInSphere(flat, radius);
        area +=
          inside > 0 ? inside / flat.area() * transformed(object.worldFromObject, model).area() : 0;
      }
    };
    photons.leaves().table(i).forEachNear(
      object.body->tree(), tree.modelBounds(sensor, radius), add);
  }
  return area;
}

NearestEstimate nearestEstimate(
  const NearestPhotons& photons, const Sensor& sensor, std::uint32_t count, double maximumRadius)
{
  if (photons.isTooFar(sensor))
  {
    return { {}, 0, maximumRadius, 0 };
  }
  const NearPhotons near = photons.find(sensor, count, maximumRadius);
  const std::size_t counted = near.photons.size() - (near.areAll ? 0 : 1);
  NearestEstimate estimate{ {}, facingArea(photons, sensor, near.radius), near.radius,
    static_cast<std::uint32_t>(near.photons.size()) };
  for (std::size_t i = 0; i < counted; ++i)
  {
    estimate.power += photons.history().power(near.photons[i]);
  }
  return estimate;
}

}
