#include "Rivals/OurCaster.h"

using namespace irradiance;

std::vector<PlacedObject> placedObjects(const SceneObjects& objects)
{
  std::vector<PlacedObject> placed;
  for (const SceneObject& object : objects.dynamic)
  {
    placed.push_back({ object.body, object.worldFromObject, object.isLoose });
  }
  return placed;
}

std::shared_ptr<const Scene> makeScene(const SceneObjects& objects, TraversalMode mode)
{
  auto scene = std::make_shared<Scene>();
  scene->setTraversalMode(mode);
  scene->setStatic(objects.fixed.body);
  scene->setDynamic(placedObjects(objects));
  scene->commit({});
  return scene;
}

Caster makeOurCaster(std::shared_ptr<const Scene> scene, SimdLevel level)
{
  return [=](const std::vector<Ray>& rays) -> Cast {
    return [=](std::vector<Hit>& hits) {
      limitSimd(level);
      scene->cast(rays.data(), rays.size(), hits.data());
    };
  };
}
