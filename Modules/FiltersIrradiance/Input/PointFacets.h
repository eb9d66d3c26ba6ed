// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Input/PartCells.h"
#include "Photons/Sensor.h"
#include "Progress/CancelPoint.h"
#include "Surfaces/CellShapes.h"

#include "vtkType.h"

#include <vector>

class vtkPolyData;

namespace irradiance
{

/// Where a point of a surface receives light: on cells that meet there smoothly. At a crease a
/// point has several facets.
struct PointFacet
{
  vtkIdType point;
  /// On the front. It lies a little way from the edges of the facet, if it has some: a wall that
  /// meets the surface there is beside it, and does not cut through its hemisphere.
  Sensor front;
  double angle;                 ///< that the facet fills around the point, rad
  bool isFrontDark, isBackDark; ///< no light can come to it at all
};

/// The facets of all points, in the order of these; a point without polygons, or only with such
/// that have no area, has none.
///
/// Where the surface has point normals a point has one facet, with its normal, turned to the fronts
/// of the cells. Else cells belong to the first facet of the point whose normal is less than
/// `featureAngle` (rad) from theirs, or to one of their own; its normal is the mean of theirs,
/// weighted by their angles at the point.
///
/// `isMirrored`: fronts are where the corners run clockwise. `rounding`: of the coordinates, m: how
/// far from edges sensors lie at least. `cells`: those of the surface. `shapes`: see
/// darkShapesOf().
std::vector<PointFacet> pointFacetsOf(vtkPolyData* surface, bool isMirrored, double featureAngle,
  double rounding, const PartCells& cells, const CellShapes& shapes,
  const CancelPoint& cancelPoint);

}
