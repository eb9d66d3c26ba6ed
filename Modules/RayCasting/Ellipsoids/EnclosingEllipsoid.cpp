// SPDX-License-Identifier: BSD-3-Clause
#include "Ellipsoids/EnclosingEllipsoid.h"

#include "Ellipsoids/PrincipalAxes.h"

#include <CGAL/Approximate_min_ellipsoid_d.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_3.h>
#include <CGAL/Quotient.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

// The smallest ellipsoid is affine-equivariant, but CGAL's arithmetic is not: an offset, a needle
// or a door makes it return nonsense marked as valid, or never return. So the points are first
// moved into a frame where they fill the cube [-1,1]^3, and CGAL's result is only a proposal: its
// size is measured against all points afterwards, with a bound on the rounding.
//
// CGAL sees only a few hundred points, the active ones. The ellipsoid of some of the points is
// never larger than the ellipsoid of all. So if the others stick out by a factor g, growing the
// ellipsoid by g costs at most g^3 in volume. While g is large, the points furthest out become
// active.

namespace irradiance
{
namespace
{

using Points = std::vector<Vector3>;

constexpr double kEpsilon = 0.01; // CGAL's accuracy: volume <= (1 + eps) * optimum
constexpr double kLargestCoordinate = 1e38;
constexpr double kUnitRoundoff = 0x1p-53;
constexpr std::size_t kFewPoints = 256;
constexpr int kMaxActivations = 60;
constexpr double kGoodGrowth = 1.001;

void requireUsable(const Points& points, ThrottledCancelPoint& pace)
{
  if (points.empty())
  {
    throw std::invalid_argument("encloseByEllipsoid: there is no point");
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pace.step();
    if (!(points[i].cwiseAbs().maxCoeff() <= kLargestCoordinate) || !points[i].allFinite())
    {
      throw std::invalid_argument("encloseByEllipsoid: point " + std::to_string(i) +
        " has a coordinate that is not finite or exceeds 1e38");
    }
  }
}

/// The points that CGAL sees: the active ones, and some that keep the set from being degenerate.
Points fullDimensional(const Points& active, const CubeFrame& frame)
{
  Points points = active;
  const Vector3 mean = std::accumulate(active.begin(), active.end(), Vector3(Vector3::Zero())) /
    static_cast<double>(active.size());
  for (int axis = 0; axis < 3; ++axis)
  {
    if (frame.isFlat[axis])
    {
      points.push_back(mean + Vector3::Unit(axis));
      points.push_back(mean - Vector3::Unit(axis));
    }
  }
  while (points.size() <= 4) // CGAL treats any four points as degenerate, even a tetrahedron
  {
    points.push_back(points.front());
  }
  return points;
}

/// In the cube frame.
std::optional<EnclosingEllipsoid> proposeByCgal(const Points& points)
{
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Approximate_min_ellipsoid_d_traits_3<Kernel, double>;
  std::vector<Kernel::Point_3> cgalPoints;
  cgalPoints.reserve(points.size());
  for (const Vector3& p : points)
  {
    cgalPoints.emplace_back(p[0], p[1], p[2]);
  }
  CGAL::Approximate_min_ellipsoid_d<Traits> solved(kEpsilon, cgalPoints.begin(), cgalPoints.end());
  if (!solved.is_full_dimensional())
  {
    return std::nullopt;
  }
  const Matrix3 matrix = Matrix3::NullaryExpr(
    [&](Eigen::Index i, Eigen::Index j) { return solved.defining_matrix(i, j); });
  const Vector3 vector =
    Vector3::NullaryExpr([&](Eigen::Index i) { return solved.defining_vector(i); });
  const Eigen::LLT<Matrix3> factor(matrix);
  if (!matrix.allFinite() || factor.info() != Eigen::Success)
  {
    return std::nullopt;
  }
  return EnclosingEllipsoid{ -0.5 * factor.solve(vector), factor.matrixU() };
}

/// The ellipsoid around `active` in the cube frame; falls back to the one around the cube.
EnclosingEllipsoid encloseInCube(const Points& active, const CubeFrame& frame)
{
  const EnclosingEllipsoid aroundCube{ Vector3::Zero(), Matrix3::Identity() / std::sqrt(3.0) };
  const Points points = fullDimensional(active, frame);
  std::optional<EnclosingEllipsoid> proposal = proposeByCgal(points);
  if (!proposal)
  {
    return aroundCube;
  }
  double reach = 0.0;
  for (const Vector3& point : points)
  {
    reach = std::max(reach, (proposal->shape * (point - proposal->center)).norm());
  }
  proposal->shape /= reach; // CGAL's own radius is up to (1 + eps)^1.5 too large in volume
  const double volumeOverCube = 1.0 / std::abs(proposal->shape.determinant());
  const double cubeEllipsoid = std::pow(3.0, 1.5);
  return volumeOverCube <= 1.01 * cubeEllipsoid ? *proposal : aroundCube;
}

EnclosingEllipsoid toModel(const EnclosingEllipsoid& ellipsoid, const CubeFrame& frame)
{
  const Matrix3 modelFromCube = frame.axes * frame.halfWidth.asDiagonal();
  const Matrix3 semiAxes = principalSemiAxes(modelFromCube * ellipsoid.shape.inverse());
  EnclosingEllipsoid result;
  result.center = frame.origin + modelFromCube * ellipsoid.center;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector3 semiAxis = semiAxes.col(axis);
    result.shape.row(axis) = (semiAxis / semiAxis.squaredNorm()).transpose();
  }
  return result;
}

/// How far the points are from the centre, in units of the ellipsoid's surface.
struct Reach
{
  double largest = 0.0;                // an upper bound that holds in exact arithmetic
  std::array<std::size_t, 8> furthest; // per octant of the ellipsoid's axes, its furthest point
  std::array<double, 8> distance;      // of that point; 0 if the octant has none
};

Reach measureReach(
  const EnclosingEllipsoid& ellipsoid, const Points& points, ThrottledCancelPoint& pace)
{
  Reach reach;
  reach.furthest.fill(0);
  reach.distance.fill(0.0);
  const Matrix3 absoluteShape = ellipsoid.shape.cwiseAbs();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pace.step();
    const Vector3 d = points[i] - ellipsoid.center;
    const Vector3 y = ellipsoid.shape * d;
    // d, the products and the sums are rounded at most four times; twelve covers the norms, too.
    const double error = 12.0 * kUnitRoundoff * (absoluteShape * d.cwiseAbs()).norm();
    const double distance = y.norm() + error;
    const int octant = (y[0] < 0.0 ? 1 : 0) + (y[1] < 0.0 ? 2 : 0) + (y[2] < 0.0 ? 4 : 0);
    reach.largest = std::max(reach.largest, distance);
    if (distance > reach.distance[octant])
    {
      reach.distance[octant] = distance;
      reach.furthest[octant] = i;
    }
  }
  return reach;
}

