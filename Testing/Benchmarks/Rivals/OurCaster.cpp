#include "Rivals/OurCaster.h"

using namespace irradiance;

std::shared_ptr<const Scene> makeScene(const SceneObjects& objects, TraversalMode mode)
{
  std::vector<PlacedObject> placed;
  for (const SceneObject& object : objects.dynamic)
  {
    placed.push_back({ object.body, object.worldFromObject, object.isLoose });
  }
  auto scene = std::make_shared<Scene>();
  scene->setTraversalMode(mode);
  scene->setStatic(objects.fixed.body);
  scene->setDynamic(placed);
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
