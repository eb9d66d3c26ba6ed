// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

#include <utility>

namespace irradiance
{

/// A triangle cut by six planes has at most nine corners. Rounding may bend an edge that lies in a
/// plane; then a cut adds half as many again, so 3 * 1.5^6 is the hard limit.
struct ClippedPolygon
{
  Vector3 corners[36];
  int size = 0;

  /// Becomes what of another polygon lies on the side of the plane where sign * (x - plane) >= 0.
  void clip(const ClippedPolygon& in, int axis, double plane, double sign)
  {
    size = 0;
    for (int i = 0; i < in.size; ++i)
    {
      const Vector3& p = in.corners[i];
      const Vector3& q = in.corners[i + 1 == in.size ? 0 : i + 1];
      const double dp = sign * (p[axis] - plane), dq = sign * (q[axis] - plane);
      if (dp >= 0)
      {
        corners[size++] = p;
      }
      if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0))
      {
        Vector3 cut = p + dp / (dp - dq) * (q - p);
        cut[axis] = plane;
        corners[size++] = cut;
      }
    }
  }
};

/// Bounds of the part of a triangle inside a box (Sutherland and Hodgman 1974); empty if there is
/// none. The error is a few ulps of the coordinates.
inline Box boundsOfClipped(const Triangle& triangle, const Box& box)
{
  ClippedPolygon first, second;
  ClippedPolygon *polygon = &first, *next = &second;
  polygon->corners[0] = triangle.a;
  polygon->corners[1] = triangle.b;
  polygon->corners[2] = triangle.c;
  polygon->size = 3;
  const Box uncut = triangle.bounds();
  const auto cutBy = [&](int axis, double plane, double sign) {
    next->clip(*polygon, axis, plane, sign);
    std::swap(polygon, next);
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    // Most planes cut nothing.
    if (uncut.lower[axis] < box.lower[axis])
    {
      cutBy(axis, box.lower[axis], 1.0);
    }
    if (uncut.upper[axis] > box.upper[axis])
    {
      cutBy(axis, box.upper[axis], -1.0);
    }
  }
  Box bounds;
  for (int i = 0; i < polygon->size; ++i)
  {
    bounds.add(polygon->corners[i]);
  }
  return bounds;
}

}
