// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/SpreadWidth.h"

#include <algorithm>
#include <cmath>

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

}
