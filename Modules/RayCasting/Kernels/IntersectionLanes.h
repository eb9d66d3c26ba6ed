// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntersectionLanes_h
#define irradiance_IntersectionLanes_h

#include "Geometry/TriangleIntersection.h"

#include <limits>

namespace irradiance
{

/// Eight intersections of a ray and a triangle, side by side.
struct IntersectionLanes
{
  static constexpr unsigned kSize = 8;

  struct alignas(64) Points
  {
    double x[kSize] = {}, y[kSize] = {}, z[kSize] = {};

    void set(unsigned lane, const RayAxes& axes, const Vector3& point)
    {
      x[lane] = point[axes.x];
      y[lane] = point[axes.y];
      z[lane] = point[axes.z];
    }
    __attribute__((always_inline)) Intersection::Point operator[](unsigned lane) const
    {
      return { x[lane], y[lane], z[lane] };
    }
  };

  Points origin, direction, a, b, c;
  alignas(64) double distance[kSize] = {}; ///< NaN where the ray misses
  alignas(64) double weightB[kSize] = {}, weightC[kSize] = {};

  void set(
    unsigned lane, const Vector3& rayOrigin, const Vector3& rayDirection, const Triangle& triangle)
  {
    const RayAxes axes(rayDirection);
    origin.set(lane, axes, rayOrigin);
    direction.set(lane, axes, rayDirection);
    a.set(lane, axes, triangle.a);
    b.set(lane, axes, triangle.b);
    c.set(lane, axes, triangle.c);
  }

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void intersect()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const Intersection intersection(origin[lane], direction[lane], a[lane], b[lane], c[lane]);
      distance[lane] =
        intersection.isHit ? intersection.distance : std::numeric_limits<double>::quiet_NaN();
      weightB[lane] = intersection.weightB;
      weightC[lane] = intersection.weightC;
    }
  }
};

/// Uses the best instructions of the machine. All give the same bits.
void intersectAll(IntersectionLanes& lanes);
void intersectAllPlain(IntersectionLanes& lanes);
void intersectAllAvx2(IntersectionLanes& lanes);
void intersectAllAvx512(IntersectionLanes& lanes);

}

#endif
