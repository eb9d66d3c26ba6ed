// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectionSampling_h
#define irradiance_DirectionSampling_h

#include "Geometry/Vector.h"
#include "Sampling/Turn.h"

#include <array>

namespace irradiance
{

/**
 * Unit vector on the hemisphere around the unit vector `normal`, density cos(theta) / pi per
 * steradian. Without branches, so that a loop over many becomes SIMD. The frame around the normal is
 * that of Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
 */
struct CosineDirection
{
  double x, y, z;

  /// `u`, `v`: a point of the unit square.
  __attribute__((always_inline))
  CosineDirection(double normalX, double normalY, double normalZ, double u, double v)
  {
    const double sign = __builtin_copysign(1.0, normalZ);
    const double a = -1.0 / (sign + normalZ);
    const double b = normalX * normalY * a;
    const Turn turn(v);
    const double radius = __builtin_sqrt(u), height = __builtin_sqrt(1 - u);
    const double p = radius * turn.cosine, q = radius * turn.sine;
    x = p * (1.0 + sign * normalX * normalX * a) + q * b + height * normalX;
    y = p * (sign * b) + q * (sign + normalY * normalY * a) + height * normalY;
    z = height * normalZ - (p * (sign * normalX) + q * normalY);
  }
};

inline Vector3 sampleCosineHemisphere(const Vector3& normal, const std::array<double, 2>& u)
{
  const CosineDirection direction(normal[0], normal[1], normal[2], u[0], u[1]);
  return { direction.x, direction.y, direction.z };
}

/// Unit vector, density 1 / (4 pi) per steradian.
inline Vector3 sampleSphere(const std::array<double, 2>& u)
{
  const double z = 1 - 2 * u[0];
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  const Turn turn(u[1]);
  return { radius * turn.cosine, radius * turn.sine, z };
}

/// Barycentric weights of a point that is uniform over the area of a triangle.
inline Vector3 sampleTriangle(const std::array<double, 2>& u)
{
  const double root = std::sqrt(u[0]);
  return { 1 - root, root * (1 - u[1]), root * u[1] };
}

}

#endif
