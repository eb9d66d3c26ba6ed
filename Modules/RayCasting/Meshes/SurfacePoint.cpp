// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// The margin, of the largest coordinate.
constexpr double kMargin = 0x1p-33;
/// How much farther off an edge a point is kept than above its triangle: where two walls meet at
/// more than the angle of 1 in 64, the step along the normal of one stays in front of the other.
constexpr double kSharpest = 64;
/// But no weight is raised beyond this for it, lest a margin that is large beside its triangle (far
/// from the origin) gathers all points in the middle.
constexpr double kMostRaised = 0x1p-7;

}

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
  point.margin = kMargin * triangle.bounds().magnitude();
  const double perEdge = point.margin * perLength;
  // The 1-norm is no less than the length and needs no square root.
  const Vector3 inset(perEdge * (triangle.c - triangle.b).lpNorm<1>(),
    perEdge * (triangle.a - triangle.c).lpNorm<1>(),
    perEdge * (triangle.b - triangle.a).lpNorm<1>());
  const Vector3 sharp = inset.cwiseMax((kSharpest * inset).cwiseMin(kMostRaised));
  Vector3 kept = weights.cwiseMax(sharp.cwiseMin(1.0 / 3.0));
  kept *= 1 / kept.sum();
  point.position = kept[0] * triangle.a + kept[1] * triangle.b + kept[2] * triangle.c;
  return point;
}

/// Weights that are raised by r in all, and brought back to a sum of 1, move the point by r longest
/// edges at most. With the radius p of the inner circle the three insets are sqrt(3) margin / p
/// together at most, the factor for their 1-norms.
double farthestClearance(double magnitude, double longestEdge, double slenderness)
{
  const double margin = kMargin * magnitude;
  const double inset = 1.74 * margin * slenderness; // times the longest edge
  const double sharp = std::min(kSharpest * inset, 3 * kMostRaised * longestEdge);
  return margin + std::min(inset + sharp, longestEdge);
}

}
