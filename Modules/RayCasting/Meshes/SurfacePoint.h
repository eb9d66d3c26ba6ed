// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

namespace irradiance
{

/// A point of a triangle that a ray can leave without hitting that triangle or a neighbour through
/// rounding.
struct SurfacePoint
{
  Vector3 position; ///< on the triangle, kept off its edges by 64 `clearance` if there is room
  Vector3 normal;   ///< unit vector
  double clearance; ///< 2^-33 of the largest coordinate: the step along the normal to a clear start
  bool isFront;     ///< the normal points to the front

  /// Turns the normal, which must point to the front, to the given side.
  void turn(bool toFront)
  {
    isFront = toFront;
    normal = toFront ? normal : Vector3(-normal);
  }
  Vector3 clearPosition() const { return position + clearance * normal; }
};

/// `weights`: barycentric coordinates, >= 0. The normal of the result points to the front.
SurfacePoint surfacePoint(const Triangle& worldTriangle, const Vector3& weights);

/// An upper bound of the distance from the point given by the weights to clearPosition(), for
/// triangles with coordinates up to `magnitude`, edges up to `longestEdge` and a ratio of longest
/// edge to incircle radius up to `slenderness`.
double farthestClearance(double magnitude, double longestEdge, double slenderness);

/// What rays that leave a triangle need of it, in world space, as SurfaceFormula computes it: a row
/// of 128 bytes. Rows of many triangles are read side by side.
struct alignas(64) SurfaceRecord
{
  double a[3], b[3], c[3]; ///< corners
  double normal[3];        ///< unit, of the front; NaN where there is no area
  double clearance;        ///< how far off the triangle rays start
  double inset[3];         ///< the least weights of a, b, c: points are kept off the edges

  SurfaceRecord() = default;
  explicit SurfaceRecord(const Triangle& world);
};
static_assert(sizeof(SurfaceRecord) == 128);

}
