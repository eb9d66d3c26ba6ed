// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/CellDiffusion.h"
#include "Execution/Execution.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <random>
#include <utility>
#include <vector>

namespace irradiance
{

/// The width of a CellDiffusion after which small cells draw on `photons` photons, on average, of
/// `received` that arrived on `area`; in the unit of the area. 0 if none arrived. It comes in steps
/// of an eighth, so that a diffusion serves as long as about as many arrive.
inline double spreadWidth(double photons, double area, double received)
{
  constexpr int kBits = 4; // three behind the leading one
  if (!(received > 0))
  {
    return 0;
  }
  int exponent;
  const double mantissa = std::frexp(photons * area / received, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, kBits)), exponent - kBits);
}

/// How power flows over a surface; nothing flows if no cell is smaller than `width`. `areas`: of
/// its cells.
inline CellDiffusion surfaceDiffusion(const std::vector<double>& areas,
  const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& cellOfTriangle,
  int sides, double width, const CancelPoint& cancelPoint = {})
{
  if (std::none_of(areas.begin(), areas.end(), [&](double area) { return area < width; }))
  {
    return {};
  }
  // On a cylinder of radius r a photon fills a shape sqrt(1 + 30 width / r^2) times as long as
  // wide. Of 10 to 100, no factor is better than the others by much.
  const double normalLength = std::sqrt(30 * width);
  return { areas,
    cellNeighbours(triangles, cellOfTriangle, areas.size(), normalLength, cancelPoint), sides,
    width };
}

/// Some fields on their way through a diffusion, side by side.
struct DiffusingFields
{
  const CellDiffusion* diffusion;
  std::size_t object;                 ///< whose they are
  std::uint32_t first;                ///< number of the first
  unsigned count;                     ///< that are used
  std::vector<double> quanta, before; ///< see CellDiffusion::step
  int stepsDone = 0;

  unsigned width() const { return count == 1 ? 1 : CellDiffusion::kFields; }
  /// Where the quanta of a node stand, field by field.
  std::size_t placeOf(std::size_t node) const { return diffusion->placeOf(node) * width(); }

  /// Gives each node a random sign.
  void setSigns(const std::vector<std::int64_t>& sizes)
  {
    quanta.resize(sizes.size() * width());
    for (std::uint32_t k = 0; k < count; ++k)
    {
      std::mt19937_64 random(first + k);
      for (std::size_t node = 0; node < sizes.size(); ++node)
      {
        quanta[placeOf(node) + k] =
          static_cast<double>(random() % 2 == 0 ? sizes[node] : -sizes[node]);
      }
    }
  }
  void addSquaresTo(std::vector<std::int64_t>& squares) const
  {
    for (std::size_t node = 0; node < squares.size(); ++node)
    {
      for (std::uint32_t k = 0; k < count; ++k)
      {
        const auto number = static_cast<std::int64_t>(quanta[placeOf(node) + k]);
        squares[node] += number * number;
      }
    }
  }
};

/// Appends the fields 0 to `count` of an object.
inline void addFields(const CellDiffusion& diffusion, std::size_t object, std::size_t count,
  std::vector<DiffusingFields>& all)
{
  for (std::uint32_t first = 0; first < count; first += CellDiffusion::kFields)
  {
    const auto left = static_cast<unsigned>(count - first);
    all.push_back({ &diffusion, object, first, std::min(left, CellDiffusion::kFields), {}, {} });
  }
}

/// Takes fields through all steps. `begin` fills some that are empty, `end` reads them; many
/// threads call these.
inline void diffuse(std::vector<DiffusingFields>& all,
  const std::function<void(DiffusingFields&)>& begin,
  const std::function<void(const DiffusingFields&)>& end, Execution& execution)
{
  runSliced(all.size(), execution, [&](std::size_t i, const auto& hasToStop) {
    DiffusingFields& fields = all[i];
    if (fields.quanta.empty())
    {
      begin(fields);
    }
    while (fields.stepsDone < fields.diffusion->steps())
    {
      fields.diffusion->step(fields.stepsDone, fields.width(), fields.quanta, fields.before);
      ++fields.stepsDone;
      if (hasToStop())
      {
        return false;
      }
    }
    end(fields);
    fields.quanta = fields.before = {};
    return true;
  });
}

/// The standard deviation of each node, in quanta: in proportion to the square root of area, as
/// large as their exact sum allows, if the squares of all fields are to fit into an integer.
inline std::vector<std::int64_t> signSizes(const std::vector<double>& areas, int sides)
{
  const auto nodes = static_cast<double>(areas.size()) * sides;
  const double most = std::min(0x1p28, 0x1p52 / nodes);
  const double largest = *std::max_element(areas.begin(), areas.end());
  std::vector<std::int64_t> sizes;
  for (const double area : areas)
  {
    sizes.insert(sizes.end(), static_cast<std::size_t>(sides),
      static_cast<std::int64_t>(most * std::sqrt(area / largest)));
  }
  return sizes;
}

/**
 * Measures the effective part of a photon in what a cell holds after a diffusion. Of independent
 * sums S_k with the variances A_k, cell i receives the sum of W_ik S_k. The variance of that, in
 * units of A_i, is the photon's share. It is measured with some fields of random signs, which are
 * the same each time.
 *
 * Of some surfaces, by the areas of their cells: of all nodes, 0..1, known to within a third or so.
 */
inline std::vector<std::vector<float>> photonShares(
  const std::vector<std::pair<const std::vector<double>*, const CellDiffusion*>>& surfaces,
  int sides, Execution& execution)
{
  constexpr std::size_t kFields = 16;
  std::vector<std::vector<std::int64_t>> sizes, squares;
  std::vector<DiffusingFields> all;
  for (const auto& [areas, diffusion] : surfaces)
  {
    addFields(*diffusion, sizes.size(), kFields, all);
    sizes.push_back(signSizes(*areas, sides));
    squares.emplace_back(sizes.back().size());
  }
  std::mutex mutex;
  diffuse(
    all, [&](DiffusingFields& fields) { fields.setSigns(sizes[fields.object]); },
    [&](const DiffusingFields& fields) {
      const std::lock_guard<std::mutex> lock(mutex);
      fields.addSquaresTo(squares[fields.object]);
    },
    execution);
  std::vector<std::vector<float>> shares(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i)
  {
    std::transform(sizes[i].begin(), sizes[i].end(), squares[i].begin(),
      std::back_inserter(shares[i]), [](std::int64_t size, std::int64_t sum) {
        const auto variance = static_cast<double>(size * size) * kFields;
        return size > 0 ? static_cast<float>(std::min(1.0, static_cast<double>(sum) / variance))
                        : 1.0F;
      });
  }
  return shares;
}

}
