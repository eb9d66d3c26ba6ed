// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/DragonRoom.h"

#include "../../PhotonWalks/TestScenes.h"
#include "Scenes/BenchmarkScene.h"

#include <algorithm>

using namespace irradiance;

namespace
{

/// Some consecutive triangles make a cell. The last cell may have fewer.
void addCells(const TriangleMesh& mesh, std::size_t trianglesInCell, test::ObjectBuilder& object)
{
  const test::Look look = test::grey(0.5);
  for (std::size_t first = 0; first < mesh.size(); first += trianglesInCell)
  {
    std::vector<Triangle> cell;
    for (std::size_t i = first; i < std::min(first + trianglesInCell, mesh.size()); ++i)
    {
      cell.push_back(mesh[i]);
    }
    object.addCell(cell, look);
  }
}

}

std::optional<SceneObjects> makeDragonRoom()
{
  const std::optional<BenchmarkScene> scene = makeRoomScene(true);
  if (!scene)
  {
    return {};
  }
  test::ObjectBuilder room, dragon;
  addCells(scene->objects.staticObject.body->mesh(), 2, room);
  const auto& [center, edge] = scene->light;
  const Vector3 corner = center - 0.5 * edge * Vector3(1, 1, 0);
  room.addQuad(corner, { 0, edge, 0 }, { edge, 0, 0 }, 2, 2, test::grey(0.5, 100));
  const SceneObject& body = scene->objects.dynamicObjects[0];
  addCells(body.body->mesh(), 1, dragon);
  return SceneObjects{ room.build(), { dragon.build(body.worldFromObject) } };
}
