// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AxisPlanes_h
#define irradiance_AxisPlanes_h

#include "Geometry/Triangle.h"
#include "Progress/CancelPoint.h"

#include <array>
#include <cstdint>
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
  explicit AxisPlanes(const std::vector<Triangle>& triangles, const CancelPoint& cancelPoint = {});

  /// See TriangleTree::renumber().
  void renumber(const std::vector<std::uint32_t>& numbers);

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
  bool hide(int axis, int side, float bound, const Box& whole) const;

private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<AxisPlane> planes_;
  std::vector<std::uint32_t> planeOf_;        ///< of the triangles; empty if none lies in a plane
  std::array<std::vector<double>, 3> places_; ///< by axis, sorted
};

}

#endif
