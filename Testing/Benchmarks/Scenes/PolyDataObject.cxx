// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/PolyDataObject.h"

#include "../../PhotonWalks/TestScenes.h"
#include "Meshes/PolygonTriangulation.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <stdexcept>

using namespace irradiance;

namespace
{

std::vector<Triangle> trianglesOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  std::vector<Vector3> corners;
  std::transform(ids->begin(), ids->end(), std::back_inserter(corners),
    [&](vtkIdType id) { return Vector3(mesh->GetPoint(id)); });
  std::vector<Triangle> triangles;
  if (!triangulate(corners, triangles))
  {
    throw std::runtime_error("a polygon crosses itself");
  }
  const auto isPoint = [](const Triangle& triangle) { return !(triangle.area() > 0); };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isPoint), triangles.end());
  return triangles;
}

}

std::vector<Triangle> trianglesOf(vtkPolyData* mesh)
{
  std::vector<Triangle> triangles;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const std::vector<Triangle> own = trianglesOf(mesh, cell);
    triangles.insert(triangles.end(), own.begin(), own.end());
  }
  return triangles;
}

SceneObject makeObject(const std::vector<vtkPolyData*>& parts)
{
  test::ObjectBuilder object;
  for (vtkPolyData* part : parts)
  {
    object.material().firstCellOfPart.push_back(object.material().numberOfCells);
    vtkDataArray* reflectance = part->GetCellData()->GetArray("DiffuseReflectance");
    vtkDataArray* exitance = part->GetCellData()->GetArray("RadiantExitance");
    for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
    {
      object.addCell(trianglesOf(part, cell),
        test::grey(reflectance ? reflectance->GetTuple1(cell) : 0.5,
          exitance ? exitance->GetTuple1(cell) : 0));
    }
  }
  return object.build();
}
