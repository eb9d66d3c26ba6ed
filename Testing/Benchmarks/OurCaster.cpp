#include "OurCaster.h"

using namespace irradiance;

std::vector<SimdChoice> simdChoices()
{
  limitSimd(SimdLevel::Avx512);
  const SimdLevel best = simdLevel();
  std::vector<SimdChoice> choices = { { "", best } };
  for (const SimdChoice& lower :
    { SimdChoice{ ", AVX2", SimdLevel::Avx2 }, SimdChoice{ ", plain", SimdLevel::Plain } })
  {
    if (lower.level < best)
    {
      choices.push_back(lower);
    }
  }
  return choices;
}

OurCaster::OurCaster(std::string name, std::shared_ptr<const Scene> scene, const SimdChoice& choice)
  : Caster(name + choice.name)
  , scene_(std::move(scene))
  , choice_(choice)
{
}

void OurCaster::cast(std::vector<Hit>& hits)
{
  limitSimd(choice_.level);
  scene_->cast(rays_.data(), rays_.size(), hits.data());
}

std::shared_ptr<const Scene> makeScene(const SceneObjects& objects, TraversalMode mode)
{
  auto scene = std::make_shared<Scene>();
  scene->setTraversalMode(mode);
  scene->setStatic(objects.staticObject.body);
  scene->setDynamic(objects.dynamicBodies());
  scene->commit({});
  return scene;
}
