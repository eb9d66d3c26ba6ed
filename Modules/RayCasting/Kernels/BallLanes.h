// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BallLanes_h
#define irradiance_BallLanes_h

#include "Kernels/BodyBalls.h"
#include "Kernels/TreeRays.h"

#include <type_traits>

namespace irradiance
{

/**
 * The lines of 16 rays in the frame of BodyBalls: each by its point closest to the centre there, so
 * that floats serve wherever a ray begins. Documentation/Theory.md, section 3, derives what pays
 * for rounding.
 */
struct BallLanes
{
  static constexpr unsigned kSize = TreeRays::kLanes;
  /// Of the square of a radius.
  static constexpr double kWider = 0x1p-16;
  /// Of a ray that begins farther away, in the frame, that point is not exact enough: then all
  /// balls are near.
  static constexpr double kFarthest = 0x1p12;
  /// Likewise, of squared lengths of directions.
  static constexpr double kShortest = 0x1p-200, kLongest = 0x1p200;

  alignas(64) float point[3][kSize]; ///< times -2
  alignas(64) float direction[3][kSize];
  alignas(64) float square[kSize]; ///< of the point's distance

  /// Is compiled once for each instruction set.
  template <class Real>
  __attribute__((always_inline)) void place(
    const UnitFrame& frame, const double* const (&origins)[3], const Real* const (&directions)[3])
  {
    const double centerX = frame.center[0], centerY = frame.center[1], centerZ = frame.center[2],
                 scale = frame.scale;
    // The columns are not the lanes' own memory.
#pragma GCC ivdep
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const double ox = (origins[0][lane] - centerX) * scale,
                   oy = (origins[1][lane] - centerY) * scale,
                   oz = (origins[2][lane] - centerZ) * scale;
      const double dx = directions[0][lane], dy = directions[1][lane], dz = directions[2][lane];
      const double squaredLength = dx * dx + dy * dy + dz * dz;
      const double way = (ox * dx + oy * dy + oz * dz) / squaredLength;
      const double px = ox - way * dx, py = oy - way * dy, pz = oz - way * dz;
      // Directions in floats have length 1.
      const double length = std::is_same_v<Real, float> ? 1.0 : __builtin_sqrt(squaredLength);
      const double squaredDistance = ox * ox + oy * oy + oz * oz;
      point[0][lane] = static_cast<float>(-2 * px);
      point[1][lane] = static_cast<float>(-2 * py);
      point[2][lane] = static_cast<float>(-2 * pz);
      direction[0][lane] = static_cast<float>(dx / length);
      direction[1][lane] = static_cast<float>(dy / length);
      direction[2][lane] = static_cast<float>(dz / length);
      const bool isExact = (squaredDistance < kFarthest * kFarthest) & (squaredLength > kShortest) &
        (squaredLength < kLongest);
      square[lane] = isExact ? static_cast<float>(px * px + py * py + pz * pz) : -__builtin_inff();
    }
  }
};

}

#endif
