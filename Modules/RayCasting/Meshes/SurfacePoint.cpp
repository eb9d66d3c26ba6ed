// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// How far rays start off the triangle, relative to its largest coordinate.
constexpr double kClearance = 0x1p-33;
/// A point is kept this many times farther from the edges than above its triangle. If two walls
/// meet at more than an angle of 1 in 64, the step off one of them stays in front of the other.
constexpr double kSharpest = 64;
/// No weight is raised beyond this for that purpose. Otherwise a step that is large beside its
/// triangle (far from the origin) would gather all points in the middle.
constexpr double kMostRaised = 0x1p-7;

}

/// The point is kept off the edges: beside an edge the rounded position may lie behind the
/// neighbour, and then no step along the triangle's own normal helps.
SurfacePoint surfacePoint(const Triangle& triangle, const Vector3& weights)
{
  const Vector3 area = triangle.areaVector();
  const double length = area.norm();
  SurfacePoint point;
  point.isFront = true;
  const double perLength = 1 / length; // one division for all
  point.normal = area * perLength;
  point.clearance = kClearance * triangle.bounds().magnitude();
  const double perEdge = point.clearance * perLength;
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

/// Raising the weights by r in all and normalising them to a sum of 1 moves the point by at most r
/// longest edges. With p the radius of the incircle, the three insets together are at most sqrt(3)
/// clearance / p; the factor sqrt(3) is for the 1-norms.
double farthestClearance(double magnitude, double longestEdge, double slenderness)
{
  const double clearance = kClearance * magnitude;
  const double inset = 1.74 * clearance * slenderness; // times the longest edge
  const double sharp = std::min(kSharpest * inset, 3 * kMostRaised * longestEdge);
  return clearance + std::min(inset + sharp, longestEdge);
}

}
