// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Kernels/TreeQuery.h"
#include "Trees/KdBounds.h"

#include <cstddef>
#include <cstring>

namespace irradiance
{

/// Turns four rows of four numbers into four columns. Is compiled once for each instruction set.
template <class Number>
__attribute__((always_inline)) inline void transpose4(
  const Number* const (&rows)[4], Number* const (&columns)[4])
{
  typedef Number Four __attribute__((vector_size(4 * sizeof(Number))));
  Four a, b, c, d;
  std::memcpy(&a, rows[0], sizeof(Four));
  std::memcpy(&b, rows[1], sizeof(Four));
  std::memcpy(&c, rows[2], sizeof(Four));
  std::memcpy(&d, rows[3], sizeof(Four));
  // Within halves of two, then by halves: both are cheap in all instruction sets.
  const Four evenAb = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Four oddAb = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four evenCd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Four oddCd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  const Four first = __builtin_shufflevector(evenAb, evenCd, 0, 1, 4, 5);
  const Four second = __builtin_shufflevector(oddAb, oddCd, 0, 1, 4, 5);
  const Four third = __builtin_shufflevector(evenAb, evenCd, 2, 3, 6, 7);
  const Four fourth = __builtin_shufflevector(oddAb, oddCd, 2, 3, 6, 7);
  std::memcpy(columns[0], &first, sizeof(Four));
  std::memcpy(columns[1], &second, sizeof(Four));
  std::memcpy(columns[2], &third, sizeof(Four));
  std::memcpy(columns[3], &fourth, sizeof(Four));
}

/**
 * Prepares searches of 16 rays side by side. It is in double until a ray begins near the tree's
 * box; from there on numbers are about 1, and floats do. Documentation/Theory.md, section 3, shows
 * that no ray begins too late.
 */
template <class Real>
struct PrepareLanes
{
  static constexpr unsigned kSize = TreeRays::kLanes;
  /// Entries and exits are off by less than this part of themselves.
  static constexpr float kEntryError = 0x1p-21F;
  /// From farther away, in the frame, a ray would begin too early.
  static constexpr double kLargestOrigin = 0x1p12;
  /// For components of the direction, so that no quotient is rounded to a denormal number.
  static constexpr double kLeastDirection = 0x1p-60, kLargestDirection = 0x1p60;

  alignas(64) double origin[3][kSize]; ///< in the frame, not yet moved to the box
  alignas(64) float begin[3][kSize], direction[3][kSize], inverse[3][kSize], product[3][kSize];
  alignas(64) float limit[kSize], pad[kSize], behind[kSize];
  alignas(64) std::uint32_t skipped[kSize];
  alignas(64) std::int32_t isKept[kSize], isOther[kSize];

  /// Is compiled once for each instruction set.
  __attribute__((always_inline)) void prepare(const TriangleTree& tree,
    const double* const (&origins)[3], const Real* const (&directions)[3], const double* bounds)
  {
    constexpr float kFlattest = static_cast<float>(1 / TreeQuery::kSmallestComponent);
    const double lowerX = tree.bounds().lower[0], lowerY = tree.bounds().lower[1],
                 lowerZ = tree.bounds().lower[2], upperX = tree.bounds().upper[0],
                 upperY = tree.bounds().upper[1], upperZ = tree.bounds().upper[2];
    const double centerX = tree.frame().center[0], centerY = tree.frame().center[1],
                 centerZ = tree.frame().center[2], scale = tree.frame().scale;
    const float slack = static_cast<float>(tree.slack() + 2 * TreeQuery::kBlur);
    // The columns are not the lanes' own memory.
#pragma GCC ivdep
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double ox = (origins[0][lane] - centerX) * scale,
                   oy = (origins[1][lane] - centerY) * scale,
                   oz = (origins[2][lane] - centerZ) * scale;
      const Real dx = directions[0][lane], dy = directions[1][lane], dz = directions[2][lane];
      const Real largest = most(most(size(dx), size(dy)), size(dz));
      const float ix = static_cast<float>(largest / dx), iy = static_cast<float>(largest / dy),
                  iz = static_cast<float>(largest / dz);
      const float flattest = most(most(size(ix), size(iy)), size(iz));
      const float ax = static_cast<float>(lowerX - ox) * ix,
                  bx = static_cast<float>(upperX - ox) * ix,
                  ay = static_cast<float>(lowerY - oy) * iy,
                  by = static_cast<float>(upperY - oy) * iy,
                  az = static_cast<float>(lowerZ - oz) * iz,
                  bz = static_cast<float>(upperZ - oz) * iz;
      const float entry = most(most(least(ax, bx), least(ay, by)), least(az, bz));
      const float exit = least(least(most(ax, bx), most(ay, by)), most(az, bz));
      const float from = most(entry - kEntryError * size(entry), 0.0F);
      const float to = exit + kEntryError * size(exit);
      // Any number will do that is not too large: the place on the ray is exact.
      const double way = static_cast<double>(static_cast<Real>(from) / largest);
      const float px = static_cast<float>(ox + way * static_cast<double>(dx)),
                  py = static_cast<float>(oy + way * static_cast<double>(dy)),
                  pz = static_cast<float>(oz + way * static_cast<double>(dz));
      const float padding = static_cast<float>(TreeQuery::kBlur) * flattest;
      const float left =
        static_cast<float>((bounds[lane] * scale - way) * static_cast<double>(largest));
      const float end = left + (slack + 6 * padding);
      const double farthest = most(most(size(ox), size(oy)), size(oz));
      const bool isFollowed = (flattest <= kFlattest) & (farthest <= kLargestOrigin) &
        (largest >= static_cast<Real>(kLeastDirection)) &
        (largest <= static_cast<Real>(kLargestDirection));
      origin[0][lane] = ox;
      origin[1][lane] = oy;
      origin[2][lane] = oz;
      begin[0][lane] = px;
      begin[1][lane] = py;
      begin[2][lane] = pz;
      direction[0][lane] = static_cast<float>(dx / largest);
      direction[1][lane] = static_cast<float>(dy / largest);
      direction[2][lane] = static_cast<float>(dz / largest);
      inverse[0][lane] = ix;
      inverse[1][lane] = iy;
      inverse[2][lane] = iz;
      product[0][lane] = px * ix;
      product[1][lane] = py * iy;
      product[2][lane] = pz * iz;
      limit[lane] = least(end, static_cast<float>(TreeQuery::kFarthest));
      pad[lane] = 2 * padding;
      isKept[lane] = (isFollowed & (from <= to + padding) & (end >= 0)) ? 1 : 0;
      isOther[lane] = isFollowed ? 0 : 1;
    }
  }

