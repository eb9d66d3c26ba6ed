// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointGrid_h
#define irradiance_PointGrid_h

#include "Geometry/Vector.h"

namespace irradiance
{

/**
 * The grid to which the ends of stored segments are rounded, so that a coordinate takes 16 bits. Grid
 * coordinates of what lies in its box are within kReach of 0. Each axis has a step of its own, as a
 * hall is not as high as it is long.
 *
 * What lies outside is cut off (see placeOnGrid), so the box need not hold everything: it is best
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

}

#endif
