// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Sampling/ElementaryFunctions.h"

#include <array>

namespace irradiance
{

/// Unit vector at a given height over the plane across the unit vector `axis`, `turns` around it.
/// `radius` is the distance from the axis: height^2 + radius^2 = 1. The frame around the axis is
/// from Duff et al., "Building an Orthonormal Basis, Revisited" (JCGT 2017).
inline Vector3 directionAround(const Vector3& axis, double height, double radius, double turns)
{
  const double sign = __builtin_copysign(1.0, axis[2]);
  const double a = -1.0 / (sign + axis[2]);
  const double b = axis[0] * axis[1] * a;
  const SinCos turn(turns);
  const double p = radius * turn.cosine, q = radius * turn.sine;
  return { p * (1.0 + sign * axis[0] * axis[0] * a) + q * b + height * axis[0],
    p * (sign * b) + q * (sign + axis[1] * axis[1] * a) + height * axis[1],
    height * axis[2] - (p * (sign * axis[0]) + q * axis[1]) };
}

/**
 * Vector on the hemisphere around a normal, density cos(theta) / pi per steradian, in float, from
 * samples in units of 2^-32. It is of unit length, and its height over the plane is the right one,
 * to within 2^-20: the frame and the products take some ten roundings of 2^-24. So it always points
 * to the side of the normal, for `u` = 2^32 - 1 as well, as the least height is 2^-16.5. That takes
 * all 32 bits of the sample: the height is computed from its complement, which is as exact for
 * large `u` as the radius is for small ones.
 */
struct CosineDirectionInFloat
{
  float x, y, z;

  /// The normal is of unit length, rounded to float.
  __attribute__((always_inline)) CosineDirectionInFloat(
    float normalX, float normalY, float normalZ, std::uint32_t u, std::uint32_t v)
  {
    const float height = __builtin_sqrtf(toUnit(~u)), radius = __builtin_sqrtf(toUnit(u));
    const TurnInFloat turn(v);
    const float p = radius * turn.cosine, q = radius * turn.sine;
    // The frame of directionAround().
    const float sign = __builtin_copysignf(1.0F, normalZ);
    const float a = -1 / (sign + normalZ);
    const float b = normalX * normalY * a;
    x = p * (1 + sign * normalX * normalX * a) + q * b + height * normalX;
    y = p * (sign * b) + q * (sign + normalY * normalY * a) + height * normalY;
    z = height * normalZ - (p * (sign * normalX) + q * normalY);
  }

private:
  /// In the middle of its step of 2^-32, rounded to float: in (0, 1].
  __attribute__((always_inline)) static float toUnit(std::uint32_t sample)
  {
    return (static_cast<float>(sample) + 0.5F) * 0x1p-32F;
  }
};

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
