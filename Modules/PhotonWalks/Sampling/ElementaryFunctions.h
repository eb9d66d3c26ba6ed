// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// Functions of our own, as the libraries of different systems differ in the last bits, and bits of
// directions decide which way walks go. Each product and sum is rounded, so all instruction sets
// give the same bits.

namespace irradiance
{

/// The value whose bits are these.
template <class To, class From>
To bitCast(const From& from)
{
  static_assert(sizeof(To) == sizeof(From), "all bits are taken");
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

/// first + x (second + x (third + ...)).
template <class Real, class... More>
__attribute__((always_inline)) inline Real polynomial(Real x, Real first, More... more)
{
  if constexpr (sizeof...(more) > 0)
  {
    return first + x * polynomial(x, more...);
  }
  return first;
}

/// Sine and cosine of an angle given in turns. Without branches, so that a loop over many becomes
/// SIMD.
struct SinCos
{
  double sine, cosine;

  /// 0 <= `turns` <= 1. Both results are within 2^-51.
  __attribute__((always_inline)) explicit SinCos(double turns)
  {
    // The nearest quarter turn, and the angle from there, exact in turns: at most an eighth of one.
    const double halfMore = 4 * turns + 0.5;
    const int quarter = static_cast<int>(halfMore);
    const double x = (turns - 0.25 * quarter) * 6.283185307179586;
    const double z = x * x;
    // Taylor's series: what is left out is below (pi / 4)^17 / 17!.
    const double s = x +
      x * z *
        polynomial(z, -1 / 6.0, 1 / 120.0, -1 / 5040.0, 1 / 362880.0, -1 / 39916800.0,
          1 / 6227020800.0, -1 / 1307674368000.0);
    const double c = polynomial(z, 1.0, -1 / 2.0, 1 / 24.0, -1 / 720.0, 1 / 40320.0, -1 / 3628800.0,
      1 / 479001600.0, -1 / 87178291200.0, 1 / 20922789888000.0);
    const double swapped = quarter & 1; // 0 or 1: one of the two products is exact, the other 0
    const double signOfSine = 1 - (quarter & 2), signOfCosine = 1 - (quarter + 1 & 2);
    sine = signOfSine * ((1 - swapped) * s + swapped * c);
    cosine = signOfCosine * ((1 - swapped) * c + swapped * s);
  }
};

/// Likewise, in float and so with twice as many lanes, of an angle given in units of 2^-32 turns.
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
    const float s = x + x * z * polynomial(z, -1 / 6.0F, 1 / 120.0F, -1 / 5040.0F, 1 / 362880.0F);
    const float c =
      polynomial(z, 1.0F, -1 / 2.0F, 1 / 24.0F, -1 / 720.0F, 1 / 40320.0F, -1 / 3628800.0F);
    const bool isSwapped = (quarter & 1) != 0;
    const float along = isSwapped ? s : c, aside = isSwapped ? c : s;
    sine = (quarter & 2) != 0 ? -aside : aside;
    cosine = ((quarter + 1) & 2) != 0 ? -along : along;
  }
};

/**
 * The angle in [0, pi], in radians, between (x, y), y >= 0, and the x axis; 0 of (0, 0). Without
 * branches. The error is below 2^-51 of the angle.
 *
 * The addition theorem takes the angle of the nearest of 0, 1/8 and 1/4 half turns off, which
 * leaves tangents of at most tan(pi / 16); Gregory's series does the rest.
 */
