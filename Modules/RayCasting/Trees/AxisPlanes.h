// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Progress/CancelPoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace irradiance
{

/// A plane across an axis.
struct AxisPlane
{
  int axis;
  double place;
};

/**
 * The planes across the axes in which triangles of a tree lie: walls, floors, faces of boxes. A ray
 * that leaves such a triangle hits nothing in its plane or behind it. So its search skips all boxes
 * that do not reach beyond the plane, first of all the wall that it leaves.
 * Documentation/Theory.md, section 3, shows that it misses nothing.
 */
class AxisPlanes
{
public:
  AxisPlanes() = default;
  explicit AxisPlanes(const std::vector<Triangle>& triangles, const CancelPoint& cancelPoint = {})
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

  /// See TriangleTree::renumber().
  void renumber(const std::vector<std::uint32_t>& numbers)
  {
    std::vector<std::uint32_t> planeOf(planeOf_.empty() ? 0 : numbers.back() + 1, kNone);
    for (std::size_t i = 0; i < planeOf_.size(); ++i)
    {
      planeOf[numbers[i]] = planeOf_[i];
    }
    planeOf_ = std::move(planeOf);
  }

  bool isEmpty() const { return planes_.empty(); }
  /// The plane of a triangle; null if it lies in none.
  const AxisPlane* of(std::uint32_t triangle) const
  {
    return triangle < planeOf_.size() && planeOf_[triangle] != kNone
      ? planes_.data() + planeOf_[triangle]
      : nullptr;
  }
  /// Whether a search that skips the box of a triangle's part for lying behind a plane might miss
  /// the triangle. `bound` is the upper (`side` 1) or lower (-1) bound of the box on the axis,
  /// rounded outwards, and `whole` the exact box of the triangle. This is so if the plane, rounded,
  /// looks like the bound, and the triangle reaches beyond the plane, but less than half as far as
  /// it is wide. What reaches farther is found in a box beyond the plane as well.
  bool hide(int axis, int side, float bound, const Box& whole) const
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
    const double reachBeyondBound =
      side > 0 ? whole.upper[axis] - bound : bound - whole.lower[axis];
    const Vector3 extent = whole.extent();
    const double width = std::max(extent[(axis + 1) % 3], extent[(axis + 2) % 3]);
    return reach > 0 && reachBeyondBound < 0.5 * width;
  }

private:
  static bool isFlat(const Triangle& triangle, int axis)
  {
    return triangle.a[axis] == triangle.b[axis] && triangle.a[axis] == triangle.c[axis];
  }
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<AxisPlane> planes_;
  std::vector<std::uint32_t> planeOf_;        ///< of the triangles; empty if none lies in a plane
  std::array<std::vector<double>, 3> places_; ///< by axis, sorted
};

}
