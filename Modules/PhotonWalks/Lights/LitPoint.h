// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LitPoint_h
#define irradiance_LitPoint_h

#include "Geometry/Ray.h"
#include "Geometry/Triangle.h"

namespace irradiance
{

/// A point that receives light, from one side or from all directions.
struct LitPoint
{
  Vector3 position; ///< world; clear of the surface on which it stands
  Vector3 normal;   ///< unit vector, to the side that receives; 0: it receives from all directions
  TriangleId on{};  ///< the triangle on which it stands; none in the air

  bool hasNormal() const { return !normal.isZero(0); }
  /// How much of a beam along a vector it receives: the cosine, not positive from behind; 1 without
  /// a normal.
  double partOf(const Vector3& along) const
  {
    return hasNormal() ? -normal.dot(along) / along.norm() : 1;
  }

  /// On a side of a triangle, at the point nearest to a place in its plane, roughly.
  static LitPoint onTriangle(
    const Triangle& worldTriangle, const TriangleId& id, bool isFront, const Vector3& place);
};

/// The barycentric weights of a place in the plane of a triangle; some are negative beside the
/// triangle.
Vector3 weightsInPlane(const Triangle& triangle, const Vector3& place);

}

#endif
