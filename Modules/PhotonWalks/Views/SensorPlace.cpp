// SPDX-License-Identifier: BSD-3-Clause
#include "Views/SensorPlace.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// In sizes of the scene.
constexpr double kFarthest = 0x1p20;

/// Towards the middle of the bounds: 1 along each axis at their faces and beyond.
Vector3 inwards(const Box& bounds, const Vector3& position)
{
  const Vector3 half = 0.5 * bounds.extent(), away = bounds.center() - position;
  Vector3 direction = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = half[axis] > 0 ? std::clamp(away[axis] / half[axis], -1.0, 1.0) : 0;
  }
  return direction;
}

}

Box boundsBesideLamps(const SceneObjects& objects)
{
  Box all, besideLamps;
  for (std::uint32_t number = 0; number < objects.size(); ++number)
  {
    const SceneObject& object = objects[number];
    all.add(object.worldBounds());
    if (!object.emission)
    {
      besideLamps.add(object.worldBounds());
      continue;
    }
    for (std::uint32_t i = 0; i < object.mesh().size(); ++i)
    {
      if (!object.isLamp(i))
      {
        besideLamps.add(transformed(object.worldFromObject, object.mesh()[i]).bounds());
      }
    }
  }
  // Lamps that are not far away count: the walls of an oven may all be lamps.
  constexpr double kFar = 64; // sizes of the scene
  return all.extent().maxCoeff() <= kFar * besideLamps.extent().cwiseMax(0).maxCoeff() ||
      besideLamps.isEmpty()
    ? all
    : besideLamps;
}

double sensorClearance(const Box& near)
{
  return near.isEmpty() ? 0 : 0x1p-20 * near.extent().maxCoeff() + 0x1p-32 * near.magnitude();
}

std::optional<LitPoint> sensorPlace(const Box& bounds, const Box& near, const Sensor& sensor)
{
  LitPoint place{ sensor.position, sensor.normal };
  if (bounds.isEmpty())
  {
    return place;
  }
  const Vector3 away = (bounds.lower - sensor.position).cwiseMax(sensor.position - bounds.upper);
  if (away.maxCoeff() > kFarthest * bounds.extent().maxCoeff())
  {
    return std::nullopt;
  }
  const Vector3 off = place.hasNormal() ? sensor.normal : inwards(near, sensor.position);
  place.position += sensorClearance(near) * off;
  return place;
}

}
