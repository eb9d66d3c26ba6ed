// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/TriangleIntersection.h"
#include "Kernels/BodyBalls.h"
#include "Kernels/PrepareLanes.h"
#include "Simd/SimdLevel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiance
{

/// Eight intersections of a ray and a triangle, side by side.
struct IntersectionLanes
{
  static constexpr unsigned kSize = 8;

  struct alignas(64) Points
  {
    double x[kSize] = {}, y[kSize] = {}, z[kSize] = {};

    void set(unsigned lane, const Vector3& point)
    {
      x[lane] = point[0];
      y[lane] = point[1];
      z[lane] = point[2];
    }
    /// In the order of the ray.
    __attribute__((always_inline)) Intersection::Point ordered(
      unsigned lane, int axis, bool isFlipped) const
    {
      const double px = x[lane], py = y[lane], pz = z[lane];
      const double first = axis == 0 ? py : axis == 1 ? pz : px;
      const double second = axis == 0 ? pz : axis == 1 ? px : py;
      return { isFlipped ? second : first, isFlipped ? first : second,
        axis == 0     ? px
          : axis == 1 ? py
                      : pz };
    }
  };

  Points origin, direction, a, b, c;
  alignas(64) double distance[kSize] = {}; ///< NaN where the ray misses
  alignas(64) double weightB[kSize] = {}, weightC[kSize] = {};

  void set(
    unsigned lane, const Vector3& rayOrigin, const Vector3& rayDirection, const Triangle& triangle)
  {
    origin.set(lane, rayOrigin);
    direction.set(lane, rayDirection);
    a.set(lane, triangle.a);
    b.set(lane, triangle.b);
    c.set(lane, triangle.c);
  }

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void intersect()
  {
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double steepX = std::abs(direction.x[lane]), steepY = std::abs(direction.y[lane]);
      const bool isYSteeper = steepY > steepX;
      const bool isZ = std::abs(direction.z[lane]) > (isYSteeper ? steepY : steepX);
      const int axis = isZ ? 2 : isYSteeper ? 1 : 0;
      const bool isFlipped = (isZ             ? direction.z[lane]
                                 : isYSteeper ? direction.y[lane]
                                              : direction.x[lane]) < 0;
      const Intersection intersection(origin.ordered(lane, axis, isFlipped),
        direction.ordered(lane, axis, isFlipped), a.ordered(lane, axis, isFlipped),
        b.ordered(lane, axis, isFlipped), c.ordered(lane, axis, isFlipped));
      distance[lane] =
        intersection.isHit ? intersection.distance : std::numeric_limits<double>::quiet_NaN();
      weightB[lane] = intersection.weightB;
      weightC[lane] = intersection.weightC;
    }
  }
};

/// The stages of a cast in one tree, compiled for one instruction set. All find the same hits, bit
/// for bit.
struct FrontStages
{
  /// Writes the rays that may touch the ellipsoid to `picked`, with room for all; returns their
  /// number.
  std::uint32_t (*pick)(const TreeRays& rays, const EllipsoidFilter& filter, std::uint32_t* picked);
  /// Writes which rays may touch which ball to `found`, with room for as many for every kLeastLanes
  /// rays as there are balls; returns their number. More may be near than the ellipsoids let pass.
  std::uint32_t (*findNear)(const TreeRays& rays, const BodyBalls& balls, NearRays* found);
  /// Sets the queries and the other rays.
  void (*prepare)(const TreeRays& rays, FrontSearches& searches);
  void (*search)(FrontSearches& searches);
  /// Tests the triangle `candidate[i]`, unless it is kNone, for each ray i, and keeps the closer
  /// hits.
  void (*confirm)(const TreeRays& rays, const std::uint32_t* candidate, const CornerRows& corners);
  void (*intersect)(IntersectionLanes& lanes);
};

const FrontStages& frontStagesPlain();
const FrontStages& frontStagesAvx2();
const FrontStages& frontStagesAvx512();
/// By the best instructions of the machine.
inline const FrontStages& frontStages()
{
  return IRRADIANCE_CALL_BEST(frontStages, );
}

/// Tests so many rays with a triangle each, eight at a time, and keeps the closer hits. set(i,
/// lanes, lane) sets a lane to the i-th test, and returns its ray and the triangle's number.
template <class Set>
void confirmEach(const TreeRays& rays, std::size_t count, const Set& set)
{
  constexpr std::size_t kSize = IntersectionLanes::kSize;
  IntersectionLanes lanes;
  FurtherCandidate tests[kSize];
  for (std::size_t first = 0; first < count; first += kSize)
  {
    const auto some = static_cast<unsigned>(std::min(count - first, kSize));
    for (unsigned lane = 0; lane < some; ++lane)
    {
      tests[lane] = set(first + lane, lanes, lane);
    }
    frontStages().intersect(lanes);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      rays.keepCloser(tests[lane].ray, tests[lane].reference, lanes.distance[lane],
        lanes.weightB[lane], lanes.weightC[lane]);
    }
  }
}

/// Searches for one of the rays that floats cannot follow, all in double. The tree must not be
/// empty.
void searchExactly(
  const TriangleTree& tree, const TreeRays& rays, std::uint32_t ray, FrontTester& tester);

}
