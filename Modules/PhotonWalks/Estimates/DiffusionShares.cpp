// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/DiffusionShares.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace irradiance
{

/// Sizes are in proportion to the square root of area, as large as their exact sum allows, if the
/// squares of all fields are to fit into an integer.
DiffusionShares::DiffusionShares(const std::vector<double>& areas, int sides)
{
  const auto nodes = static_cast<double>(areas.size()) * sides;
  const double most = std::min(0x1p28, 0x1p52 / nodes);
  const double largest = *std::max_element(areas.begin(), areas.end());
  for (const double area : areas)
  {
    sizes_.insert(sizes_.end(), static_cast<std::size_t>(sides),
      static_cast<std::int64_t>(most * std::sqrt(area / largest)));
  }
  squares_.resize(sizes_.size());
}

void DiffusionShares::fill(const CellDiffusion& diffusion, DiffusingFields& fields) const
{
  fields.quanta.resize(sizes_.size() * fields.width());
  for (std::uint32_t k = 0; k < fields.count; ++k)
  {
    std::mt19937_64 random(fields.first + k);
    for (std::size_t node = 0; node < sizes_.size(); ++node)
    {
      fields.quanta[diffusion.placeOf(node) * fields.width() + k] =
        static_cast<double>(random() % 2 == 0 ? sizes_[node] : -sizes_[node]);
    }
  }
}

void DiffusionShares::add(const CellDiffusion& diffusion, const DiffusingFields& fields)
{
  for (std::size_t node = 0; node < squares_.size(); ++node)
  {
    for (std::uint32_t k = 0; k < fields.count; ++k)
    {
      const auto quanta =
        static_cast<std::int64_t>(fields.quanta[diffusion.placeOf(node) * fields.width() + k]);
      squares_[node] += quanta * quanta;
    }
  }
}

std::vector<float> DiffusionShares::shares() const
{
  std::vector<float> shares;
  std::transform(sizes_.begin(), sizes_.end(), squares_.begin(), std::back_inserter(shares),
    [](std::int64_t size, std::int64_t sum) {
      const auto variance = static_cast<double>(size * size) * kFields;
      return size > 0 ? static_cast<float>(std::min(1.0, static_cast<double>(sum) / variance))
                      : 1.0F;
    });
  return shares;
}

}
