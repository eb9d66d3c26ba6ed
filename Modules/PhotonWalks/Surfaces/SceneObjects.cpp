// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/SceneObjects.h"

#include <algorithm>

namespace irradiance
{

void flattenManySmall(SceneObjects& objects)
{
  constexpr std::size_t kFewTriangles = 48;
  constexpr std::ptrdiff_t kMany = 128;
  const auto isSmall = [](const SceneObject& object) {
    return object.body->mesh().size() <= kFewTriangles;
  };
  std::vector<SceneObject>& all = objects.dynamicObjects;
  const bool areMany = std::count_if(all.begin(), all.end(), isSmall) >= kMany;
  for (SceneObject& object : all)
  {
    object.isFlattened = areMany && isSmall(object);
  }
}

bool hasMoved(const SceneObject& now, const SceneObject& before)
{
  return now.isPresent != before.isPresent ||
    (now.isPresent && (now.body != before.body || now.worldFromObject != before.worldFromObject));
}

bool isSameThing(const SceneObject& now, const SceneObject& before)
{
  return now.body == before.body && now.material == before.material &&
    now.emission == before.emission && now.lampCells == before.lampCells;
}

std::vector<double> cellAreas(const SceneObject& object, const CancelPoint& cancelPoint)
{
  std::vector<double> areas(object.material->numberOfCells, 0.0);
  const TriangleMesh& mesh = object.mesh();
  ThrottledCancelPoint pace(cancelPoint);
  for (std::size_t i = 0; i < mesh.size(); ++i)
  {
    areas[object.material->cellOfTriangle[i]] +=
      transformed(object.worldFromObject, mesh[i]).area();
    pace.step();
  }
  return areas;
}

double meanReflectance(const SceneObject& object)
{
  const std::vector<Triangle>& triangles = object.body->mesh().triangles();
  double area = 0, reflected = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const double its = triangles[i].area();
    reflected += its * object.material->keptOf(i);
    area += its;
  }
  return area > 0 ? reflected / area : 0;
}

}
