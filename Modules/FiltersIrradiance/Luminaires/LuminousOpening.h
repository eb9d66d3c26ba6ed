// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Luminaires/IntensityTable.h"

#include <optional>
#include <string>
#include <vector>

namespace irradiance
{

/// What of a lamp shines: a body about the origin, or a flat face of it.
struct LuminousOpening
{
  enum class Shape
  {
    Point,
    Box,
    Cylinder,
    Ellipsoid
  };

  Shape shape = Shape::Point;
  int axis = 2;               ///< of a cylinder
  Vector3 size = { 0, 0, 0 }; ///< m, along x, y, z; 0 along the axis: flat

  /// Such as "vertical disc".
  std::string name() const;
};

/// What the signs of the dimensions in an IES file mean: those of its version, and of others where
/// they mean nothing there. Older codes are frequent in newer files.
std::optional<LuminousOpening> iesOpening(int year, double width, double length, double height);

using Facet = std::vector<Vector3>;

/// The faces that shine, counter-clockwise as seen from outside; none for a point.
std::vector<Facet> litFacets(const LuminousOpening& opening, const IntensityTable& table);

}
