// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SurfaceDiffusion.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <random>

namespace irradiance
{

namespace
{

/// To three bits behind the leading one, downwards.
double rounded(double x)
{
  constexpr int kBits = 4;
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(std::ldexp(mantissa, kBits)), exponent - kBits);
}

/// The standard deviation of each node, in quanta: in proportion to the square root of area, as
/// large as their exact sum allows, if the squares of all fields are to fit into an integer.
std::vector<std::int64_t> signSizes(const std::vector<double>& areas, int sides)
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

/// Gives each node a random sign in some of the fields.
void fillWithSigns(const std::vector<std::int64_t>& sizes, DiffusingFields& fields)
{
  fields.quanta.resize(sizes.size() * fields.width());
  for (std::uint32_t k = 0; k < fields.count; ++k)
  {
    std::mt19937_64 random(fields.first + k);
    for (std::size_t node = 0; node < sizes.size(); ++node)
    {
      fields.quanta[fields.placeOf(node) + k] =
        static_cast<double>(random() % 2 == 0 ? sizes[node] : -sizes[node]);
    }
  }
}

void addSquares(const DiffusingFields& fields, std::vector<std::int64_t>& squares)
{
  for (std::size_t node = 0; node < squares.size(); ++node)
  {
    for (std::uint32_t k = 0; k < fields.count; ++k)
    {
      const auto quanta = static_cast<std::int64_t>(fields.quanta[fields.placeOf(node) + k]);
      squares[node] += quanta * quanta;
    }
  }
}

}

double spreadWidth(double photons, double area, double received)
{
  return received > 0 ? rounded(photons * area / received) : 0.0;
}

CellDiffusion surfaceDiffusion(const std::vector<double>& areas,
  const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& cellOfTriangle,
  int sides, double width, const CancelPoint& cancelPoint)
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

void addFields(const CellDiffusion& diffusion, std::size_t object, std::size_t count,
  std::vector<DiffusingFields>& all)
{
  for (std::uint32_t first = 0; first < count; first += CellDiffusion::kFields)
  {
    const auto left = static_cast<unsigned>(count - first);
    all.push_back({ &diffusion, object, first, std::min(left, CellDiffusion::kFields), {}, {} });
  }
}

void diffuse(std::vector<DiffusingFields>& all, const std::function<void(DiffusingFields&)>& begin,
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

std::vector<std::vector<float>> photonShares(
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
    all, [&](DiffusingFields& fields) { fillWithSigns(sizes[fields.object], fields); },
    [&](const DiffusingFields& fields) {
      const std::lock_guard<std::mutex> lock(mutex);
      addSquares(fields, squares[fields.object]);
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
