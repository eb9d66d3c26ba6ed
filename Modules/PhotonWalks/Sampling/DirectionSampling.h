// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectionSampling_h
#define irradiance_DirectionSampling_h

#include "Geometry/Vector.h"
#include "Sampling/ElementaryFunctions.h"

#include <array>

namespace irradiance
{

/**
 * Unit vector at a given height over the plane across the unit vector `axis`, `turns` around it.
 * `radius` is the distance from the axis: height^2 + radius^2 = 1. Without branches, so that a loop
 * over many becomes SIMD. The frame around the axis is from Duff et al., "Building an Orthonormal
 * Basis, Revisited" (JCGT 2017).
 */
struct DirectionAround
{
  double x, y, z;

  __attribute__((always_inline)) DirectionAround(
    double axisX, double axisY, double axisZ, double height, double radius, double turns)
  {
    const double sign = __builtin_copysign(1.0, axisZ);
    const double a = -1.0 / (sign + axisZ);
    const double b = axisX * axisY * a;
    const SinCos turn(turns);
    const double p = radius * turn.cosine, q = radius * turn.sine;
    x = p * (1.0 + sign * axisX * axisX * a) + q * b + height * axisX;
    y = p * (sign * b) + q * (sign + axisY * axisY * a) + height * axisY;
    z = height * axisZ - (p * (sign * axisX) + q * axisY);
  }
};

inline Vector3 directionAround(const Vector3& axis, double height, double radius, double turns)
{
  const DirectionAround direction(axis[0], axis[1], axis[2], height, radius, turns);
  return { direction.x, direction.y, direction.z };
}

/// Unit vector, density 1 / (4 pi) per steradian.
inline Vector3 sampleSphere(const std::array<double, 2>& u)
{
  const double z = 1 - 2 * u[0];
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  const SinCos turn(u[1]);
  return { radius * turn.cosine, radius * turn.sine, z };
}

/// Unit vector on the normal's side, density cos(theta) / pi per steradian.
inline Vector3 sampleHemisphere(const Vector3& normal, const std::array<double, 2>& u)
{
  return directionAround(normal, std::sqrt(1 - u[0]), std::sqrt(u[0]), u[1]);
}

/// Barycentric weights of a point that is uniform over the area of a triangle.
inline Vector3 sampleTriangle(const std::array<double, 2>& u)
{
  const double root = std::sqrt(u[0]);
  return { 1 - root, root * (1 - u[1]), root * u[1] };
}

}

#endif
