// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/SurfacePoint.h"

#include <algorithm>

namespace irradiance
{

namespace
{

/**
 * The one formula of a SurfacePoint, in plain numbers and without branches: loops over many points
 * that become SIMD give the same bits.
 *
 * The point is kept off the edges: near an edge the rounded position may lie behind the neighbour,
 * and then no step along the triangle's own normal helps.
 */
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

  struct Point
  {
    double x, y, z;
  };

  Point position, normal;
  double clearance;
  Point kept; ///< the weights, raised to what keeps the point off the edges

  /// The weights of the corners a, b, c are `weight` x, y, z.
  __attribute__((always_inline))
  SurfaceFormula(const Point& a, const Point& b, const Point& c, const Point& weight)
  {
    const Point ab = minus(b, a), ac = minus(c, a);
    const Point area{ ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z,
      ab.x * ac.y - ab.y * ac.x };
    const double perLength =
      1 / __builtin_sqrt(area.x * area.x + area.y * area.y + area.z * area.z);
    normal = { area.x * perLength, area.y * perLength, area.z * perLength };
    clearance = kClearance * most(most(largest(a), largest(b)), largest(c));
    const double perEdge = clearance * perLength;
    // The 1-norm is no less than the length and needs no square root.
    kept = { inside(weight.x, perEdge * sum(minus(c, b))),
      inside(weight.y, perEdge * sum(minus(a, c))), inside(weight.z, perEdge * sum(minus(b, a))) };
    const double scale = 1 / (kept.x + kept.y + kept.z);
    position = { (kept.x * a.x + kept.y * b.x + kept.z * c.x) * scale,
      (kept.x * a.y + kept.y * b.y + kept.z * c.y) * scale,
      (kept.x * a.z + kept.y * b.z + kept.z * c.z) * scale };
  }

private:
  __attribute__((always_inline)) static double most(double a, double b) { return a > b ? a : b; }
  __attribute__((always_inline)) static double least(double a, double b) { return a < b ? a : b; }
  __attribute__((always_inline)) static double size(double a) { return __builtin_fabs(a); }
  __attribute__((always_inline)) static double largest(const Point& p)
  {
    return most(most(size(p.x), size(p.y)), size(p.z));
  }
  __attribute__((always_inline)) static double sum(const Point& p)
  {
    return size(p.x) + size(p.y) + size(p.z);
  }
  __attribute__((always_inline)) static Point minus(const Point& a, const Point& b)
  {
    return { a.x - b.x, a.y - b.y, a.z - b.z };
  }
  /// A weight raised to what keeps the point off the opposite edge.
  __attribute__((always_inline)) static double inside(double weight, double inset)
  {
    return most(weight, least(most(inset, least(kSharpest * inset, kMostRaised)), 1.0 / 3.0));
  }
};

SurfaceFormula::Point plain(const Vector3& v)
{
  return { v[0], v[1], v[2] };
}

void store(const SurfaceFormula::Point& point, double (&row)[3])
{
  row[0] = point.x;
  row[1] = point.y;
  row[2] = point.z;
}

}

SurfacePoint surfacePoint(const Triangle& triangle, const Vector3& weights)
{
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

SurfaceRecord::SurfaceRecord(const Triangle& world)
{
  // Weights of 0 are raised to the least that any weight is raised to.
  const SurfaceFormula formula(plain(world.a), plain(world.b), plain(world.c), { 0, 0, 0 });
  store(plain(world.a), a);
  store(plain(world.b), b);
  store(plain(world.c), c);
  store(formula.normal, normal);
  clearance = formula.clearance;
  store(formula.kept, inset);
}

}
