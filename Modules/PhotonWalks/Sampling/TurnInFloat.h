// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TurnInFloat_h
#define irradiance_TurnInFloat_h

#include <cstdint>

namespace irradiance
{

/**
 * Sine and cosine, in float, of an angle given in units of 2^-32 turns. Our own, as SinCos is, and
 * with twice as many lanes. Without branches; each product and sum is rounded, so all instruction
 * sets give the same bits.
 */
struct TurnInFloat
{
  float sine, cosine;

  /// Both are within 2^-22.5 of the truth.
  __attribute__((always_inline)) explicit TurnInFloat(std::uint32_t turn)
  {
    // The nearest quarter turn, and the angle from there, at most an eighth of a turn: exact in
    // integers.
    const std::uint32_t quarter = (turn + 0x20000000u) >> 30;
    const auto rest = static_cast<std::int32_t>(turn - (quarter << 30));
    const float x = static_cast<float>(rest) * static_cast<float>(6.283185307179586 * 0x1p-32);
    const float z = x * x;
    // Taylor's series: what is left out is below (pi / 4)^11 / 11! = 1.8e-9.
    const float s =
      x + x * z * (-1 / 6.0F + z * (1 / 120.0F + z * (-1 / 5040.0F + z * (1 / 362880.0F))));
    const float c = 1 -
      z *
        (1 / 2.0F - z * (1 / 24.0F - z * (1 / 720.0F - z * (1 / 40320.0F - z * (1 / 3628800.0F)))));
    const bool isSwapped = (quarter & 1) != 0;
    const float along = isSwapped ? s : c, aside = isSwapped ? c : s;
    sine = (quarter & 2) != 0 ? -aside : aside;
    cosine = ((quarter + 1) & 2) != 0 ? -along : along;
  }
};

}

#endif
