// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SurfacePoint_h
#define irradiance_SurfacePoint_h

#include "Geometry/Triangle.h"

namespace irradiance
{

/// A point of a triangle as a ray may leave it without meeting that triangle or a neighbour by
/// rounding.
struct SurfacePoint
{
  Vector3 position; ///< on the triangle, kept off its edges by 64 `margin` if there is room
  Vector3 normal;   ///< unit vector
  double margin;    ///< 2^-33 of the largest coordinate: the step along the normal that is clear
  bool isFront;     ///< the normal points to the front

  /// From the front to the side wanted.
  void turn(bool toFront)
  {
    isFront = toFront;
    normal = toFront ? normal : Vector3(-normal);
  }
  Vector3 clearPosition() const { return position + margin * normal; }
};

/// `weights`: barycentric coordinates, not negative. The normal is that of the front.
SurfacePoint surfacePoint(const Triangle& worldTriangle, const Vector3& weights);

/// No clear position is farther than this from the point that the weights say, on triangles with no
/// coordinate larger than `magnitude`, no edge longer than `longestEdge`, and no larger ratio of the
/// longest edge to the radius of the circle within than `slenderness`.
double farthestClearance(double magnitude, double longestEdge, double slenderness);

}

#endif
