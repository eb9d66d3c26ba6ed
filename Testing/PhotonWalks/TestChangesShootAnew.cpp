// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

namespace irradiance::test
{
namespace
{

struct Input
{
  SceneObjects objects;
  EngineSettings settings;
};

struct Change
{
  const char* name;
  std::function<void(Input&)> apply;
};

SceneObject lamp(double exitance)
{
  ObjectBuilder builder;
  builder.addBox(box({ 0, 0, 0 }, { 0.2, 0.2, 0.2 }), 1, grey(0.3, exitance));
  return builder.build(shift({ 3, 3, 1 }));
}

/// Changes between two frames, other than poses of objects that do not shine.
std::vector<Change> changes()
{
  const auto changeSurface = [](SceneObject& object, const auto& change) {
    auto surface = std::make_shared<Material>(*object.material);
    change(*surface);
    object.material = surface;
  };
  const auto changeLight = [](SceneObject& object, const auto& change) {
    auto emission = std::make_shared<Emission>(*object.emission);
    change(*emission);
    object.emission = emission;
  };
  return {
    { "moving emitter", [](Input& in) { in.objects.dynamicObjects.back().worldFromObject = {}; } },
    { "exitance", [](Input& in) { in.objects.dynamicObjects.back() = lamp(5); } },
    { "static reflectance",
      [=](Input& in) {
        changeSurface(in.objects.staticObject, [](Material& s) { s.reflectance[3] = 0.9; });
      } },
    { "dynamic reflectance",
      [=](Input& in) {
        changeSurface(in.objects.dynamicObjects[0], [](Material& s) { s.reflectance[0] = 0; });
      } },
    { "point light",
      [=](Input& in) {
        changeLight(in.objects.staticObject, [](Emission& e) { e.points[0].position[2] += 1e-3; });
      } },
    { "dimmed lamp",
      [=](Input& in) {
        changeLight(in.objects.dynamicObjects.back(), [](Emission& e) { e.exitance[0] *= 0.5; });
      } },
    { "static geometry",
      [](Input& in) { in.objects.staticObject = MovingScene(1, true, 1).objects().staticObject; } },
    { "object added",
      [](Input& in) { in.objects.dynamicObjects.push_back(in.objects.dynamicObjects[0]); } },
    { "object removed",
      [](Input& in) { in.objects.dynamicObjects.erase(in.objects.dynamicObjects.begin() + 1); } },
    { "objects swapped",
      [](Input& in) { std::swap(in.objects.dynamicObjects[0], in.objects.dynamicObjects[1]); } },
    { "object loose", [](Input& in) { in.objects.dynamicObjects[1].isFlattened = true; } },
    { "all objects gone", [](Input& in) { in.objects.dynamicObjects.clear(); } },
    { "seed", [](Input& in) { in.settings.seed = 77; } },
    { "number of walks", [](Input& in) { in.settings.numberOfWalks += 1; } },
    { "one walk", [](Input& in) { in.settings.numberOfWalks = 1; } },
    { "sides", [](Input& in) { in.settings.separateSides = true; } },
    { "no verification", [](Input& in) { in.settings.verify = false; } },
    { "cache off", [](Input& in) { in.settings.cacheStaticHits = false; } },
    { "one tree", [](Input& in) { in.settings.traversalMode = TraversalMode::OneTree; } },
    { "sequential", [](Input& in) { in.settings.traversalMode = TraversalMode::Sequential; } },
    { "darkness",
      [](Input& in) {
        in.objects.dynamicObjects.pop_back();
        in.objects.staticObject.emission = nullptr;
      } },
    { "bands", [](Input& in) { in.objects = MovingScene(3, false, 31).objects(); } },
  };
}

TEST(ChangesShootAnew, EveryChangeThereAndBackEqualsANewEngine)
{
  MovingScene scene(1, false, 31);
  UpdatedEngine engine;
  for (const Change& change : changes())
  {
    const SceneObject still = lamp(2);
    const auto expectFresh = [&](bool isChanged, const char* when) {
      Input in{ scene.objects(), Shoot(scaled(3000)) };
      in.objects.dynamicObjects.push_back(still);
      if (isChanged)
      {
        change.apply(in);
      }
      engine.update(in.objects, in.settings);
      EXPECT_TRUE(isAsFresh(engine)) << change.name << ", " << when;
    };
    expectFresh(false, "before");
    scene.nextFrame();
    expectFresh(false, "moved");
    expectFresh(true, "alone");
    expectFresh(false, "undone");
    scene.nextFrame();
    expectFresh(true, "in motion");
    expectFresh(true, "again");
    scene.nextFrame();
  }
}

}
}
