// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntersectionLanes_h
#define irradiance_IntersectionLanes_h

#include "Geometry/TriangleIntersection.h"

#include <cmath>
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

    void set(unsigned lane, const Vector3& point)
    {
      x[lane] = point[0];
      y[lane] = point[1];
      z[lane] = point[2];
    }
    /// In the order of the ray.
    __attribute__((always_inline)) Intersection::Point ordered(
      unsigned lane, int axis, bool isFlipped) const
    {
      const double px = x[lane], py = y[lane], pz = z[lane];
      const double first = axis == 0 ? py : axis == 1 ? pz : px;
      const double second = axis == 0 ? pz : axis == 1 ? px : py;
      return { isFlipped ? second : first, isFlipped ? first : second,
        axis == 0     ? px
          : axis == 1 ? py
                      : pz };
    }
  };

  Points origin, direction, a, b, c;
  alignas(64) double distance[kSize] = {}; ///< NaN where the ray misses
  alignas(64) double weightB[kSize] = {}, weightC[kSize] = {};

  void set(
    unsigned lane, const Vector3& rayOrigin, const Vector3& rayDirection, const Triangle& triangle)
  {
    origin.set(lane, rayOrigin);
    direction.set(lane, rayDirection);
    a.set(lane, triangle.a);
    b.set(lane, triangle.b);
    c.set(lane, triangle.c);
  }

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void intersect()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double steepX = std::abs(direction.x[lane]), steepY = std::abs(direction.y[lane]);
      const bool isYSteeper = steepY > steepX;
      const bool isZ = std::abs(direction.z[lane]) > (isYSteeper ? steepY : steepX);
      const int axis = isZ ? 2 : isYSteeper ? 1 : 0;
      const bool isFlipped = (isZ             ? direction.z[lane]
                                 : isYSteeper ? direction.y[lane]
                                              : direction.x[lane]) < 0;
      const Intersection intersection(origin.ordered(lane, axis, isFlipped),
        direction.ordered(lane, axis, isFlipped), a.ordered(lane, axis, isFlipped),
        b.ordered(lane, axis, isFlipped), c.ordered(lane, axis, isFlipped));
      distance[lane] =
        intersection.isHit ? intersection.distance : std::numeric_limits<double>::quiet_NaN();
      weightB[lane] = intersection.weightB;
      weightC[lane] = intersection.weightC;
    }
  }
};

}

#endif
