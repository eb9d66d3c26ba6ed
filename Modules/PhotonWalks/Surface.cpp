#include "Surface.h"

namespace irradiance
{

std::vector<double> cellAreas(const SceneObject& object)
{
  std::vector<double> areas(object.surface->numberOfCells, 0.0);
  const TriangleMesh& mesh = object.body->mesh();
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    areas[object.surface->cellOfTriangle[i]] +=
      0.5 * transformed(object.worldFromObject, mesh[i]).areaVector().norm();
  }
  return areas;
}

}
