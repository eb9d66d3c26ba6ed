// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

namespace irradiance
{

/// Corners in counter-clockwise order as seen from the front.
struct Triangle
{
  Vector3 a, b, c;

  Box bounds() const
  {
    Box box;
    box.add(a);
    box.add(b);
    box.add(c);
    return box;
  }
  /// Its length is twice the area; it points to the front.
  Vector3 areaVector() const { return (b - a).cross(c - a); }
  double area() const { return 0.5 * areaVector().norm(); }

  friend bool operator==(const Triangle& s, const Triangle& t)
  {
    return s.a == t.a && s.b == t.b && s.c == t.c;
  }
};

inline Triangle transformed(const AffineMap& map, const Triangle& triangle)
{
  return { map(triangle.a), map(triangle.b), map(triangle.c) };
}

}
