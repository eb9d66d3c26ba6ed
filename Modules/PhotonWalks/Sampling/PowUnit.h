// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PowUnit_h
#define irradiance_PowUnit_h

#include <cstdint>
#include <cstring>

namespace irradiance
{

/// Together the natural logarithm of 2.
constexpr double kLn2 = 0.6931471805599453, kLn2Rest = 2.3190468138462996e-17;

/// The natural logarithm of a number in (0, 1].
inline double unitLogarithm(double base)
{
  // base = mantissa * 2^binade, mantissa in [0.75, 1.5), by its bits.
  std::uint64_t bits = 0;
  std::memcpy(&bits, &base, sizeof(bits));
  constexpr std::uint64_t kThreeQuarters = 0x3fe8000000000000u, kMantissa = 0xfffffffffffffu;
  const std::uint64_t above = bits - kThreeQuarters + 0x4000000000000000u;
  const std::int64_t binade = static_cast<std::int64_t>(above >> 52) - 0x400;
  const std::uint64_t mantissaBits = (above & kMantissa) + kThreeQuarters;
  double mantissa = 0;
  std::memcpy(&mantissa, &mantissaBits, sizeof(mantissa));
  // ln(mantissa) = 2 artanh(z), |z| <= 1 / 5: what is left out of the series is below 2^-56 of it.
  const double z = (mantissa - 1) / (mantissa + 1), zz = z * z;
  // Sums of even and of odd powers, as half as long chains take half as long.
  const double z4 = zz * zz;
  const double series = zz *
    ((1 / 3.0 +
       z4 * (1 / 7.0 + z4 * (1 / 11.0 + z4 * (1 / 15.0 + z4 * (1 / 19.0 + z4 * (1 / 23.0)))))) +
      zz * (1 / 5.0 + z4 * (1 / 9.0 + z4 * (1 / 13.0 + z4 * (1 / 17.0 + z4 * (1 / 21.0))))));
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
  const double even = 1 +
    rr *
      (1 / 2.0 +
        rr *
          (1 / 24.0 +
            rr *
              (1 / 720.0 +
                rr *
                  (1 / 40320.0 +
                    rr * (1 / 3628800.0 + rr * (1 / 479001600.0 + rr * (1 / 87178291200.0)))))));
  const double odd = 1 +
    rr *
      (1 / 6.0 +
        rr *
          (1 / 120.0 +
            rr *
              (1 / 5040.0 +
                rr * (1 / 362880.0 + rr * (1 / 39916800.0 + rr * (1 / 6227020800.0))))));
  const double exponential = even + rest * odd;
  const std::uint64_t scaleBits = static_cast<std::uint64_t>(halvings + 1023) << 52;
  double scale = 0;
  std::memcpy(&scale, &scaleBits, sizeof(scale));
  return exponential * scale;
}

/**
 * base^exponent for 0 < base <= 1 and a finite exponent >= 0. Our own, like SinCos: the libraries
 * of different systems differ in the last bits, and bits of directions decide which way walks go.
 * The error is below 2^-50 (1 + |ln result|), relative; results below 2^-1000 are 0.
 */
inline double powUnit(double base, double exponent)
{
  const double power = exponent * unitLogarithm(base);
  return power > -690 ? unitExponential(power) : 0;
}

}

#endif
