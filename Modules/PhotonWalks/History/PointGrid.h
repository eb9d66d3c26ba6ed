// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Progress/CancelPoint.h"

#include <cstddef>
#include <cstdint>

namespace irradiance
{

struct SceneObjects;

/**
 * The grid to which the ends of stored segments are rounded, so that a coordinate takes 16 bits.
 * Grid coordinates of what lies in its box are within kReach of 0. Each axis has a step of its own,
 * as a hall is not as high as it is long.
 *
 * What lies outside is cut off (see BounceLoops), so the box need not hold everything: it is best
 * drawn around what is near to most walks, and around what moves.
 */
struct PointGrid
{
  static constexpr double kReach = 32767;

  Vector3 center = Vector3::Zero();             ///< in the world
  Vector3 step = Vector3::Constant(1 / kReach); ///< length in the world from one place to the next
  Vector3 perStep = Vector3::Constant(kReach);  ///< 1 / step

  PointGrid() = default;
  explicit PointGrid(const Box& box);

  Vector3 operator()(const Vector3& world) const { return (world - center).cwiseProduct(perStep); }
  Vector3 world(const Vector3& place) const { return center + place.cwiseProduct(step); }
};

/// The grid of a scene: all of an ordinary one; where things are far away, what is near to most
/// surfaces, and what moves there. Documentation/Theory.md says how far. `bounds`: of all geometry
/// and point lights.
PointGrid pointGrid(
  const SceneObjects& objects, const Box& bounds, const CancelPoint& cancelPoint = {});

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
