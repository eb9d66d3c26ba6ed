// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/ClosestPoint.h"

#include <algorithm>

namespace irradiance
{

namespace
{

Vector3 closestOnEdge(const Vector3& from, const Vector3& edge)
{
  const double squared = edge.squaredNorm();
  return from + (squared > 0 ? std::clamp(-from.dot(edge) / squared, 0.0, 1.0) : 0.0) * edge;
}

}

/// By the region of the plane that the origin's foot lies in (Ericson, Real-Time Collision
/// Detection, 5.1.5); edges are tried one by one where it lies outside.
Vector3 closestPoint(const Triangle& triangle)
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
