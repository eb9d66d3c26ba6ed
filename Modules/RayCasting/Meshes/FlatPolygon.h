// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace irradiance
{

using Vector2 = Eigen::Vector2d;

/// In the unit frame: what is no wider than this is a line, up to rounding.
constexpr double kLineWidth = 0x1p-48;

struct PolygonAxes
{
  Eigen::Index right, up, towards;
};

inline PolygonAxes axesSeenFrom(const Vector3& front)
{
  PolygonAxes axes{};
  front.cwiseAbs().maxCoeff(&axes.towards);
  axes.right = (axes.towards + 1) % 3;
  axes.up = (axes.towards + 2) % 3;
  if (front[axes.towards] < 0)
  {
    std::swap(axes.right, axes.up);
  }
  return axes;
}

/// Normal of a triangle: a corner, the one furthest from it, and the one furthest from their line.
inline Vector3 normalOfWidestTriangle(const std::vector<Vector3>& corners)
{
  const Vector3& first = corners.front();
  const auto furthest =
    std::max_element(corners.begin(), corners.end(), [&](const Vector3& a, const Vector3& b) {
      return (a - first).squaredNorm() < (b - first).squaredNorm();
    });
  const Vector3 line = *furthest - first;
  Vector3 normal = Vector3::Zero();
  for (const Vector3& corner : corners)
  {
    const Vector3 candidate = line.cross(corner - first);
    normal = candidate.norm() > normal.norm() ? candidate : normal;
  }
  const bool isLine = !(normal.norm() > kLineWidth * line.norm());
  return isLine ? Vector3::Zero() : normal;
}

/// The corners times the power of two that brings the largest coordinate to 1..2, rounded to
/// multiples of 2^-75, so that exact numbers stay short.
inline std::vector<Vector3> inUnitFrame(const std::vector<Vector3>& corners)
{
  constexpr int kSmallestBit = 75; // 2^-75
  double largest = 0;
  for (const Vector3& corner : corners)
  {
    largest = std::max(largest, corner.cwiseAbs().maxCoeff());
  }
  std::vector<Vector3> result = corners;
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  const auto rounded = [&](double x) {
    return std::ldexp(std::nearbyint(std::ldexp(x, kSmallestBit - exponent)), -kSmallestBit);
  };
  for (Vector3& corner : result)
  {
    corner = corner.unaryExpr(rounded);
  }
  return result;
}

/// The direction from which the polygon appears largest and counter-clockwise: along its area
/// vector. If parts cancel, as a bow-tie's do, it is a normal of its plane, on either side. Zero if
/// all corners are on a line. Expects the unit frame.
inline Vector3 frontOf(const std::vector<Vector3>& corners)
{
  Vector3 area = Vector3::Zero();
  double path = 0;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
  {
    const Vector3 part = (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
    area += part;
    path += part.norm();
  }
  // An area vector below this fraction of the sum of its parts may lie in the plane of a polygon
  // that is not quite planar.
  constexpr double kCancelled = 0x1p-6;
  const Vector3 normal = normalOfWidestTriangle(corners);
  if (!normal.isZero(0) && area.norm() > kCancelled * path)
  {
    return area;
  }
  const Eigen::Index towards = axesSeenFrom(normal).towards;
  return area[towards] * normal[towards] < 0 ? -normal : normal;
}

/// True if no corner leaves the plane normal to `front` by more than `tolerance` polygon widths.
inline bool isPlanar(const std::vector<Vector3>& corners, const Vector3& front, double tolerance)
{
  const Vector3 up = front.normalized();
  double height = 0, width = 0;
  for (const Vector3& corner : corners)
  {
    height = std::max(height, std::abs(up.dot(corner - corners[0])));
    width = std::max(width, (corner - corners[0]).norm());
  }
  return height <= tolerance * width;
}

/// The polygon as seen from the front along a coordinate axis. Nothing is rounded, so that corners
/// on a line stay on a line.
inline std::vector<Vector2> seenAlongAxis(const std::vector<Vector3>& corners, const Vector3& front)
{
  const PolygonAxes axes = axesSeenFrom(front);
  std::vector<Vector2> flat;
  flat.reserve(corners.size());
  for (const Vector3& corner : corners)
  {
    flat.emplace_back(corner[axes.right], corner[axes.up]);
  }
  return flat;
}

/// The polygon as seen from the front along `front` itself, on the plane normal to the same axis. A
/// polygon far from planar may cross itself when seen along the axis and not here.
inline std::vector<Vector2> seenFromFront(const std::vector<Vector3>& corners, const Vector3& front)
{
  const PolygonAxes axes = axesSeenFrom(front);
  const Vector2 slope(
    front[axes.right] / front[axes.towards], front[axes.up] / front[axes.towards]);
  std::vector<Vector2> flat = seenAlongAxis(corners, front);
  for (std::size_t i = 0; i < flat.size(); ++i)
  {
    flat[i] -= (corners[i][axes.towards] - corners[0][axes.towards]) * slope;
  }
  return flat;
}

/// True if the polygon turns left at every corner, by more than 2^-20 rad, and goes around once.
inline bool isConvex(const std::vector<Vector2>& corners)
{
  constexpr double kLeastTurn = 0x1p-20; // rad
  const std::size_t size = corners.size();
  const auto isUpward = [](const Vector2& edge) {
    return edge.y() > 0 || (edge.y() == 0 && edge.x() > 0);
  };
  int rounds = 0;
  Vector2 last = corners[0] - corners[size - 1];
  for (std::size_t i = 0; i < size; ++i)
  {
    const Vector2 next = corners[(i + 1) % size] - corners[i];
    const double turn = last.x() * next.y() - last.y() * next.x();
    if (!(turn > kLeastTurn * last.norm() * next.norm()))
    {
      return false;
    }
    rounds += isUpward(next) && !isUpward(last) ? 1 : 0;
    last = next;
  }
  return rounds == 1;
}

/// A fan from the first corner.
inline std::vector<Triangle> cutFan(const std::vector<Vector3>& corners)
{
  std::vector<Triangle> triangles;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    triangles.push_back({ corners[0], corners[i], corners[i + 1] });
  }
  return triangles;
}

/// For a convex polygon. Cuts off every other corner, repeatedly: few triangles are slender.
inline std::vector<Triangle> cutConvex(const std::vector<Vector3>& corners)
{
  std::vector<Triangle> triangles;
  for (std::size_t step = 1; step < corners.size(); step *= 2)
  {
    for (std::size_t i = 0; i + step < corners.size(); i += 2 * step)
    {
      const std::size_t end = i + 2 * step < corners.size() ? i + 2 * step : 0;
      if (i != end)
      {
        triangles.push_back({ corners[i], corners[i + step], corners[end] });
      }
    }
  }
  return triangles;
}

/// For four corners. Cuts along diagonal 0-2, or 1-3 if only that lies inside; nothing if neither.
inline std::optional<std::vector<Triangle>> cutQuad(const std::vector<Vector3>& corners)
{
  const auto isInside = [](const Triangle& one, const Triangle& other) {
    return one.areaVector().dot(other.areaVector()) >= 0;
  };
  const Triangle a{ corners[0], corners[1], corners[2] };
  const Triangle b{ corners[0], corners[2], corners[3] };
  if (isInside(a, b))
  {
    return std::vector<Triangle>{ a, b };
  }
  const Triangle c{ corners[0], corners[1], corners[3] };
  const Triangle d{ corners[1], corners[2], corners[3] };
  if (isInside(c, d))
  {
    return std::vector<Triangle>{ c, d };
  }
  return std::nullopt;
}

}
