// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

namespace irradiance
{

/**
 * The only ray/triangle test of the project. Every traversal, every verification and brute force
 * call it, so that they agree bit for bit.
 *
 * After Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (JCGT 2013): the triangle is
 * sheared so that the ray becomes the z axis, and the origin is tested against three edge functions
 * in 2D. Two triangles that share an edge compute its function from the same two points with
 * opposite signs, so no ray slips between them. Each product must be rounded on its own: the file
 * must be compiled without fused multiply-add (-ffp-contract=off).
 *
 * It has no branches, so that a loop over many intersections becomes SIMD.
 */
struct Intersection
{
  bool isHit;      ///< the ray hits the closed triangle, in front of the origin
  double distance; ///< in units of the direction; this and the weights are valid only if isHit
  double weightA, weightB, weightC; ///< barycentric

  /// Coordinates in the order of a ray: along z its direction is largest; x and y follow so that the
  /// orientation of the triangle, as the ray sees it, is kept.
  struct Point
  {
    double x, y, z;
  };

  __attribute__((always_inline)) Intersection(
    const Point& origin, const Point& direction, const Point& a, const Point& b, const Point& c)
  {
    const double scale = 1.0 / direction.z;
    const double shearX = direction.x * scale, shearY = direction.y * scale;
    const Point sa = sheared(a, origin, shearX, shearY), sb = sheared(b, origin, shearX, shearY),
                sc = sheared(c, origin, shearX, shearY);
    const double u = sc.x * sb.y - sc.y * sb.x;
    const double v = sa.x * sc.y - sa.y * sc.x;
    const double w = sb.x * sa.y - sb.y * sa.x;
    const bool isOutside = (least(least(u, v), w) < 0) & (most(most(u, v), w) > 0);
    // The silhouette of a triangle seen edge-on has zero width up to rounding. Where along it the
    // ray passes is noise, so this is no hit. Triangles of zero area are rejected here as well.
    const double determinant = u + v + w;
    const double spread = most(most(square(sa), square(sb)), square(sc));
    const bool isBroad = (determinant < 0 ? -determinant : determinant) > kEdgeOn * spread;
    const double inverse = 1.0 / determinant;
    distance = (u * sa.z + v * sb.z + w * sc.z) * inverse * scale;
    weightA = u * inverse;
    weightB = v * inverse;
    weightC = w * inverse;
    isHit = !isOutside & isBroad & (distance > 0) &
      !isBehind(origin.x, direction.x, a.x, b.x, c.x) &
      !isBehind(origin.y, direction.y, a.y, b.y, c.y);
  }

private:
  static constexpr double kEdgeOn = 0x1p-40;

  /// Whether the ray leaves all corners behind on an axis. Near edge-on rounding may turn a
  /// distance before the origin into one after it; this comparison is exact.
  __attribute__((always_inline)) static bool isBehind(
    double origin, double direction, double a, double b, double c)
  {
    return (direction > 0) & (most(most(a, b), c) < origin) |
      (direction < 0) & (least(least(a, b), c) > origin);
  }
  __attribute__((always_inline)) static Point sheared(
    const Point& point, const Point& origin, double shearX, double shearY)
  {
    const double z = point.z - origin.z;
    return { (point.x - origin.x) - shearX * z, (point.y - origin.y) - shearY * z, z };
  }
  __attribute__((always_inline)) static double square(const Point& point)
  {
    return point.x * point.x + point.y * point.y;
  }
  __attribute__((always_inline)) static double least(double a, double b) { return a < b ? a : b; }
  __attribute__((always_inline)) static double most(double a, double b) { return a > b ? a : b; }
};

/// One ray, to be tested against many triangles.
class ShearedRay
{
public:
  ShearedRay(const Vector3& origin, const Vector3& direction)
  {
    // Which component is largest is unpredictable, so there are no branches here.
    constexpr int kNext[4] = { 1, 2, 0, 1 };
    const Vector3 steepness = direction.cwiseAbs();
    const int steeper = static_cast<int>(steepness[1] > steepness[0]);
    const int isLast = static_cast<int>(steepness[2] > steepness[steeper]);
    z_ = steeper + isLast * (2 - steeper);
    const int flip = static_cast<int>(direction[z_] < 0);
    x_ = kNext[z_ + flip];
    y_ = kNext[z_ + 1 - flip];
    origin_ = ordered(origin);
    direction_ = ordered(direction);
  }

  /// True if the ray hits the closed triangle in front of its origin. Then `distance` is set, in
  /// units of the direction, and `weights`, if given, to the barycentric coordinates (>= 0, sum
  /// about 1).
  bool intersects(const Triangle& triangle, double& distance, Vector3* weights = nullptr) const
  {
    const Intersection intersection(
      origin_, direction_, ordered(triangle.a), ordered(triangle.b), ordered(triangle.c));
    if (intersection.isHit)
    {
      distance = intersection.distance;
      if (weights)
      {
        *weights = Vector3(intersection.weightA, intersection.weightB, intersection.weightC);
      }
    }
    return intersection.isHit;
  }

private:
  Intersection::Point ordered(const Vector3& point) const
  {
    return { point[x_], point[y_], point[z_] };
  }

  int x_, y_, z_; ///< the axes in the order of the ray
  Intersection::Point origin_, direction_;
};

}
