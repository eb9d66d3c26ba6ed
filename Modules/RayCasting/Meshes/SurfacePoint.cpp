// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/// The one formula of a SurfacePoint. The point is kept off the edges: near an edge the rounded
/// position may lie behind the neighbour, and then no step along the triangle's own normal helps.
struct SurfaceFormula
{
  /// How far rays start off the triangle, relative to its largest coordinate.
  static constexpr double kClearance = 0x1p-33;
  /// A point is kept this many times farther from the edges than above its triangle. If two walls
  /// meet at more than an angle of 1 in 64, the step off one of them stays in front of the other.
  static constexpr double kSharpest = 64;
  /// No weight is raised beyond this for that purpose. Otherwise a step that is large relative
  /// to its triangle (far from the origin) would gather all points in the middle.
  static constexpr double kMostRaised = 0x1p-7;

  Vector3 position, normal;
  double clearance;
  Vector3 kept; ///< the weights, raised to what keeps the point off the edges

  SurfaceFormula(const Triangle& t, const Vector3& weights)
  {
    const Vector3 area = t.areaVector();
    const double perLength =
      1 / std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    normal = area * perLength;
    // No branches: which number is larger is unpredictable.
    const auto most = [](double x, double y) { return x > y ? x : y; };
    const auto least = [](double x, double y) { return x < y ? x : y; };
    const auto largest = [&](const Vector3& p) {
      return most(most(std::abs(p[0]), std::abs(p[1])), std::abs(p[2]));
    };
    clearance = kClearance * most(most(largest(t.a), largest(t.b)), largest(t.c));
    const double perEdge = clearance * perLength;
    const auto inside = [&](double weight, const Vector3& edge) {
      // The 1-norm is no less than the length and needs no square root.
      const double inset = perEdge * (std::abs(edge[0]) + std::abs(edge[1]) + std::abs(edge[2]));
      return most(weight, least(most(inset, least(kSharpest * inset, kMostRaised)), 1.0 / 3.0));
    };
    kept = { inside(weights[0], t.c - t.b), inside(weights[1], t.a - t.c),
      inside(weights[2], t.b - t.a) };
    const double scale = 1 / (kept[0] + kept[1] + kept[2]);
    position = (kept[0] * t.a + kept[1] * t.b + kept[2] * t.c) * scale;
  }
};

}

SurfacePoint surfacePoint(const Triangle& triangle, const Vector3& weights)
{
  const SurfaceFormula formula(triangle, weights);
  return { formula.position, formula.normal, formula.clearance, true };
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

SurfaceRecord::SurfaceRecord(const Triangle& world)
{
  // Weights of 0 are raised to the least that any weight is raised to.
  const SurfaceFormula formula(world, Vector3::Zero());
  Eigen::Map<Vector3>{ a } = world.a;
  Eigen::Map<Vector3>{ b } = world.b;
  Eigen::Map<Vector3>{ c } = world.c;
  Eigen::Map<Vector3>{ normal } = formula.normal;
  clearance = formula.clearance;
  Eigen::Map<Vector3>{ inset } = formula.kept;
}

}
