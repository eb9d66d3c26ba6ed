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
  const double sizes = std::max(lamp.radius, cell.radius);
  const double squared = std::max(between.squaredNorm(), sizes * sizes);
  if (!(squared > 0))
  {
    return lamp.flux;
  }
  const double distance = std::sqrt(squared);
  const Vector3 direction = between / distance;
  // A part of either may face the other though its center does not.
  const double slack = std::min(1.0, (lamp.radius + cell.radius) / distance);
  const bool isInAir = lamp.normal.isZero(0);
  const double leaving = isInAir ? 0.25 : std::clamp(lamp.normal.dot(direction) + slack, 0.0, 1.0);
  const double curved = 1 - std::min(1.0, cell.normal.norm()); // normals in all directions
  const double arriving = std::min(1.0, std::abs(cell.normal.dot(direction)) + curved + slack);
  return std::min(lamp.flux, lamp.flux * leaving * arriving * cell.area / (kPi * squared));
}

}

LampChoice::LampChoice(const LampPieces& lamps)
  : lamps_(lamps)
  , weights_(lamps.size())
  , cumulative_(lamps.size())
{
}

void LampChoice::weigh(const CellShape& cell)
{
  expected_ = 0;
  for (std::size_t i = 0; i < lamps_.size(); ++i)
  {
    weights_[i] = powerBetween(lamps_[i], cell);
    expected_ += weights_[i];
  }
  const double byPower = expected_ > 0 ? (1 - kByFlux) / expected_ : 0;
  const double byFlux = (expected_ > 0 ? kByFlux : 1) / lamps_.lights().flux();
  double sum = 0;
  for (std::size_t i = 0; i < lamps_.size(); ++i)
  {
    sum += byPower * weights_[i] + byFlux * lamps_[i].flux;
    cumulative_[i] = sum;
  }
  for (double& part : cumulative_) // ends at 1 to the bit
  {
    part /= sum;
  }
}

LampChoice::Choice LampChoice::choose(double sample) const
{
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, sample);
  const double before = found == cumulative_.begin() ? 0 : *(found - 1);
  const double probability = *found - before;
  return { static_cast<std::uint32_t>(found - cumulative_.begin()), probability,
    std::clamp((sample - before) / probability, 0.0, 1 - 0x1p-53) };
}

}
