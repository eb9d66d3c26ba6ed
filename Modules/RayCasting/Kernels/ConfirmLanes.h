// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ConfirmLanes_h
#define irradiance_ConfirmLanes_h

#include "Kernels/FrontStages.h"
#include "Kernels/IntersectionLanes.h"
#include "Simd/Prefetch.h"

namespace irradiance
{

/// Tests eight rays, next to each other in their columns, with a triangle each.
struct ConfirmLanes
{
  static constexpr unsigned kSize = IntersectionLanes::kSize;
  static_assert(TreeRays::kLanes % kSize == 0, "columns have room for the last ones");

  IntersectionLanes intersection;

  __attribute__((always_inline)) static void prefetch(
    std::uint32_t candidate, const CornerRows& corners)
  {
    const double* const row = corners.of(candidate == TreeRays::kNone ? 0 : candidate);
    prefetchLine(row);
    prefetchLine(row + 8);
  }

  /// Is compiled once for each instruction set, as all that follows.
  template <class Real>
  __attribute__((always_inline)) void setRays(
    const TreeRays& rays, std::uint32_t first, const Real* const (&directions)[3])
  {
    const double *ox = rays.origin[0] + first, *oy = rays.origin[1] + first,
                 *oz = rays.origin[2] + first;
    const Real *dx = directions[0] + first, *dy = directions[1] + first,
               *dz = directions[2] + first;
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      intersection.origin.x[lane] = ox[lane];
      intersection.origin.y[lane] = oy[lane];
      intersection.origin.z[lane] = oz[lane];
      intersection.direction.x[lane] = static_cast<double>(dx[lane]);
      intersection.direction.y[lane] = static_cast<double>(dy[lane]);
      intersection.direction.z[lane] = static_cast<double>(dz[lane]);
    }
  }

  /// Rays without a candidate are given the first triangle.
  __attribute__((always_inline)) void setTriangles(
    const std::uint32_t* candidate, const CornerRows& corners)
  {
    IntersectionLanes::Points &a = intersection.a, &b = intersection.b, &c = intersection.c;
    for (unsigned group = 0; group < kSize; group += 4)
    {
      const double* rows[4];
      for (unsigned lane = 0; lane < 4; ++lane)
      {
        const std::uint32_t some = candidate[group + lane];
        rows[lane] = corners.of(some == TreeRays::kNone ? 0 : some);
        c.z[group + lane] = rows[lane][8];
      }
      transpose4<double>({ rows[0], rows[1], rows[2], rows[3] },
        { a.x + group, a.y + group, a.z + group, b.x + group });
      transpose4<double>({ rows[0] + 4, rows[1] + 4, rows[2] + 4, rows[3] + 4 },
        { b.y + group, b.z + group, c.x + group, c.y + group });
    }
  }

  /// Keeps the hits that are closer than what the columns hold.
  __attribute__((always_inline)) void keep(
    const TreeRays& rays, std::uint32_t first, const std::uint32_t* candidate)
  {
    double* const distances = rays.distance + first;
    std::uint32_t* const hits = rays.hit + first;
    float *const weightsB = rays.weight[0] + first, *const weightsC = rays.weight[1] + first;
    const std::uint32_t firstNumber = rays.first;
    // The columns do not overlap.
#pragma GCC ivdep
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double distance = intersection.distance[lane], oldDistance = distances[lane];
      const std::uint32_t some = candidate[lane], number = firstNumber + some, oldHit = hits[lane];
      const float weightB = static_cast<float>(intersection.weightB[lane]),
                  weightC = static_cast<float>(intersection.weightC[lane]);
      const float oldB = weightsB[lane], oldC = weightsC[lane];
      // The distance is NaN where the ray misses.
      const bool isCloser = (some != TreeRays::kNone) & (distance > 0) &
        ((distance < oldDistance) | ((distance == oldDistance) & (number < oldHit)));
      distances[lane] = isCloser ? distance : oldDistance;
      hits[lane] = isCloser ? number : oldHit;
      weightsB[lane] = isCloser ? weightB : oldB;
      weightsC[lane] = isCloser ? weightC : oldC;
    }
  }
};

}

#endif
