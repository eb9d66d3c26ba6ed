#include "Scenes/PolyDataObject.h"

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

void append(vtkPolyData* part, std::vector<Triangle>& triangles, Surface& surface)
{
  vtkDataArray* reflectance = part->GetCellData()->GetArray("DiffuseReflectance");
  vtkDataArray* exitance = part->GetCellData()->GetArray("RadiantExitance");
  surface.firstCellOfPart.push_back(surface.numberOfCells);
  vtkNew<vtkIdList> ids;
  std::vector<Vector3> corners;
  for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
  {
    part->GetCellPoints(cell, ids);
    corners.resize(static_cast<std::size_t>(ids->GetNumberOfIds()));
    std::transform(ids->begin(), ids->end(), corners.begin(),
      [&](vtkIdType id) { return Vector3(part->GetPoint(id)); });
    if (!triangulate(corners, triangles))
    {
      throw std::runtime_error("a polygon crosses itself");
    }
    triangles.erase(
      std::remove_if(triangles.begin() + static_cast<std::ptrdiff_t>(surface.cellOfTriangle.size()),
        triangles.end(), [](const Triangle& t) { return !(t.area() > 0); }),
      triangles.end());
    surface.cellOfTriangle.resize(
      triangles.size(), static_cast<std::uint32_t>(surface.numberOfCells));
    surface.reflectance.push_back(reflectance ? reflectance->GetTuple1(cell) : 0.5);
    surface.exitance.push_back(exitance ? exitance->GetTuple1(cell) : 0);
    ++surface.numberOfCells;
  }
}

}

std::vector<Triangle> trianglesOf(vtkPolyData* mesh)
{
  std::vector<Triangle> triangles;
  Surface unused;
  append(mesh, triangles, unused);
  return triangles;
}

SceneObject makeObject(const std::vector<vtkPolyData*>& parts)
{
  std::vector<Triangle> triangles;
  auto surface = std::make_shared<Surface>();
  for (vtkPolyData* part : parts)
  {
    append(part, triangles, *surface);
  }
  const auto isDark = [](double exitance) { return exitance == 0; };
  if (std::all_of(surface->exitance.begin(), surface->exitance.end(), isDark))
  {
    surface->exitance.clear();
  }
  return { std::make_shared<RigidObject>(TriangleMesh(std::move(triangles))), surface, {} };
}
