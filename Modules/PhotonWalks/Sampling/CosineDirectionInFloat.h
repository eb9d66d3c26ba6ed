// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CosineDirectionInFloat_h
#define irradiance_CosineDirectionInFloat_h

#include "Sampling/ElementaryFunctions.h"

namespace irradiance
{

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
    // The frame of DirectionAround.
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

}

#endif
