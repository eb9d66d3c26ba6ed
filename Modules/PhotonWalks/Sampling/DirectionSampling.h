// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectionSampling_h
#define irradiance_DirectionSampling_h

#include "Geometry/Vector.h"

#include <array>

namespace irradiance
{

/// Two unit vectors that form a right-handed orthonormal frame with the unit vector `normal`. After
/// Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
inline std::array<Vector3, 2> tangentsOf(const Vector3& normal)
{
  const double sign = std::copysign(1.0, normal[2]);
  const double a = -1.0 / (sign + normal[2]);
  const double b = normal[0] * normal[1] * a;
  return { Vector3(1.0 + sign * normal[0] * normal[0] * a, sign * b, -sign * normal[0]),
    Vector3(b, sign + normal[1] * normal[1] * a, -normal[1]) };
}

/// Unit vector on the hemisphere around `normal`, density cos(theta) / pi per steradian.
inline Vector3 sampleCosineHemisphere(const Vector3& normal, const std::array<double, 2>& u)
{
  const double radius = std::sqrt(u[0]), angle = 2 * M_PI * u[1];
  const auto [tangent, bitangent] = tangentsOf(normal);
  return radius * std::cos(angle) * tangent + radius * std::sin(angle) * bitangent +
    std::sqrt(1 - u[0]) * normal;
}

/// Unit vector, density 1 / (4 pi) per steradian.
inline Vector3 sampleSphere(const std::array<double, 2>& u)
{
  const double z = 1 - 2 * u[0], angle = 2 * M_PI * u[1];
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return { radius * std::cos(angle), radius * std::sin(angle), z };
}

/// Barycentric weights of a point that is uniform over the area of a triangle.
inline Vector3 sampleTriangle(const std::array<double, 2>& u)
{
  const double root = std::sqrt(u[0]);
  return { 1 - root, root * (1 - u[1]), root * u[1] };
}

}

#endif
