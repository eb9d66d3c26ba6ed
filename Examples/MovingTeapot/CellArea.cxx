// SPDX-License-Identifier: BSD-3-Clause
#include "CellArea.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolygon.h>

namespace movingteapot
{

double CellArea(vtkPolyData* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  if (ids->GetNumberOfIds() < 3)
  {
    return 0.0;
  }
  double normal[3];
  return vtkPolygon::ComputeArea(
    mesh->GetPoints(), ids->GetNumberOfIds(), ids->GetPointer(0), normal);
}

}
