// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellPoints_h
#define irradiance_CellPoints_h

#include "FinalGather/GatherScene.h"
#include "Meshes/SurfacePoint.h"

#include <array>
#include <vector>

namespace irradiance
{

/// Points that fill the area of a cell evenly.
class CellPoints
{
public:
  /// `cell`: of the shapes.
  CellPoints(const GatherScene& scene, std::size_t cell);

  struct Point
  {
    SurfacePoint place; ///< on the front
    TriangleId id;
  };
  Point at(std::array<double, 2> u) const;

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
