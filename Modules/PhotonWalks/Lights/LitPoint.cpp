// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/LitPoint.h"

#include "Meshes/SurfacePoint.h"

namespace irradiance
{

Vector3 weightsInPlane(const Triangle& triangle, const Vector3& place)
{
  const Vector3 areaVector = triangle.areaVector();
  const double area = areaVector.stableNorm();
  const Vector3 normal = areaVector / area;
  const auto share = [&](const Vector3& from, const Vector3& to) {
    return normal.dot((to - from).cross(place - from)) / area;
  };
  const double b = share(triangle.c, triangle.a), c = share(triangle.a, triangle.b);
  return { 1 - b - c, b, c };
}

LitPoint LitPoint::onTriangle(
  const Triangle& worldTriangle, const TriangleId& id, bool isFront, const Vector3& place)
{
  // At an edge, rounding may leave the place beside the triangle.
  const Vector3 weights = weightsInPlane(worldTriangle, place).cwiseMax(0);
  SurfacePoint point = surfacePoint(worldTriangle, weights / weights.sum());
  point.turn(isFront);
  return { point.clearPosition(), point.normal, id };
}

}
