// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/PhongLobe.h"

#include "Sampling/DirectionSampling.h"
#include "Sampling/ElementaryFunctions.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace irradiance
{

namespace LobeLoss
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

namespace
{

/// The last value that is not above `value`, the last of all left out; `values` rise.
std::size_t nodeBelow(const std::vector<double>& values, double value)
{
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value);
  return static_cast<std::size_t>(above - values.begin()) - 1;
}

}

PhongLobe::PhongLobe(double exponent)
  : exponent_(exponent)
{
  if (std::isinf(exponent))
  {
    return;
  }
  const double width = 1 / std::sqrt(exponent + 1);
  losses_ = LobeLoss::at(width);
  for (std::size_t node = 0; node < losses_.size(); ++node)
  {
    const double cosine = LobeLoss::cosineOf(node);
    squares_.push_back(cosine * cosine);
    sums_.push_back(node == 0 ? 0
                              : sums_.back() +
          0.5 * (losses_[node] + losses_[node - 1]) * (squares_[node] - squares_[node - 1]));
  }
}

double PhongLobe::loss(double cosine) const
{
  const double square = cosine * cosine;
  const std::size_t node = nodeBelow(squares_, square);
  const double part = (square - squares_[node]) / (squares_[node + 1] - squares_[node]);
  return losses_[node] + part * (losses_[node + 1] - losses_[node]);
}

double PhongLobe::value(const Vector3& normal, const Vector3& toLight, const Vector3& toEye) const
{
  const double in = std::min(toLight.dot(normal), 1.0), out = std::min(toEye.dot(normal), 1.0);
  if (!(in > 0 && out > 0))
  {
    return 0;
  }
  const double cosine = std::min(mirrored(normal, -toLight).dot(toEye), 1.0);
  const double lobe = cosine > 0 ? (exponent_ + 1) / 2 * powUnit(cosine, exponent_) : 0;
  return (lobe / std::max(in, out) + loss(in) * loss(out) / sums_.back()) / kPi;
}

/// A direction of the lobe is kept with the probability by which the BRDF times the cosine is below
/// the lobe's density. So the part that is not kept is just what the lobe loses.
Vector3 PhongLobe::sample(
  const Vector3& normal, const Vector3& incoming, const LobeSample& sample) const
{
  if (isMirror())
  {
    return mirrored(normal, incoming);
  }
  const double along = powUnit(sample.lobe[0], 1 / (exponent_ + 1));
  const double aside = std::sqrt(std::max(0.0, 1 - along * along));
  const Vector3 direction =
    directionAround(mirrored(normal, incoming), along, aside, sample.lobe[1]);
  const double in = -incoming.dot(normal), out = direction.dot(normal);
  return out > sample.acceptance * std::max(in, out) ? direction
                                                     : compensate(normal, sample.compensation);
}

/// A direction with a density in proportion to loss times cosine: the square of its cosine has one
/// in proportion to the loss, which is linear between nodes.
Vector3 PhongLobe::compensate(const Vector3& normal, const std::array<double, 2>& sample) const
{
  const double sum = sample[0] * sums_.back();
  const std::size_t node = nodeBelow(sums_, sum);
  const double size = squares_[node + 1] - squares_[node];
  const double loss = losses_[node], slope = (losses_[node + 1] - loss) / size;
  const double rest = sum - sums_[node];
  // rest = loss x + slope x^2 / 2, solved for x without cancellation.
  const double root = std::sqrt(std::max(0.0, loss * loss + 2 * slope * rest));
  const double x = loss + root > 0 ? std::min(2 * rest / (loss + root), size) : 0;
  const double square = std::min(squares_[node] + x, 1.0);
  return directionAround(normal, std::sqrt(square), std::sqrt(1 - square), sample[1]);
}

}
