// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/AxisPlanes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irradiance
{

namespace
{

bool isFlat(const Triangle& triangle, int axis)
{
  return triangle.a[axis] == triangle.b[axis] && triangle.a[axis] == triangle.c[axis];
}

}

AxisPlanes::AxisPlanes(const std::vector<Triangle>& triangles, const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double>& places = places_[static_cast<std::size_t>(axis)];
    for (const Triangle& triangle : triangles)
    {
      pace.step();
      if (isFlat(triangle, axis) && (places.empty() || places.back() != triangle.a[axis]))
      {
        places.push_back(triangle.a[axis]);
      }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    if (places.empty())
    {
      continue;
    }
    const auto first = static_cast<std::uint32_t>(planes_.size());
    for (const double place : places)
    {
      planes_.push_back({ axis, place });
    }
    planeOf_.resize(triangles.size(), kNone);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      pace.step();
      if (isFlat(triangles[i], axis))
      {
        const auto plane = std::lower_bound(places.begin(), places.end(), triangles[i].a[axis]);
        planeOf_[i] = first + static_cast<std::uint32_t>(plane - places.begin());
      }
    }
  }
}

void AxisPlanes::renumber(const std::vector<std::uint32_t>& numbers)
{
  std::vector<std::uint32_t> planeOf(planeOf_.empty() ? 0 : numbers.back() + 1, kNone);
  for (std::size_t i = 0; i < planeOf_.size(); ++i)
  {
    planeOf[numbers[i]] = planeOf_[i];
  }
  planeOf_ = std::move(planeOf);
}

bool AxisPlanes::hide(int axis, int side, float bound, const Box& whole) const
{
  const std::vector<double>& places = places_[static_cast<std::size_t>(axis)];
  // Of the planes between this float and its neighbour, the one farthest inside the triangle.
  const double least = side > 0 ? std::nextafter(bound, -HUGE_VALF) : bound;
  const double most = side > 0 ? bound : std::nextafter(bound, HUGE_VALF);
  const auto first = std::upper_bound(places.begin(), places.end(), least);
  const auto end = std::lower_bound(first, places.end(), most);
  if (first == end)
  {
    return false;
  }
  const double reach = side > 0 ? whole.upper[axis] - *first : end[-1] - whole.lower[axis];
  const double reachBeyondBound = side > 0 ? whole.upper[axis] - bound : bound - whole.lower[axis];
  const Vector3 extent = whole.extent();
  const double width = std::max(extent[(axis + 1) % 3], extent[(axis + 2) % 3]);
  return reach > 0 && reachBeyondBound < 0.5 * width;
}

}
