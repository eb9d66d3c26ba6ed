// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/OurCaster.h"

using namespace irradiance;

std::shared_ptr<const Scene> makeScene(const SceneObjects& objects, TraversalMode mode)
{
  auto scene = std::make_shared<Scene>();
  scene->setTraversalMode(mode);
  scene->setStatic(objects.staticObject.body);
  scene->setDynamic(objects.dynamicBodies());
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
