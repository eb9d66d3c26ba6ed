// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/Caster.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>

using namespace irradiance;

namespace
{

vtkSmartPointer<vtkPolyData> makePolyData(const TriangleMesh& mesh)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Triangle& triangle : mesh.triangles())
  {
    cells->InsertNextCell({ points->InsertNextPoint(triangle.a.data()),
      points->InsertNextPoint(triangle.b.data()), points->InsertNextPoint(triangle.c.data()) });
  }
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  polyData->SetPolys(cells);
  return polyData;
}

}

Caster makeVtkCaster(const TriangleMesh& mesh)
{
  auto locator = vtkSmartPointer<vtkStaticCellLocator>::New();
  locator->SetDataSet(makePolyData(mesh));
  locator->BuildLocator();
  // From any place in the scene, everything is closer.
  const double length = 2 * mesh.bounds().extent().norm();
  return [locator, length](const std::vector<Ray>& rays) -> Cast {
    return [locator, length, rays](std::vector<Hit>& hits) {
      vtkNew<vtkGenericCell> cell;
      std::transform(rays.begin(), rays.end(), hits.begin(), [&](const Ray& ray) -> Hit {
        constexpr double kTolerance = 0;
        const Vector3 end = ray.origin + length * ray.direction;
        double t, point[3], parametric[3];
        int part;
        vtkIdType id;
        const bool isHit = locator->IntersectWithLine(
          ray.origin.data(), end.data(), kTolerance, t, point, parametric, part, id, cell);
        return isHit ? Hit{ t * length, { 0, static_cast<std::uint32_t>(id) } } : Hit{};
      });
    };
  };
}
