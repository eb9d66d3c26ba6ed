// SPDX-License-Identifier: BSD-3-Clause
#include "Gathering/LampChoice.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// W that a lamp would bring to a cell.
double powerBetween(const LampPiece& lamp, const CellShape& cell)
{
  const Vector3 between = cell.center - lamp.center;
  const double leaving = lamp.normal.dot(between), arriving = cell.normal.dot(between);
  const double cosine = lamp.normal.dot(cell.normal), radius = cell.radius;
  if (leaving < 0 && leaving * leaving >= radius * radius * (1 - cosine * cosine))
  {
    return 0; // it is behind the lamp, as ceilings are behind their panels
  }
  const double size = std::max(lamp.radius, radius);
  const double squared = std::max(between.squaredNorm(), size * size);
  if (!(squared > 0))
  {
    return lamp.flux;
  }
  const double inverse = 1 / std::sqrt(squared);
  // A part of either may face the other though its center does not.
  const double slack = std::min(1.0, (lamp.radius + radius) * inverse);
  const bool isInAir = lamp.normal.isZero(0);
  const double emitted = isInAir ? 0.25 : std::clamp(leaving * inverse + slack, 0.0, 1.0);
  const double curved = 1 - std::min(1.0, cell.normal.norm()); // normals in all directions
  const double received = std::min(1.0, std::abs(arriving) * inverse + curved + slack);
  return std::min(lamp.flux, lamp.flux * emitted * received * cell.area / kPi * inverse * inverse);
}

}

LampChoice::LampChoice(const LampPieces& lamps)
  : lamps_(lamps)
  , weights_(lamps.size())
  , cumulative_(lamps.size())
{
  for (std::size_t i = 0; i < lamps.size(); ++i)
  {
    centers_.add(lamps[i].center);
  }
}

double LampChoice::expectedPower(const CellShape& cell)
{
  double expected = 0;
  for (std::size_t i = 0; i < lamps_.size(); ++i)
  {
    weights_[i] = powerBetween(lamps_[i], cell);
    expected += weights_[i];
  }
  return expected;
}

double LampChoice::mostPower(const CellShape& cell) const
{
  const Vector3 nearest = cell.center.cwiseMax(centers_.lower).cwiseMin(centers_.upper);
  return lamps_.lights().flux() * cell.area / (kPi * (cell.center - nearest).squaredNorm());
}

void LampChoice::weigh(const CellShape& cell)
{
  const double expected = expectedPower(cell);
  const double byPower = expected > 0 ? (1 - kByFlux) / expected : 0;
  const double byFlux = (expected > 0 ? kByFlux : 1) / lamps_.lights().flux();
  double sum = 0;
  for (std::size_t i = 0; i < lamps_.size(); ++i)
  {
    sum += byPower * weights_[i] + byFlux * lamps_[i].flux;
    cumulative_[i] = sum;
  }
}

LampChoice::Choice LampChoice::choose(double sample) const
{
  const double sum = cumulative_.back(), place = sample * sum;
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, place);
  const double before = found == cumulative_.begin() ? 0 : *(found - 1);
  const double own = *found - before;
  return { static_cast<std::uint32_t>(found - cumulative_.begin()), own / sum,
    std::clamp((place - before) / own, 0.0, 1 - 0x1p-53) };
}

}
