// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

/// The signed area that a disc around the origin of a plane through it has within the triangle of
/// the origin, p and q: a triangle under the part of the edge inside the disc, sectors under the
/// others. `normal`: a unit vector.
inline double underEdge(
  const Vector3& normal, double squaredRadius, const Vector3& p, const Vector3& q)
{
  const auto twiceSigned = [&](
                             const Vector3& a, const Vector3& b) { return normal.dot(a.cross(b)); };
  const auto sector = [&](const Vector3& a, const Vector3& b) {
    return 0.5 * squaredRadius * std::atan2(twiceSigned(a, b), a.dot(b));
  };
  const Vector3 edge = q - p;
  const double a = edge.squaredNorm(), b = p.dot(edge), c = p.squaredNorm() - squaredRadius;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0))
  {
    return sector(p, q);
  }
  const double root = std::sqrt(discriminant);
  const double enters = (-b - root) / a, leaves = (-b + root) / a;
  if (!(enters < 1 && leaves > 0))
  {
    return sector(p, q);
  }
  const Vector3 from = p + std::max(enters, 0.0) * edge, to = p + std::min(leaves, 1.0) * edge;
  return (enters > 0 ? sector(p, from) : 0) + 0.5 * twiceSigned(from, to) +
    (leaves < 1 ? sector(to, q) : 0);
}

inline Vector3 closestOnEdge(const Vector3& from, const Vector3& edge)
{
  const double squared = edge.squaredNorm();
  return from + (squared > 0 ? std::clamp(-from.dot(edge) / squared, 0.0, 1.0) : 0.0) * edge;
}

/// The area of the part of a triangle that lies within a sphere around the origin; the radius may
/// be infinite. A sphere cuts a disc out of the triangle's plane.
inline double areaInSphere(const Triangle& triangle, double radius)
{
  const double squaredRadius = radius * radius;
  const double farthest =
    std::max({ triangle.a.squaredNorm(), triangle.b.squaredNorm(), triangle.c.squaredNorm() });
  // Most triangles are outside: around their middles there is a ball that holds them.
  const Vector3 middle = (triangle.a + triangle.b + triangle.c) / 3;
  const double away = middle.norm() - radius;
  if (away > 0 &&
    away * away > std::max({ (triangle.a - middle).squaredNorm(),
                    (triangle.b - middle).squaredNorm(), (triangle.c - middle).squaredNorm() }))
  {
    return 0;
  }
  const Vector3 area = triangle.areaVector();
  const double twice = area.norm();
  if (farthest <= squaredRadius || !(twice > 0))
  {
    return 0.5 * twice;
  }
  const Vector3 normal = area / twice, foot = normal.dot(triangle.a) * normal;
  const double squaredOfDisc = squaredRadius - foot.squaredNorm();
  if (!(squaredOfDisc > 0))
  {
    return 0;
  }
  const Vector3 a = triangle.a - foot, b = triangle.b - foot, c = triangle.c - foot;
  const auto under = [&](const Vector3& p, const Vector3& q) {
    return underEdge(normal, squaredOfDisc, p, q);
  };
  return std::clamp(under(a, b) + under(b, c) + under(c, a), 0.0, 0.5 * twice);
}

/// The point of a triangle that is closest to the origin.
/// By the region of the plane that the origin's foot lies in (Ericson, Real-Time Collision
/// Detection, 5.1.5); edges are tried one by one where it lies outside.
inline Vector3 closestPoint(const Triangle& triangle)
{
  const Vector3 &a = triangle.a, &b = triangle.b, &c = triangle.c;
  const Vector3 normal = triangle.areaVector();
  const double u = normal.dot(b.cross(c)), v = normal.dot(c.cross(a)), w = normal.dot(a.cross(b));
  if (u > 0 && v > 0 && w > 0)
  {
    return normal.dot(a) / normal.squaredNorm() * normal;
  }
  Vector3 closest = closestOnEdge(a, b - a);
  for (const Vector3& other : { closestOnEdge(b, c - b), closestOnEdge(c, a - c) })
  {
    closest = other.squaredNorm() < closest.squaredNorm() ? other : closest;
  }
  return closest;
}

}
