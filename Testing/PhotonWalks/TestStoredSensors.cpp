// SPDX-License-Identifier: BSD-3-Clause
// Sensors whose rays are kept: the bits of new ones after any program of changes, and how many rays
// are cast.

#include "Views/StoredSensors.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// In and around a room, on its floor, or too far away.
Sensor anySensor(RandomVectors& random)
{
  Vector3 place = Vector3(2, 2, 2) + 2.2 * random.inCube();
  const auto kind = random.engine() % 8;
  place[2] = kind == 0 ? 0 : kind == 1 ? 1e8 : place[2];
  return { place,
    kind < 3     ? Vector3(Vector3::UnitZ())
      : kind < 5 ? Vector3(Vector3::Zero())
                 : Vector3(random.inCube().normalized()) };
}

/// Moves some at random; now and then there are more, or fewer.
void change(std::vector<Sensor>& sensors, RandomVectors& random)
{
  const std::size_t first = random.engine() % 40, step = 1 + random.engine() % 30;
  for (std::size_t i = first; i < sensors.size(); i += step)
  {
    sensors[i] = anySensor(random);
  }
  if (random.engine() % 3 == 0)
  {
    sensors.resize(50 + random.engine() % 60, anySensor(random));
  }
}

// Law 1 for random programs: things move, sensors do, come and go, settings change, in any order.
TEST(StoredSensors, EqualNewOnesAfterRandomPrograms)
{
  for (const unsigned program : { 1u, 2u })
  {
    MovingScene scene(program == 2 ? 3 : 1, false, 40 + program);
    RandomVectors places(program);
    std::vector<Sensor> sensors(90);
    std::generate(sensors.begin(), sensors.end(), [&] { return anySensor(places); });
    EngineSettings settings = Shoot(2000).gathered(program == 2).errors(program == 2 ? 4 : 1);
    std::uint32_t rays = 16;
    const auto engine = std::make_shared<IrradianceEngine>();
    ThreadExecution two(2);
    StoredSensors stored;
    std::mt19937 random(program);
    std::int64_t fewest = 1000000;
    for (int step = 0; step < (kIsSanitized ? 5 : 12); ++step)
    {
      const auto what = random() % 8;
      what < 6 ? scene.nextFrame() : void();
      what > 3 ? change(sensors, places) : void();
      what == 1 ? void(rays = 35 - rays) : void();
      what == 2 ? void(++settings.seed) : void();
      const bool keepsRays = random() % 8 != 0;
      engine->update(scene.objects(), settings, two);
      stored.update(engine, sensors, rays, keepsRays, two);
      ASSERT_TRUE(areSame(stored.lights(), gathered(scene.objects(), settings, sensors, rays)))
        << "program " << program << ", step " << step << ", change " << what;
      EXPECT_EQ(stored.bytes() > 0, keepsRays);
      fewest = std::min(fewest, stored.numberCast());
    }
    EXPECT_LT(fewest, 90 * 2 * 16 * (kIsSanitized ? 0.75 : 0.5)) << "some rays were kept";
  }
}

/// Walls that shine alike, and a ball of radius .3, 1 m from the middle.
struct BallInFurnace
{
  std::shared_ptr<IrradianceEngine> engine = std::make_shared<IrradianceEngine>();
  SceneObjects objects;

  BallInFurnace()
  {
    ObjectBuilder room;
    room.addBox(box({ -1.5, -1.5, -1.5 }, { 1.5, 1.5, 1.5 }), 3, grey(0.5, 0.5), true);
    objects = { room.build(), { ball({ 1, 0, 0 }, 0.3, 16) } };
    update();
  }
  void update()
  {
    ThreadExecution two(2);
    engine->update(objects, Shoot(scaled(24000)).bySide(), two);
  }
};

// Seen from the middle the ball fills the share (1 - sqrt(1 - .09)) / 2 of all directions before
// and after, and paths as well as rays to the lights, which are all around, go evenly in all
// directions. 376 rays, of which chance would have it that they are 20 % off in 10,000 cases; the
// ball's triangles fill 3 % less.
TEST(StoredSensors, OnlyRaysThatMeetWhatMovedAreCast)
{
  BallInFurnace scene;
  Execution serial;
  StoredSensors stored;
  const std::vector<Sensor> sensors{ { Vector3::Zero(), Vector3::Zero() } };
  const std::uint32_t rays = 4096;
  stored.update(scene.engine, sensors, rays, true, serial);
  EXPECT_EQ(stored.numberCast(), 2 * rays);
  scene.update();
  stored.update(scene.engine, sensors, rays, true, serial);
  EXPECT_EQ(stored.numberCast(), 0) << "nothing moved";
  scene.objects.dynamicObjects[0].worldFromObject = shift({ -1, 0, 0 });
  scene.update();
  stored.update(scene.engine, sensors, rays, true, serial);
  const double expected = 2 * 2 * rays * (1 - std::sqrt(1 - 0.3 * 0.3)) / 2;
  EXPECT_NEAR(static_cast<double>(stored.numberCast()), expected, 0.2 * expected);
}

// Of two sensors one moves: it alone casts. The other keeps its light.
TEST(StoredSensors, OnlySensorsThatMovedCast)
{
  const BallInFurnace scene;
  Execution serial;
  for (const bool keepsRays : { true, false })
  {
    StoredSensors stored;
    std::vector<Sensor> sensors(2, { Vector3::Zero(), Vector3::UnitZ() });
    stored.update(scene.engine, sensors, 64, keepsRays, serial);
    const SensorFinalGather::Light first = stored.lights()[0];
    const std::int64_t all = stored.numberCast();
    sensors[1].position = { 0.1, 0, 0 };
    stored.update(scene.engine, sensors, 64, keepsRays, serial);
    EXPECT_NEAR(static_cast<double>(stored.numberCast()), static_cast<double>(all) / 2, 10);
    EXPECT_EQ(stored.lights()[0].value, first.value);
    stored.update(scene.engine, { sensors[0] }, 64, keepsRays, serial);
    EXPECT_EQ(stored.numberCast(), 0);
    EXPECT_EQ(stored.lights().size(), 1u);
  }
}

// Near a wall paths ask the lights where they hit. What stops these rays is of use only to who
// keeps paths.
TEST(StoredSensors, RaysOfLightsAreKeptOnlyForFramesToCome)
{
  const BallInFurnace scene;
  Execution serial;
  for (const bool keepsRays : { true, false })
  {
    const SensorFinalGather gather(*scene.engine, kRays, serial, keepsRays);
    SensorFinalGather::Rays rays;
    std::int64_t cast = 0;
    gather.update({ { { 0, 0, -1.3 }, -Vector3::UnitZ() } }, { 0 }, nullptr, rays, cast);
    std::ptrdiff_t shadows = 0;
    for (std::size_t path = 0; path < rays.paths.size(); ++path)
    {
      shadows += rays.paths[path].endOfShadows - rays.paths[path].shadows;
    }
    EXPECT_EQ(shadows > 0, keepsRays);
  }
}

}
}
