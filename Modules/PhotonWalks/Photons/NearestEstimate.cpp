// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/NearestEstimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace irradiance
{

double countedArea(const NearestPhotons& photons, const Foot& foot, double radius)
{
  double area = 0;
  for (std::uint32_t i = 0; i < photons.objects().size(); ++i)
  {
    area += photons.areaWithin(i, foot, radius);
  }
  return area;
}

NearestEstimate nearestEstimate(
  const NearestPhotons& photons, const Foot& foot, std::uint32_t count, double maximumRadius)
{
  const NearPhotons near = photons.find(foot, count, maximumRadius);
  const std::size_t counted = near.photons.size() - (near.areAll ? 0 : 1);
  NearestEstimate estimate{ {}, kInfinity, near.radius,
    static_cast<std::uint32_t>(near.photons.size()) };
  for (std::size_t i = 0; i < counted; ++i)
  {
    estimate.power += photons.histories().power(near.photons[i]);
  }
  if (!estimate.power.isZero())
  {
    estimate.area = countedArea(photons, foot, near.radius);
  }
  return estimate;
}

namespace
{

double sizeOf(const Box& box)
{
  return box.isEmpty() ? 0.0 : box.extent().maxCoeff();
}

}

double usualRadius(const NearestPhotons& photons, std::uint32_t count)
{
  double area = 0;
  for (std::uint32_t i = 0; i < photons.objects().size(); ++i)
  {
    const std::vector<double> areas = cellAreas(photons.objects()[i]);
    area = std::accumulate(areas.begin(), areas.end(), area);
  }
  const auto all = static_cast<double>(photons.numberOfPhotons());
  return std::min(4 * std::sqrt(count * area / all / kPi), 0.25 * sizeOf(photons.bounds()));
}

/// Points of a ball stray from its triangles by a hundredth of its size if its circles have 16
/// sides, and it is smaller than the scene. A working plane in a hall of 100 m is farther away.
double usualDistance(const NearestPhotons& photons)
{
  return sizeOf(photons.bounds()) / 128;
}

}
