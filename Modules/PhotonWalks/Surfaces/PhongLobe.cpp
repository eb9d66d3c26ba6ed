// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/PhongLobe.h"

#include "Sampling/DirectionSampling.h"
#include "Sampling/ElementaryFunctions.h"
#include "Surfaces/LobeLoss.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

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

std::size_t PhongLobe::nodeBelow(double square) const
{
  const auto above = std::upper_bound(squares_.begin() + 1, squares_.end() - 1, square);
  return static_cast<std::size_t>(above - squares_.begin()) - 1;
}

double PhongLobe::loss(double cosine) const
{
  const double square = cosine * cosine;
  const std::size_t node = nodeBelow(square);
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
  const auto above = std::upper_bound(sums_.begin() + 1, sums_.end() - 1, sum);
  const auto node = static_cast<std::size_t>(above - sums_.begin()) - 1;
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
