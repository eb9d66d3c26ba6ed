// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_UnitPower_h
#define irradiance_UnitPower_h

#include <cstdint>
#include <cstring>

namespace irradiance
{

/**
 * base^exponent for 0 < base <= 1 and a finite exponent >= 0. Our own, like Turn: the libraries of
 * different systems differ in the last bits, and bits of directions decide which way walks go.
 * The error is below 2^-50 (1 + |ln result|), relative; results below 2^-1000 are 0.
 */
inline double unitPower(double base, double exponent)
{
  constexpr double kLn2 = 0.6931471805599453, kLn2Rest = 2.3190468138462996e-17;
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
  double series = 0;
  for (int i = 23; i >= 3; i -= 2)
  {
    series = zz * (1.0 / i + series);
  }
  const double logarithm = static_cast<double>(binade) * kLn2 +
    (2 * z + (2 * z * series + static_cast<double>(binade) * kLn2Rest));
  const double power = exponent * logarithm;
  if (!(power > -690))
  {
    return 0;
  }
  // e^power = 2^halvings e^rest, |rest| <= ln(2) / 2.
  const auto halvings = static_cast<std::int64_t>(power / kLn2 - 0.5);
  const double rest =
    (power - static_cast<double>(halvings) * kLn2) - static_cast<double>(halvings) * kLn2Rest;
  double exponential = 1;
  for (int i = 14; i >= 1; --i)
  {
    exponential = 1 + exponential * rest / i;
  }
  const std::uint64_t scaleBits = static_cast<std::uint64_t>(halvings + 1023) << 52;
  double scale = 0;
  std::memcpy(&scale, &scaleBits, sizeof(scale));
  return exponential * scale;
}

}

#endif
