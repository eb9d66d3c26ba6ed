// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/SurfacePoint.h"
#include "Progress/CancelPoint.h"
#include "Simd/Prefetch.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace irradiance
{

/// Triangles with their corners contiguous, as the intersection test reads them.
class TriangleMesh
{
public:
  TriangleMesh() = default;
  explicit TriangleMesh(std::vector<Triangle> triangles, const CancelPoint& cancelPoint = {})
    : triangles_(std::move(triangles))
  {
    ThrottledCancelPoint pace(cancelPoint);
    for (const Triangle& triangle : triangles_)
    {
      bounds_.add(triangle.bounds());
      const double a = (triangle.c - triangle.b).norm(), b = (triangle.a - triangle.c).norm(),
                   c = (triangle.b - triangle.a).norm(), area = triangle.areaVector().norm();
      const double longest = std::max({ a, b, c });
      longestEdge_ = std::max(longestEdge_, longest);
      const double slenderness = area > 0 ? longest * (a + b + c) / area : 0.0;
      slenderness_ = std::max(slenderness_, slenderness);
      clearance_ = std::max(
        clearance_, farthestClearance(triangle.bounds().magnitude(), longest, slenderness));
      pace.step();
    }
  }

  std::size_t size() const { return triangles_.size(); }
  bool isEmpty() const { return triangles_.empty(); }
  const Triangle& operator[](std::size_t i) const { return triangles_[i]; }
  /// Prefetches a triangle that will be read soon.
  void prefetch(std::size_t i) const
  {
    const auto* first = reinterpret_cast<const char*>(triangles_.data() + i);
    prefetchLine(first);
    prefetchLine(first + sizeof(Triangle) - 1);
  }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Box& bounds() const { return bounds_; }
  double longestEdge() const { return longestEdge_; }
  /// The largest ratio of a triangle's longest edge to the radius of its incircle.
  double slenderness() const { return slenderness_; }
  /// The largest farthestClearance() of its triangles, in the mesh's own space.
  double clearance() const { return clearance_; }

private:
  std::vector<Triangle> triangles_;
  Box bounds_;
  double longestEdge_ = 0;
  double slenderness_ = 0;
  double clearance_ = 0;
};

}
