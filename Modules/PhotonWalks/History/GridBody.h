// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GridBody_h
#define irradiance_GridBody_h

#include "Ellipsoids/EllipsoidBound.h"
#include "History/PointGrid.h"

#include <optional>

namespace irradiance
{

/// A moved object. Point p of the grid is at matrix * p + offset in a frame where the object is within a
/// ball around 0, and in another where it is within the cube from -1 to 1.
struct GridBody
{
  float matrix[9]; ///< column by column
  float offset[3];
  float squaredRadius;
  /// For groups of segments: a segment within d steps of another comes within groupRadius + stretch * d of
  /// 0 there if the other is flagged.
  float groupRadius, stretch;
  bool hasBox = false;
  float boxMatrix[9], boxOffset[3];
  float face[3];  ///< twice the half-width of the cube along each axis, widened
  float slack[3]; ///< times the 1-norm of a segment: widens the cube across each axis
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
/// Adds the object's own box to its body, unless floats would tell too little.
void addOwnBox(const PointGrid& grid, const OwnBox& own, GridBody& body);

}

#endif
