#include "OurCaster.h"

#include <algorithm>

using namespace irradiance;

namespace
{

void castAll(const Scene& scene, const Ray* rays, std::size_t count, Hit* hits)
{
  std::transform(rays, rays + count, hits, [&](const Ray& ray) { return scene.cast(ray); });
}

}

std::vector<SimdChoice> simdChoices()
{
  return { { "", [] {} } };
}

OurCaster::OurCaster(std::string name, std::shared_ptr<const Scene> scene, const SimdChoice& choice)
  : Caster(name + choice.name)
  , scene_(std::move(scene))
  , choice_(choice)
{
}

void OurCaster::cast(std::vector<Hit>& hits)
{
  choice_.take();
  castAll(*scene_, rays_.data(), rays_.size(), hits.data());
}

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
