// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/SimpleShells.h"

#include "Trees/LeafQuery.h"

#include <algorithm>
#include <array>

namespace irradiance
{

namespace
{

template <std::size_t N>
using Points = std::array<Vector3, N>;

/// Moves those corners to the front that are shared with another triangle; returns how many.
std::size_t sortShared(Points<3>& corners, const Triangle& other)
{
  const auto isShared = [&](const Vector3& corner) {
    return corner == other.a || corner == other.b || corner == other.c;
  };
  return static_cast<std::size_t>(
    std::stable_partition(corners.begin(), corners.end(), isShared) - corners.begin());
}

/// A triangle has three edges, a segment one.
template <std::size_t N>
Vector3 edgeOf(const Points<N>& points, std::size_t i)
{
  return points[(i + 1) % N] - points[i];
}

template <std::size_t N>
bool arePartedAlong(
  const Vector3& axis, const Points<N>& points, const Points<3>& triangle, double tolerance)
{
  double lower[2] = { kInfinity, kInfinity }, upper[2] = { -kInfinity, -kInfinity };
  const auto add = [&](int of, const Vector3& point) {
    const double along = axis.dot(point - triangle[0]);
    lower[of] = std::min(lower[of], along);
    upper[of] = std::max(upper[of], along);
  };
  std::for_each(points.begin(), points.end(), [&](const Vector3& point) { add(0, point); });
  std::for_each(triangle.begin(), triangle.end(), [&](const Vector3& point) { add(1, point); });
  return std::max(lower[0] - upper[1], lower[1] - upper[0]) > tolerance * axis.norm();
}

/// Whether a plane parts a triangle from a segment or another triangle. Of two convex polyhedra it
/// can be chosen along a face, or along an edge of each (separating axes; Gottschalk, Lin, Manocha
/// 1996); of two that lie in one plane, along an edge and across that plane.
template <std::size_t N>
bool areParted(const Points<N>& points, const Points<3>& triangle, double tolerance)
{
  constexpr std::size_t kEdges = N == 3 ? 3 : 1;
  const auto along = [&](const Vector3& axis) {
    return arePartedAlong(axis, points, triangle, tolerance);
  };
  const Vector3 normal = edgeOf(triangle, 0).cross(edgeOf(triangle, 1));
  bool isParted =
    along(normal) || (N == 3 && along(edgeOf(points, 0).cross(edgeOf(points, kEdges > 1 ? 1 : 0))));
  for (std::size_t i = 0; i < 3 && !isParted; ++i)
  {
    const Vector3 edge = edgeOf(triangle, i);
    isParted = along(edge.cross(normal));
    for (std::size_t k = 0; k < kEdges && !isParted; ++k)
    {
      isParted =
        along(edge.cross(edgeOf(points, k))) || (i == 0 && along(normal.cross(edgeOf(points, k))));
    }
  }
  return isParted;
}

/// Whether two triangles with a common edge, from the first to the second corner, lie on each
/// other.
bool areFolded(const Points<3>& s, const Points<3>& t)
{
  constexpr double kSameAngle = 1e-6;
  const Vector3 edge = edgeOf(s, 0).normalized();
  const auto across = [&](const Vector3& corner) -> Vector3 {
    return corner - s[0] - edge.dot(corner - s[0]) * edge;
  };
  const Vector3 p = across(s[2]), q = across(t[2]);
  return p.dot(q) >= 0 && p.cross(q).norm() <= kSameAngle * p.norm() * q.norm();
}

/// Whether two triangles may have points in common that are not their common corners and edges. If
/// they touch elsewhere and share a corner, the edge across from it touches the other one, of one
/// of the two.
bool mayTouch(const Triangle& first, const Triangle& second, double tolerance)
{
  Box common = first.bounds().intersection(second.bounds());
  common.inflate(tolerance);
  if (common.isEmpty())
  {
    return false;
  }
  Points<3> s{ first.a, first.b, first.c }, t{ second.a, second.b, second.c };
  sortShared(t, first);
  switch (sortShared(s, second))
  {
    case 0:
      return !areParted(s, t, tolerance);
    case 1:
      return !areParted(Points<2>{ s[1], s[2] }, t, tolerance) ||
        !areParted(Points<2>{ t[1], t[2] }, s, tolerance);
    case 2:
      return areFolded(s, t);
    default:
      return true;
  }
}

/// Whether a triangle lies in a plane across an axis, or has an edge along one.
bool isAlongAxes(const Triangle& t)
{
  const double rounding = 0x1p-20 * t.bounds().magnitude();
  const auto isAlong = [&](const Vector3& edge) {
    return (edge.array().abs() <= rounding).count() >= 2;
  };
  return t.bounds().extent().minCoeff() <= rounding || isAlong(t.b - t.a) || isAlong(t.c - t.b) ||
    isAlong(t.a - t.c);
}

}

void markSimpleShells(SolidSides& sides, const std::vector<Triangle>& triangles,
  const TriangleTree& tree, const CancelPoint& cancelPoint)
{
  for (Shell& shell : sides.shells)
  {
    shell.isSimple = shell.isClosed;
  }
  ThrottledCancelPoint pace(cancelPoint);
  const auto look = [&](std::uint32_t triangle, const std::vector<std::uint32_t>& others) {
    constexpr std::size_t kMany = 512;
    Shell& shell = sides.shells[sides.shellOf[triangle]];
    const double tolerance = 0x1p-44 * shell.bounds.magnitude();
    shell.isSimple = shell.isSimple && others.size() <= kMany;
    for (auto other = others.begin(); other != others.end() && shell.isSimple; ++other)
    {
      pace.step();
      shell.isSimple = *other == triangle || sides.shellOf[*other] != sides.shellOf[triangle] ||
        !mayTouch(triangles[triangle], triangles[*other], tolerance);
    }
  };
  // Where surfaces cross, some of their triangles are in one leaf; unless they cross just where
  // cells of the tree meet, hence along axes.
  std::vector<std::uint32_t> listed;
  const TriangleBlock* leaf = tree.blocks();
  while (leaf != tree.blocks() + tree.numberOfBlocks())
  {
    listed.clear();
    leaf = forEachListed(leaf, [&](std::uint32_t triangle) {
      look(triangle, listed);
      listed.push_back(triangle);
    });
  }
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    if (sides.shell(i).isSimple && isAlongAxes(triangles[i]))
    {
      look(i, trianglesNear(tree, triangles[i].bounds()));
    }
  }
}

}
