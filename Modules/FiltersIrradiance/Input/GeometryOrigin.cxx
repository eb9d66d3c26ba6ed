// SPDX-License-Identifier: BSD-3-Clause
#include "Input/GeometryOrigin.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

namespace irradiance
{

namespace
{

vtkInformationObjectBaseKey* originKey()
{
  static auto* const key = new vtkInformationObjectBaseKey("GEOMETRY_ORIGIN", "vtkKeyFramedPose");
  return key;
}

/// A filter may copy the note to an output with other geometry; then it is not valid.
bool isSameGeometry(vtkPolyData* a, vtkPolyData* b)
{
  return a->GetPoints() == b->GetPoints() && a->GetVerts() == b->GetVerts() &&
    a->GetLines() == b->GetLines() && a->GetPolys() == b->GetPolys() &&
    a->GetStrips() == b->GetStrips() && a->GetCellGhostArray() == b->GetCellGhostArray();
}

}

void notePassedGeometry(vtkPolyData* output, vtkPolyData* input)
{
  output->GetInformation()->Set(originKey(), originOfGeometry(input));
}

vtkPolyData* originOfGeometry(vtkPolyData* polyData)
{
  vtkInformation* info = polyData->GetInformation();
  auto* origin =
    info->Has(originKey()) ? vtkPolyData::SafeDownCast(info->Get(originKey())) : nullptr;
  return origin && isSameGeometry(origin, polyData) ? origin : polyData;
}

}
