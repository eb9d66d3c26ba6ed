#include "LocatorCaster.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

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

LocatorCaster::LocatorCaster(std::string name, const TriangleMesh& mesh)
  : Caster(std::move(name))
  , length_(2 * mesh.bounds().extent().norm())
{
  locator_->SetDataSet(makePolyData(mesh));
  locator_->BuildLocator();
}

LocatorCaster::~LocatorCaster() = default;

void LocatorCaster::setRays(const std::vector<Ray>& rays)
{
  segments_.clear();
  for (const Ray& ray : rays)
  {
    segments_.push_back({ ray.origin, ray.origin + length_ * ray.direction });
  }
}

void LocatorCaster::cast(std::vector<Hit>& hits)
{
  vtkNew<vtkGenericCell> cell;
  for (std::size_t i = 0; i < segments_.size(); ++i)
  {
    constexpr double kTolerance = 0;
    double t, point[3], parametric[3];
    int part;
    vtkIdType id;
    const bool isHit = locator_->IntersectWithLine(segments_[i].from.data(), segments_[i].to.data(),
      kTolerance, t, point, parametric, part, id, cell);
    hits[i] = isHit ? Hit{ t * length_, { 0, static_cast<std::uint32_t>(id) } } : Hit{};
  }
}
