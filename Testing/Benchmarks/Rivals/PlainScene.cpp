// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/PlainScene.h"

#include "Surfaces/SceneObjects.h"

#include <cmath>
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

/// Twice as long as the area.
std::array<double, 3> cross(const PlainScene::Vector& u, const PlainScene::Vector& v)
{
  std::array<double, 3> product{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    product[i] = double(u[j]) * v[k] - double(u[k]) * v[j];
  }
  return product;
}

double lengthOf(const std::array<double, 3>& v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
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

PlainPatch makePatch(const PlainScene::Triangle& triangle, float offset)
{
  const auto& [a, b, c] = triangle;
  PlainPatch patch{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    patch.u[i] = b[i] - a[i];
    patch.v[i] = c[i] - b[i];
  }
  const std::array<double, 3> normal = cross(patch.u, patch.v);
  for (std::size_t i = 0; i < 3; ++i)
  {
    patch.normal[i] = static_cast<float>(normal[i] / lengthOf(normal));
    patch.origin[i] = a[i] + offset * patch.normal[i];
  }
  return patch;
}

double areaOf(const PlainPatch& patch)
{
  return 0.5 * lengthOf(cross(patch.u, patch.v));
}

std::vector<PlainSource> makeSources(const PlainScene& scene)
{
  const double total = scene.totalFlux();
  std::vector<PlainSource> sources;
  for (const PlainScene::Light& light : scene.lights)
  {
    const PlainPatch patch = makePatch(scene.triangles[light.triangle], scene.offset());
    sources.push_back({ patch, static_cast<float>(light.flux / total / areaOf(patch)) });
  }
  for (const PlainScene::PointLight& light : scene.pointLights)
  {
    sources.push_back({ { light.position, {}, {}, {} }, 0 });
  }
  return sources;
}

std::vector<double> fluxesOf(const PlainScene& scene)
{
  std::vector<double> fluxes;
  for (const PlainScene::Light& light : scene.lights)
  {
    fluxes.push_back(light.flux);
  }
  for (const PlainScene::PointLight& light : scene.pointLights)
  {
    fluxes.push_back(light.flux);
  }
  if (fluxes.empty())
  {
    throw std::invalid_argument("the plain rivals need a light");
  }
  return fluxes;
}