/// Up to 26 points that lie furthest along the axes, edges and corners of the cube.
std::vector<std::size_t> extremePoints(
  const Points& points, const CubeFrame& frame, ThrottledCancelPoint& pace)
{
  static const std::array<Vector3, 13> directions = { Vector3(1, 0, 0), Vector3(0, 1, 0),
    Vector3(0, 0, 1), Vector3(1, 1, 0), Vector3(1, -1, 0), Vector3(1, 0, 1), Vector3(1, 0, -1),
    Vector3(0, 1, 1), Vector3(0, 1, -1), Vector3(1, 1, 1), Vector3(1, 1, -1), Vector3(1, -1, 1),
    Vector3(-1, 1, 1) };
  std::array<std::size_t, 26> extreme{};
  std::array<double, 26> furthest;
  furthest.fill(-kInfinity);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    pace.step();
    const Vector3 x = frame.fromModel(points[i]);
    for (std::size_t k = 0; k < directions.size(); ++k)
    {
      const double along = directions[k].dot(x);
      for (const auto& [slot, value] : { std::pair(2 * k, along), std::pair(2 * k + 1, -along) })
      {
        if (value > furthest[slot])
        {
          furthest[slot] = value;
          extreme[slot] = i;
        }
      }
    }
  }
  return { extreme.begin(), extreme.end() };
}

/// Makes the points that stick out active; false if none is new.
bool activate(const Reach& reach, std::vector<std::size_t>& active)
{
  const std::size_t before = active.size();
  for (std::size_t octant = 0; octant < reach.furthest.size(); ++octant)
  {
    const std::size_t index = reach.furthest[octant];
    const bool isOutside = reach.distance[octant] > 1.0;
    if (isOutside && std::find(active.begin(), active.end(), index) == active.end())
    {
      active.push_back(index);
    }
  }
  return active.size() > before;
}

EnclosingEllipsoid proposeEllipsoid(
  const Points& points, const CubeFrame& frame, ThrottledCancelPoint& pace)
{
  std::vector<std::size_t> active = extremePoints(points, frame, pace);
  if (points.size() <= kFewPoints)
  {
    active.resize(points.size());
    std::iota(active.begin(), active.end(), std::size_t{ 0 });
  }
  for (int round = 0;; ++round)
  {
    Points inCube;
    for (const std::size_t index : active)
    {
      inCube.push_back(frame.fromModel(points[index]));
    }
    EnclosingEllipsoid proposal = toModel(encloseInCube(inCube, frame), frame);
    const Reach reach = measureReach(proposal, points, pace);
    if (reach.largest <= kGoodGrowth || round == kMaxActivations || !activate(reach, active))
    {
      return proposal;
    }
  }
}

/// The smallest multiple of the ellipsoid that provably contains the points.
EnclosingEllipsoid growAround(
  const Points& points, EnclosingEllipsoid ellipsoid, ThrottledCancelPoint& pace)
{
  constexpr int kMaxRounds = 20; // one or two are needed
  double reach = measureReach(ellipsoid, points, pace).largest;
  double margin = 4.0 * kUnitRoundoff;
  for (int round = 0; round < kMaxRounds; ++round)
  {
    // A single point is at the centre, at distance 0. It keeps the thickness of its frame.
    ellipsoid.shape /= std::max(0.5, reach * (1.0 + margin));
    reach = measureReach(ellipsoid, points, pace).largest;
    if (reach <= 1.0)
    {
      return ellipsoid;
    }
    margin *= 4.0;
  }
  throw std::logic_error("encloseByEllipsoid: no ellipsoid was found around finite points");
}

}

EnclosingEllipsoid encloseByEllipsoid(const Points& points, const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  requireUsable(points, pace);
  const CubeFrame frame = cubeFrame(points, cancelPoint);
  return growAround(points, proposeEllipsoid(points, frame, pace), pace);
}

}
