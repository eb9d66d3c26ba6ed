// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/LobeLoss.h"

#include "Geometry/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace irradiance::LobeLoss
{

namespace
{

constexpr int kRowsOfOctave = 4;
constexpr int kOctaves = 16; ///< a lobe that is narrower loses as much as the narrowest of these
constexpr int kRows = kRowsOfOctave * kOctaves + 1;

/// Of a row of the table, from 1 downwards.
double widthOf(int row)
{
  const int octave = row / kRowsOfOctave, step = row % kRowsOfOctave;
  return std::ldexp(1 - 0.5 * step / kRowsOfOctave, -octave);
}

const std::vector<double>& rowOf(int row)
{
  static std::array<std::once_flag, kRows> flags;
  static std::array<std::vector<double>, kRows> rows;
  const auto i = static_cast<std::size_t>(row);
  std::call_once(flags[i], [&] {
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      rows[i].push_back(std::round(integral(cosineOf(node), widthOf(row)) * 0x1p22) * 0x1p-22);
    }
  });
  return rows[i];
}

/// The mean over all phi of 1 - clamp((a + b cos(phi)) / c, 0, 1), b >= 0, c > 0.
double meanShortfall(double a, double b, double c)
{
  if (!(b > 0))
  {
    return 1 - std::clamp(a / c, 0.0, 1.0);
  }
  // The numerator is c or more up to the angle `full`, and positive up to the angle `zero`.
  const double full = std::acos(std::clamp((c - a) / b, -1.0, 1.0));
  const double zero = std::acos(std::clamp(-a / b, -1.0, 1.0));
  return 1 - (full + (a * (zero - full) + b * (std::sin(zero) - std::sin(full))) / c) / kPi;
}

}

double cosineOf(std::size_t node)
{
  const double u = static_cast<double>(node) / (kNodes - 1), t = u * u * u;
  return 2 * t / (1 + t * t);
}

std::vector<double> at(double width)
{
  int row = 0;
  while (row < kRows - 2 && widthOf(row + 1) > width)
  {
    ++row;
  }
  const int first = std::clamp(row - 1, 0, kRows - 4);
  const double x = std::max(width, widthOf(kRows - 1));
  std::vector<double> losses(kNodes);
  for (int i = first; i < first + 4; ++i) // Lagrange's polynomial through four rows
  {
    double weight = 1;
    for (int j = first; j < first + 4; ++j)
    {
      weight *= j == i ? 1 : (x - widthOf(j)) / (widthOf(i) - widthOf(j));
    }
    const std::vector<double>& known = rowOf(i);
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      losses[node] += weight * known[node];
    }
  }
  std::transform(losses.begin(), losses.end(), losses.begin(),
    [](double loss) { return std::clamp(loss, 0.0, 1.0); });
  return losses;
}

/// Directions of the lobe are chosen as PhongLobe::sample() does, cos(alpha) = u^(1 / (n + 1)), and
/// u = 1 - q^2 makes the integrand smooth where alpha is 0.
double integral(double cosine, double width)
{
  if (cosine <= 0)
  {
    return 0.5; // half of the lobe is below the horizon
  }
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  constexpr int kSteps = 600;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
  {
    const double q = (i + 0.5) / kSteps;
    const double logarithm = width * width * std::log1p(-q * q); // ln(u) / (n + 1)
    const double along = std::exp(logarithm), aside = std::sqrt(-std::expm1(2 * logarithm));
    sum += 2 * q * meanShortfall(along * cosine, aside * sine, cosine);
  }
  return sum / kSteps;
}

}
