// SPDX-License-Identifier: BSD-3-Clause
#ifndef Directions_h
#define Directions_h

#include "Geometry/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pathtracedroom
{

/// A unit vector, distributed evenly over the sphere.
inline irradiance::Vector3 sphereDirection(const std::array<double, 2>& u)
{
  const double z = 1 - 2 * u[0], radius = std::sqrt(std::max(0.0, 1 - z * z));
  const double around = 2 * M_PI * u[1];
  return { radius * std::cos(around), radius * std::sin(around), z };
}

/// A unit vector on the side of the unit normal, with the density cosine / pi per steradian: a
/// point of the sphere that touches the surface, as seen from where it touches.
inline irradiance::Vector3 cosineDirection(
  const irradiance::Vector3& normal, const std::array<double, 2>& u)
{
  const irradiance::Vector3 direction = normal + sphereDirection(u);
  const double length = direction.norm();
  return length > 0 ? irradiance::Vector3(direction / length) : normal;
}

/// Barycentric weights of a point that is distributed evenly over a triangle.
inline irradiance::Vector3 evenWeights(const std::array<double, 2>& u)
{
  const double root = std::sqrt(u[0]);
  return { 1 - root, root * (1 - u[1]), root * u[1] };
}

}

#endif
