// SPDX-License-Identifier: BSD-3-Clause
#include "Data/CellAreas.h"

#include "Geometry/Vector.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellSizeFilter.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkTriangle.h"

#include <cmath>

namespace irradiance
{

namespace
{

/// That of a polygon in one plane, convex or not. vtkPolygon's has float's rounding in VTK 9.3.
double polygonArea(vtkPoints* points, vtkIdType count, const vtkIdType* ids)
{
  const auto corner = [&](vtkIdType i) {
    Vector3 point;
    points->GetPoint(ids[i], point.data());
    return point;
  };
  Vector3 twice = Vector3::Zero();
  for (vtkIdType i = 2; i < count; ++i)
  {
    twice += (corner(i - 1) - corner(0)).cross(corner(i) - corner(0));
  }
  return twice.norm() / 2;
}

double stripArea(vtkPoints* points, vtkIdType count, const vtkIdType* ids)
{
  double area = 0;
  for (vtkIdType i = 2; i < count; ++i)
  {
    double corners[3][3];
    for (vtkIdType corner = 0; corner < 3; ++corner)
    {
      points->GetPoint(ids[i - 2 + corner], corners[corner]);
    }
    area += vtkTriangle::TriangleArea(corners[0], corners[1], corners[2]);
  }
  return area;
}

/// vtkPolyData cannot give its cells one by one, and crashes in vtkCellSizeFilter, if one of them
/// has fewer points than its type needs.
std::vector<double> polyDataAreas(vtkPolyData* data)
{
  std::vector<double> areas(
    static_cast<std::size_t>(data->GetNumberOfVerts() + data->GetNumberOfLines()));
  const auto addAll = [&](vtkCellArray* cells, const auto& areaOf) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
      cells->GetCellAtId(i, count, ids);
      areas.push_back(count < 3 ? 0 : areaOf(data->GetPoints(), count, ids));
    }
  };
  addAll(data->GetPolys(), polygonArea);
  addAll(data->GetStrips(), stripArea);
  return areas;
}

std::vector<double> dataSetAreas(vtkDataSet* data)
{
  vtkNew<vtkCellSizeFilter> sizes;
  sizes->SetInputData(data);
  sizes->ComputeVertexCountOff();
  sizes->ComputeLengthOff();
  sizes->ComputeVolumeOff();
  sizes->Update();
  vtkDataArray* array =
    vtkDataSet::SafeDownCast(sizes->GetOutput())->GetCellData()->GetArray("Area");
  std::vector<double> areas;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    areas.push_back(array->GetComponent(i, 0));
  }
  return areas;
}

}

std::vector<double> cellAreas(vtkDataSet* data)
{
  auto* polyData = vtkPolyData::SafeDownCast(data);
  std::vector<double> areas = polyData ? polyDataAreas(polyData) : dataSetAreas(data);
  for (double& area : areas)
  {
    area = std::isfinite(area) ? std::abs(area) : 0;
  }
  return areas;
}

}
