// SPDX-License-Identifier: BSD-3-Clause
#include "History/PointGrid.h"

#include "Surfaces/CoincidentTriangles.h"
#include "Surfaces/SceneObjects.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace irradiance
{

namespace
{

/// Spread evenly over the triangle, by the sequence of Roberts.
Vector3 pointOn(const Triangle& triangle, std::size_t number)
{
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  const auto n = static_cast<double>(number);
  double b = std::fmod(0.5 + kFirst * n, 1.0), c = std::fmod(0.5 + kSecond * n, 1.0);
  if (b + c > 1)
  {
    b = 1 - b;
    c = 1 - c;
  }
  return triangle.a + b * (triangle.b - triangle.a) + c * (triangle.c - triangle.a);
}

/// Some points, evenly spread over all surfaces; none if their area is no number to count with.
std::vector<Vector3> pointsOnSurfaces(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  constexpr std::size_t kPoints = 512;
  ThrottledCancelPoint pace(cancelPoint);
  std::vector<double> areas; // of all triangles in the world, object by object
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (const Triangle& own : objects[object].mesh().triangles())
    {
      areas.push_back(transformed(objects[object].worldFromObject, own).area());
      pace.step();
    }
  }
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::vector<Vector3> points;
  if (!(all > 0) || !std::isfinite(all))
  {
    return points;
  }
  const double each = all / kPoints;
  double before = 0;
  auto area = areas.begin();
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::uint32_t i = 0; i < objects[object].mesh().size(); ++i)
    {
      before += *area++;
      pace.step();
      while (points.size() < kPoints && (static_cast<double>(points.size()) + 0.5) * each < before)
      {
        points.push_back(pointOn(worldTriangle(objects, { object, i }), points.size()));
      }
    }
  }
  return points;
}

double medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Where most surfaces are: a middle, and a distance within which half of them lie on each axis.
std::pair<Vector3, double> middleOf(const std::vector<Vector3>& points)
{
  Vector3 center = Vector3::Zero();
  double spread = 0;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3 && !points.empty(); ++axis)
  {
    std::transform(points.begin(), points.end(), values.begin(),
      [&](const Vector3& point) { return point[axis]; });
    center[axis] = medianOf(values);
    std::transform(values.begin(), values.end(), values.begin(),
      [&](double value) { return std::abs(value - center[axis]); });
    spread = std::max(spread, medianOf(values));
  }
  return { center, spread };
}

/// By axis.
Eigen::Array<bool, 3, 1> isWithin(const Box& inner, const Box& outer)
{
  return inner.lower.array() >= outer.lower.array() && inner.upper.array() <= outer.upper.array();
}

}

PointGrid::PointGrid(const Box& box)
{
  if (box.isEmpty())
  {
    return;
  }
  center = box.center();
  // From the middle as it was rounded, so that both corners are within reach.
  const Vector3 half = (box.upper - center).cwiseMax(center - box.lower);
  constexpr double kFlattest = 0x1p-10, kSmallest = 0x1p-500;
  // Points on the border, a little beside it by rounding, and bodies that touch it are well within.
  constexpr double kMargin = 8;
  const double least = std::max(kFlattest * half.maxCoeff(), kSmallest);
  step = half.cwiseMax(least) / (kReach - kMargin);
  perStep = step.cwiseInverse();
}

PointGrid pointGrid(const SceneObjects& objects, const Box& bounds, const CancelPoint& cancelPoint)
{
  constexpr double kNear = 32, kInner = 16;
  const auto [center, spread] = middleOf(pointsOnSurfaces(objects, cancelPoint));
  Box near{ center, center }, inner = near;
  near.inflate(kNear * spread);
  inner.inflate(kInner * spread);
  const Eigen::Array<bool, 3, 1> isNear = isWithin(bounds, near);
  if (!(spread > 0) || isNear.all())
  {
    return PointGrid(bounds);
  }
  Box box = bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!isNear[axis])
    {
      box.lower[axis] = std::max(bounds.lower[axis], inner.lower[axis]);
      box.upper[axis] = std::min(bounds.upper[axis], inner.upper[axis]);
    }
  }
  for (const SceneObject& object : objects.dynamicObjects)
  {
    const Box its = object.worldBounds();
    if (!its.isEmpty() && isWithin(its, near).all())
    {
      box.add(its);
    }
  }
  return PointGrid(box);
}

}
