#include "SurfacePoint.h"

namespace irradiance
{

/// Keeping the point off the edges matters: beside an edge the rounded position may lie behind the
/// neighbour, where no step along the own normal helps.
SurfacePoint surfacePoint(const Triangle& triangle, const Vector3& weights)
{
  const Vector3 area = triangle.areaVector();
  const double length = area.norm();
  SurfacePoint point;
  point.isFront = true;
  const double perLength = 1 / length; // one division for all
  point.normal = area * perLength;
  point.margin = 0x1p-33 * triangle.bounds().magnitude();
  const double perEdge = point.margin * perLength;
  // The 1-norm is no less than the length and needs no square root.
  const Vector3 inset(perEdge * (triangle.c - triangle.b).lpNorm<1>(),
    perEdge * (triangle.a - triangle.c).lpNorm<1>(),
    perEdge * (triangle.b - triangle.a).lpNorm<1>());
  Vector3 kept = weights.cwiseMax(inset.cwiseMin(1.0 / 3.0));
  kept *= 1 / kept.sum();
  point.position = kept[0] * triangle.a + kept[1] * triangle.b + kept[2] * triangle.c;
  return point;
}

}
