// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellArea_h
#define CellArea_h

#include <vtkType.h>

class vtkPolyData;

namespace movingteapot
{

/** Area of a polygon, in m2 where the points are in m. */
double CellArea(vtkPolyData* mesh, vtkIdType cell);

}

#endif
