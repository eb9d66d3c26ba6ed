// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"

#include "Meshes/SurfaceFormula.h"

#include <algorithm>

namespace irradiance
{

SurfacePoint surfacePoint(const Triangle& triangle, const Vector3& weights)
{
  const auto plain = [](const Vector3& v) { return SurfaceFormula::Point{ v[0], v[1], v[2] }; };
  const SurfaceFormula formula(
    plain(triangle.a), plain(triangle.b), plain(triangle.c), plain(weights));
  return { { formula.position.x, formula.position.y, formula.position.z },
    { formula.normal.x, formula.normal.y, formula.normal.z }, formula.clearance, true };
}

/// Raising the weights by r in all and normalising them to a sum of 1 moves the point by at most r
/// longest edges. With p the radius of the incircle, the three insets together are at most sqrt(3)
/// clearance / p; the factor sqrt(3) is for the 1-norms. Two weights of a hit are rounded to
/// floats.
double farthestClearance(double magnitude, double longestEdge, double slenderness)
{
  const double clearance = SurfaceFormula::kClearance * magnitude;
  const double inset = 1.74 * clearance * slenderness; // times the longest edge
  const double sharp =
    std::min(SurfaceFormula::kSharpest * inset, 3 * SurfaceFormula::kMostRaised * longestEdge);
  constexpr double kRoundedWeights = 0x1p-23;
  return clearance + std::min(inset + sharp, longestEdge) + kRoundedWeights * longestEdge;
}

}
