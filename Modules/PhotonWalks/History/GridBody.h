// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EllipsoidBound.h"
#include "History/PointGrid.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace irradiance
{

/// A moved object. Point p of the grid is at matrix * p + offset in a frame where the object is
/// within a ball around 0, and in another where it is within the cube from -1 to 1.
struct GridBody
{
  float matrix[9]; ///< column by column
  float offset[3];
  float squaredRadius;
  bool hasBox = false;
  float boxMatrix[9], boxOffset[3];
  float face[3];  ///< twice the half-width of the cube along each axis, widened
  float slack[3]; ///< times the 1-norm of a segment: widens the cube across each axis
};

/**
 * The ball around a moved object that is small beside the grid, in the grid stretched to equal
 * steps along all axes, of at most 1. To test it takes a third of what its GridBody takes, and most
 * segments miss it.
 */
struct GridBall
{
  float center[3] = {};
  /// Infinite if the object is not small.
  float squaredRadius = std::numeric_limits<float>::infinity();
  /// In whole numbers of kLineUnit, for lines: see SegmentLines. Each number stands in both halves
  /// of its 32 bits, as lanes take it.
  std::uint32_t lineCenter[3] = {};
  std::uint32_t lineRadius = 0x7fff7fff; ///< if the object is not small: all lines are near

  static constexpr float kLineUnit = 4; ///< steps

  bool isSmall() const { return squaredRadius < std::numeric_limits<float>::infinity(); }
};

/// The box of a moved object in its own space, and where it is.
struct OwnBox
{
  Box box;
  AffineMap worldFromObject;
  double worldPad; ///< as of its EllipsoidBound
};

/// Widened by all that rounding may do to a segment on the grid and to its test in floats, see
/// Documentation/Theory.md. Nothing if floats would tell too little.
std::optional<GridBody> bodyOnGrid(const PointGrid& grid, const EllipsoidBound& bound);
GridBall ballOnGrid(const PointGrid& grid, const EllipsoidBound& bound);
/// Adds the object's own box to its body, unless floats would tell too little.
void addOwnBox(const PointGrid& grid, const OwnBox& own, GridBody& body);

}
