// SPDX-License-Identifier: BSD-3-Clause
#include "Light/SceneObjects.h"

namespace irradiance
{

std::vector<double> cellAreas(const SceneObject& object, const Checkpoint& checkpoint)
{
  std::vector<double> areas(object.material->numberOfCells, 0.0);
  const TriangleMesh& mesh = object.body->mesh();
  CheckpointPace pace(checkpoint);
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    areas[object.material->cellOfTriangle[i]] +=
      0.5 * transformed(object.worldFromObject, mesh[i]).areaVector().norm();
    pace.step();
  }
  return areas;
}

}
