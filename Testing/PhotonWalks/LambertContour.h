// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"

#include <cmath>
#include <vector>

namespace irradiance::test
{

/// Irradiance at a point from a polygon of unit exitance that lies above the horizon of the normal:
/// Lambert's contour sum (1760), 1/(2 pi) sum of angle_i n . unit normal of the edge's cone.
inline double lambertIrradiance(
  const Vector3& point, const Vector3& normal, const std::vector<Vector3>& polygon)
{
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector3 a = (polygon[i] - point).normalized();
    const Vector3 b = (polygon[(i + 1) % polygon.size()] - point).normalized();
    const Vector3 cone = a.cross(b);
    if (cone.norm() > 0)
    {
      sum += std::atan2(cone.norm(), a.dot(b)) * normal.dot(cone) / cone.norm();
    }
  }
  return std::abs(sum) / (2 * M_PI);
}

/// Of a triangle as seen from a place. Van Oosterom and Strackee, "The Solid Angle of a Plane
/// Triangle" (1983).
inline double solidAngleOf(const Triangle& triangle, const Vector3& from)
{
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const Long3 place = from.cast<long double>();
  const Long3 a = triangle.a.cast<long double>() - place;
  const Long3 b = triangle.b.cast<long double>() - place;
  const Long3 c = triangle.c.cast<long double>() - place;
  const Long3 toB = triangle.b.cast<long double>() - triangle.a.cast<long double>();
  const Long3 toC = triangle.c.cast<long double>() - triangle.a.cast<long double>();
  const long double la = a.norm(), lb = b.norm(), lc = c.norm();
  return static_cast<double>(2 *
    std::atan2(std::abs(a.dot(toB.cross(toC))),
      la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb));
}

/// The part of a convex polygon that lies above the horizon of a normal at a point; none of one
/// that lies in it.
inline std::vector<Vector3> aboveHorizon(
  const std::vector<Vector3>& polygon, const Vector3& point, const Vector3& normal)
{
  std::vector<Vector3> above;
  bool isAny = false;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Vector3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double heightA = normal.dot(a - point), heightB = normal.dot(b - point);
    isAny = isAny || heightA > 0;
    if (heightA >= 0)
    {
      above.push_back(a);
    }
    if ((heightA > 0 && heightB < 0) || (heightA < 0 && heightB > 0))
    {
      above.push_back(a + (b - a) * (heightA / (heightA - heightB)));
    }
  }
  return isAny ? above : std::vector<Vector3>();
}

/// Mean of f over a rectangle by the midpoint rule on n x n points.
template <class Function>
double meanOverRectangle(
  const Vector3& corner, const Vector3& u, const Vector3& v, int n, const Function& f)
{
  double sum = 0;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      sum += f(Vector3(corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n)));
    }
  }
  return sum / n / n;
}

}