inline double arcTangent(double y, double x)
{
  constexpr double kTan16th = 0.198912367379658, kTan3_16ths = 0.6681786379192989;
  constexpr double kTan8th = 0.41421356237309503; // a double: the angle is the one of its bits
  constexpr double kEighth = 0.39269908169872414, kQuarter = 0.7853981633974483;
  constexpr double kHalf = 1.5707963267948966, kWhole = 3.141592653589793;
  const double across = std::abs(x);
  const double less = std::min(y, across), more = std::max(y, across);
  const bool isOverFirst = less > kTan16th * more, isOverSecond = less > kTan3_16ths * more;
  const double tangent = isOverSecond ? 1 : isOverFirst ? kTan8th : 0;
  const double base = isOverSecond ? kQuarter : isOverFirst ? kEighth : 0;
  const double below = more + tangent * less;
  const double z = below > 0 ? (less - tangent * more) / below : 0;
  // What is left out of the series is below tan(pi / 16)^22 / 23 = 2^-56 of it.
  const double zz = z * z, z4 = zz * zz;
  // Sums of even and of odd powers, as half as long chains take half as long.
  const double odd = polynomial(z4, 1 / 3.0, 1 / 7.0, 1 / 11.0, 1 / 15.0, 1 / 19.0);
  const double even = polynomial(z4, 1 / 5.0, 1 / 9.0, 1 / 13.0, 1 / 17.0, 1 / 21.0);
  const double angle = base + (z - z * zz * (odd - zz * even));
  const double fromX = y > across ? kHalf - angle : angle;
  return x < 0 ? kWhole - fromX : fromX;
}

/// Together the natural logarithm of 2.
constexpr double kLn2 = 0.6931471805599453, kLn2Rest = 2.3190468138462996e-17;

/// The natural logarithm of a number in (0, 1].
inline double unitLogarithm(double base)
{
  // base = mantissa * 2^binade, mantissa in [0.75, 1.5), by its bits.
  constexpr std::uint64_t kThreeQuarters = 0x3fe8000000000000u, kMantissa = 0xfffffffffffffu;
  const std::uint64_t above = bitCast<std::uint64_t>(base) - kThreeQuarters + 0x4000000000000000u;
  const std::int64_t binade = static_cast<std::int64_t>(above >> 52) - 0x400;
  const auto mantissa = bitCast<double>((above & kMantissa) + kThreeQuarters);
  // ln(mantissa) = 2 artanh(z), |z| <= 1 / 5: what is left out of the series is below 2^-56 of it.
  const double z = (mantissa - 1) / (mantissa + 1), zz = z * z;
  // Sums of even and of odd powers, as half as long chains take half as long.
  const double z4 = zz * zz;
  const double odd = polynomial(z4, 1 / 3.0, 1 / 7.0, 1 / 11.0, 1 / 15.0, 1 / 19.0, 1 / 23.0);
  const double even = polynomial(z4, 1 / 5.0, 1 / 9.0, 1 / 13.0, 1 / 17.0, 1 / 21.0);
  const double series = zz * (odd + zz * even);
  return static_cast<double>(binade) * kLn2 +
    (2 * z + (2 * z * series + static_cast<double>(binade) * kLn2Rest));
}

/// e^power for -690 < power <= 0.
inline double unitExponential(double power)
{
  // e^power = 2^halvings e^rest, |rest| <= ln(2) / 2.
  const auto halvings = static_cast<std::int64_t>(power / kLn2 - 0.5);
  const double rest =
    (power - static_cast<double>(halvings) * kLn2) - static_cast<double>(halvings) * kLn2Rest;
  const double rr = rest * rest;
  const double even = polynomial(rr, 1.0, 1 / 2.0, 1 / 24.0, 1 / 720.0, 1 / 40320.0, 1 / 3628800.0,
    1 / 479001600.0, 1 / 87178291200.0);
  const double odd = polynomial(
    rr, 1.0, 1 / 6.0, 1 / 120.0, 1 / 5040.0, 1 / 362880.0, 1 / 39916800.0, 1 / 6227020800.0);
  const auto scale = bitCast<double>(static_cast<std::uint64_t>(halvings + 1023) << 52);
  return (even + rest * odd) * scale;
}

/// base^exponent for 0 < base <= 1 and a finite exponent >= 0. The error is below 2^-50 (1 + |ln
/// result|), relative; results below 2^-1000 are 0.
inline double powUnit(double base, double exponent)
{
  const double power = exponent * unitLogarithm(base);
  return power > -690 ? unitExponential(power) : 0;
}

}
