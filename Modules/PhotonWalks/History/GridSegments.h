// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GridSegments_h
#define irradiance_GridSegments_h

#include "History/PointGrid.h"

#include <cstddef>
#include <cstdint>

namespace irradiance
{

/// Columns of rays. All can be read up to kPadding places behind the last ray.
struct RayColumns
{
  static constexpr std::size_t kPadding = 8;

  const double* origin[3];
  const float* direction[3]; ///< unit vectors
  const double* distance;    ///< to the hit; infinite if there is none
};

/**
 * Segments on the grid. One that is not whole within the grid is cut where it enters and leaves;
 * one that misses the grid lies in a corner. Each end is within 1/2 + kBlur of its true place along
 * each axis, and what is cut off lies beyond kInner along some axis: Documentation/Theory.md.
 */
struct GridSegments
{
  static constexpr std::size_t kSize = 128;
  static constexpr double kBlur = 0x1p-5;
  static constexpr double kInner = PointGrid::kReach - 1;
  /// Farther away than this rounding is more than kBlur.
  static constexpr double kFarthest = 0x1p44;

  enum State : std::uint8_t
  {
    Whole,
    Cut,
    TooFar ///< where it lies is not known
  };

  std::int16_t ends[6][kSize]; ///< as in BouncePage
  std::uint8_t states[kSize];  ///< State
};

}

#endif
