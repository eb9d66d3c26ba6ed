// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AreaPoints_h
#define irradiance_AreaPoints_h

#include "Meshes/SurfacePoint.h"
#include "Surfaces/CellShapes.h"

#include <array>
#include <utility>
#include <vector>

namespace irradiance
{

/// Points that fill the area of a cell evenly.
class AreaPoints
{
public:
  /// `cell`: of the shapes; it has an area.
  AreaPoints(const CellShapes& shapes, const SceneTriangles& triangles, std::size_t cell);

  /// On the front, with its triangle. `u`: of the unit square.
  std::pair<SurfacePoint, TriangleId> at(std::array<double, 2> u) const;

private:
  struct Part
  {
    Triangle triangle;
    double area; ///< m2
    TriangleId id;
  };
  std::vector<Part> parts_;
  double area_ = 0; ///< m2
};

}

#endif
