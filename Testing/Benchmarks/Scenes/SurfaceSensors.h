// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Photons/Sensor.h"
#include "Surfaces/SceneObjects.h"

#include <cmath>
#include <random>
#include <vector>

/// At random on all surfaces, uniform over the area, on the front.
inline std::vector<irradiance::Sensor> makeSurfaceSensors(
  const irradiance::SceneObjects& objects, std::size_t count)
{
  std::vector<irradiance::Triangle> triangles;
  std::vector<double> areas;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (const irradiance::Triangle& triangle : objects[object].body->mesh().triangles())
    {
      triangles.push_back(transformed(objects[object].worldFromObject, triangle));
      areas.push_back(triangles.back().area());
    }
  }
  std::mt19937_64 random(3);
  std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit;
  std::vector<irradiance::Sensor> sensors;
  while (sensors.size() < count)
  {
    const irradiance::Triangle& triangle = triangles[choose(random)];
    const double s = std::sqrt(unit(random)), t = s * unit(random);
    sensors.push_back({ (1 - s) * triangle.a + (s - t) * triangle.b + t * triangle.c,
      triangle.areaVector().normalized() });
  }
  return sensors;
}