  /// Writes the searches that are kept, and the rays that are for others. `first`: the ray in lane
  /// 0.
  __attribute__((always_inline)) void write(
    const TreeRays& rays, std::uint32_t first, FrontSearches& all)
  {
    const unsigned lanes = rays.count - first < kSize ? rays.count - first : kSize;
    std::int32_t behindAxis[kSize];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      behind[lane] = -__builtin_inff();
      behindAxis[lane] = 0;
      skipped[lane] =
        lane < lanes ? rays.skipped(first + lane, TriangleBlock::kNone) : TriangleBlock::kNone;
      if (skipped[lane] != TriangleBlock::kNone)
      {
        behindAxis[lane] = setBehind(lane, all.tree.planes().of(skipped[lane]));
      }
    }
    for (unsigned group = 0; group < lanes; group += 4)
    {
      PreparedQuery rows[4];
      turn(begin, limit, group, rows, 0);
      turn(direction, pad, group, rows, 4);
      turn(inverse, behind, group, rows, 8);
      turn(product, reinterpret_cast<const float*>(skipped), group, rows, 12);
      for (unsigned lane = group; lane < group + 4 && lane < lanes; ++lane)
      {
        rows[lane - group].ray = first + lane;
        rows[lane - group].behindAxis = behindAxis[lane];
        all.queries[all.count] = rows[lane - group];
        all.count += static_cast<std::uint32_t>(isKept[lane]);
        all.others[all.otherCount] = first + lane;
        all.otherCount += static_cast<std::uint32_t>(isOther[lane]);
      }
    }
  }

private:
  /// Sets what is behind the ray that leaves this plane, if any; returns the axis.
  __attribute__((always_inline)) std::int32_t setBehind(unsigned lane, const AxisPlane* plane)
  {
    if (!plane)
    {
      return 0;
    }
    const double side = __builtin_copysign(1.0, direction[plane->axis][lane]);
    const double place = side * plane->place;
    if (side * origin[plane->axis][lane] - place >= TreeQuery::kClearOfPlane)
    {
      behind[lane] = roundUp(place);
    }
    return plane->axis;
  }

  /// A row as its floats, from the first on.
  __attribute__((always_inline)) static float* floatsOf(PreparedQuery& row)
  {
    static_assert(offsetof(PreparedQuery, limit) == 3 * sizeof(float));
    static_assert(offsetof(PreparedQuery, skipped) == 15 * sizeof(float));
    return reinterpret_cast<float*>(&row);
  }

  /// Writes the three columns and the fourth, of four lanes, to each row from a float on.
  __attribute__((always_inline)) static void turn(const float (&columns)[3][kSize],
    const float* fourth, unsigned group, PreparedQuery (&rows)[4], unsigned to)
  {
    const float* const from[] = { columns[0] + group, columns[1] + group, columns[2] + group,
      fourth + group };
    float* const into[] = { floatsOf(rows[0]) + to, floatsOf(rows[1]) + to, floatsOf(rows[2]) + to,
      floatsOf(rows[3]) + to };
    transpose4<float>(from, into);
  }

  template <class Number>
  __attribute__((always_inline)) static Number most(Number a, Number b)
  {
    return a > b ? a : b;
  }
  template <class Number>
  __attribute__((always_inline)) static Number least(Number a, Number b)
  {
    return a < b ? a : b;
  }
  __attribute__((always_inline)) static float size(float a)
  {
    return __builtin_fabsf(a);
  }
  __attribute__((always_inline)) static double size(double a)
  {
    return __builtin_fabs(a);
  }
};

}
