// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_OrderedCells_h
#define irradiance_OrderedCells_h

#include "vtkSmartPointer.h"

#include <cstdint>
#include <vector>

class vtkPolyData;

namespace irradiance
{

/// The cells of a piece and their arrays, each cell marked with the process that holds it.
vtkSmartPointer<vtkPolyData> markedPiece(vtkPolyData* piece, std::uint32_t rank);

/**
 * Orders cells of marked pieces: vertices, lines, polygons and strips, as polydata do; each of
 * these by global id, if there are such ids, by the coordinates of the points, and by process. So
 * cells of one place with one id alone depend on who held them. `cells`: where each cell of this
 * rank's piece has gone.
 */
vtkSmartPointer<vtkPolyData> orderedByPlace(
  vtkPolyData* marked, std::uint32_t rank, std::vector<std::size_t>& cells);

}

#endif
