// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainScene.h"

#include "Surfaces/SceneObjects.h"

#include <stdexcept>

using namespace irradiance;

namespace
{

PlainScene::Vector floats(const Vector3& point)
{
  return { static_cast<float>(point[0]), static_cast<float>(point[1]),
    static_cast<float>(point[2]) };
}

void add(const SceneObject& object, PlainScene& scene)
{
  const Material& material = *object.material;
  if (material.bands != 1)
  {
    throw std::invalid_argument("the plain rivals know only grey scenes");
  }
  const TriangleMesh& mesh = object.body->mesh();
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    const Triangle world = transformed(object.worldFromObject, mesh[i]);
    const std::uint32_t cell = material.cellOfTriangle[i];
    scene.triangles.push_back({ floats(world.a), floats(world.b), floats(world.c) });
    scene.surfaces.push_back({ static_cast<float>(material.reflectanceOf(i, 0)),
      static_cast<std::uint32_t>(scene.numberOfCells + cell) });
    const double* const exitance = object.exitanceOf(cell);
    const double flux = exitance ? *exitance * world.area() : 0;
    if (flux > 0)
    {
      scene.lights.push_back({ static_cast<std::uint32_t>(scene.triangles.size() - 1), flux });
    }
  }
  if (object.emission)
  {
    for (const PointSource& light : object.emission->points)
    {
      scene.pointLights.push_back(
        { floats(object.worldFromObject(light.position)), light.flux[0] });
    }
  }
  scene.numberOfCells += material.numberOfCells;
}

}

PlainScene makePlainScene(const SceneObjects& objects)
{
  PlainScene scene;
  Box bounds;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    add(objects[i], scene);
    bounds.add(objects[i].worldBounds());
  }
  scene.extent = static_cast<float>(bounds.extent().maxCoeff());
  return scene;
}
