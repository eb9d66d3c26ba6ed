// SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch lamps exactly: dark inside, and updates equal rebuilds while they come and go.

#include "EngineRun.h"
#include "TestScenes.h"
#include "ThreadExecution.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

namespace irradiance
{

using test::answerOf;
using test::freshAnswer;
using test::ObjectBuilder;
using test::wattsOn;

namespace
{

/// A light table of 2 m in the middle of a floor of 6 m, all at z = 0, a lamp in the lid of a box
/// that stands on the floor, and a ceiling.
SceneObject makeFloor()
{
  ObjectBuilder floor;
  floor.addQuad({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 }, 3, 3, test::grey(0.3));
  floor.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 5, 5, test::grey(0.5, 10));
  floor.addBox(test::box({ 1.5, 1.5, 0 }, { 2.5, 2.5, 1 }), 2, test::grey(0.6));
  floor.addQuad({ 1.75, 1.75, 1 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, 1, 1, test::grey(0.5, 20));
  floor.addQuad({ -3, -3, 3 }, { 0, 6, 0 }, { 6, 0, 0 }, 3, 3, test::grey(0.8));
  return floor.build();
}

SceneObject makeBox(double size)
{
  ObjectBuilder builder;
  builder.addBox(test::box({ 0, 0, 0 }, { size, size, size }), 2, test::grey(0.7));
  return builder.build();
}

/// Poses that touch, nearly touch, and do not touch.
class RandomPoses
{
public:
  void move(SceneObject& object)
  {
    const double x = 0.25 * step(-6, 8), y = 0.25 * step(-6, 8);
    const double heights[] = { 0, 0, 1e-11, 0.5, 1 };
    const Eigen::AngleAxisd turn(0.25 * M_PI * step(0, 3), Vector3::UnitZ());
    object.worldFromObject = { turn.toRotationMatrix(), Vector3(x, y, heights[step(0, 4)]) };
  }
  int step(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

private:
  std::mt19937_64 random_{ 5 };
};

}

TEST(Contacts, UpdatesEqualRebuilds)
{
  SceneObjects objects{ makeFloor(), { makeBox(0.5), makeBox(0.5), makeBox(1) } };
  RandomPoses poses;
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(6000);
  settings.separateSides = true;
  EngineSettings uncached = settings;
  uncached.cacheStaticHits = false;
  IrradianceEngine serial, threaded;
  Execution one;
  test::ThreadExecution three(3);
  for (int frame = 0; frame < (test::kIsSanitized ? 20 : 60); ++frame)
  {
    for (SceneObject& object : objects.dynamicObjects)
    {
      if (frame == 0 || poses.step(0, 2) > 0)
      {
        poses.move(object);
      }
    }
    serial.update(objects, settings, one);
    threaded.update(objects, uncached, three);
    const test::Answer fresh = freshAnswer(objects, settings);
    ASSERT_EQ(answerOf(serial, objects, true), fresh) << "frame " << frame;
    ASSERT_EQ(answerOf(threaded, objects, true), fresh) << "frame " << frame;
  }
}

TEST(Contacts, OnABudgetToo)
{
  SceneObjects objects{ makeFloor(), { makeBox(0.5), makeBox(0.5), makeBox(1) } };
  RandomPoses poses;
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(6000);
  EngineSettings hasty = settings;
  hasty.repairTimeBudget = 1e-9; // a few walks per frame
  IrradianceEngine engine;
  Execution one;
  for (int frame = 0; frame < (test::kIsSanitized ? 10 : 30); ++frame)
  {
    for (SceneObject& object : objects.dynamicObjects)
    {
      poses.move(object);
    }
    engine.update(objects, hasty, one);
    if (frame % 4 == 3)
    {
      engine.update(objects, settings, one);
      ASSERT_EQ(answerOf(engine, objects), freshAnswer(objects, settings)) << "frame " << frame;
    }
  }
}

// Two lamps so close that either may count as the upper one, and a sheet over them that coincides
// with only one. Which lamp receives a photon depends on the sheet even where it is not hit.
TEST(Contacts, ASheetThatIsNotHitMatters)
{
  constexpr double margin = 0x1p-33; // SurfacePoint's, for coordinates up to 1
  ObjectBuilder lamps;
  lamps.addQuad({ -1, -1, -margin }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, test::grey(0.5, 1));
  lamps.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, test::grey(0.5, 1));
  lamps.addQuad({ -1, -1, 0.5 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0.5, 10));
  ObjectBuilder sheet;
  sheet.addQuad({ -1, -1, 1.8 * margin }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, test::grey(0.5));
  SceneObjects objects{ lamps.build(), { sheet.build() } };
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(5000);
  IrradianceEngine engine;
  Execution one;
  std::int64_t received = 0;
  for (const double x : { 0.0, 5.0, 0.0, 0.5, 5.0 })
  {
    objects.dynamicObjects[0].worldFromObject = test::shift({ x, 0, 0 });
    engine.update(objects, settings, one);
    ASSERT_EQ(answerOf(engine, objects), freshAnswer(objects, settings)) << "at " << x;
    const double upper = engine.sums().sum({ 0, 1 }, 0);
    EXPECT_NE(upper, received); // so it does matter
    received = upper;
  }
}

// A shutter moves in front of a lamp in a ceiling and away again; a plate lies behind the ceiling.
// The hit that the shutter hides is not one of the static tree alone, so it is not cached.
TEST(Contacts, AShutterBeforeALampInACeiling)
{
  ObjectBuilder room, shutter, plate;
  room.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, test::grey(0.5, 10));
  room.addQuad({ -1, -1, 1 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0.5));
  room.addQuad({ -1, -1, 1 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0.5, 1));
  shutter.addQuad({ -1, -1, 0.5 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, test::grey(0.5));
  plate.addQuad({ -9, -9, 2 }, { 18, 0, 0 }, { 0, 18, 0 }, 1, 1, test::grey(0.5));
  SceneObjects objects{ room.build(), { shutter.build(), plate.build() } };
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(5000);
  Execution one;
  for (const bool isGathered : { false, true })
  {
    settings.gathersDirectLight = isGathered;
    IrradianceEngine engine;
    for (const double x : { 5.0, 0.0, 5.0, 1.0, 5.0 })
    {
      objects.dynamicObjects[0].worldFromObject = test::shift({ x, 0, 0 });
      engine.update(objects, settings, one);
      ASSERT_EQ(answerOf(engine, objects), freshAnswer(objects, settings)) << "at " << x;
    }
  }
}

// However a box on the table is turned, it is dark inside and receives the light from under it.
TEST(Contacts, NoLightGetsInside)
{
  SceneObjects objects{ makeFloor(), { makeBox(0.5) } };
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(100000);
  settings.separateSides = true;
  Execution one;
  for (const auto& [angle, isGathered] : { std::pair(0.0, false), std::pair(0.3, false),
         std::pair(1.1, false), std::pair(0.0, true), std::pair(0.3, true), std::pair(1.1, true) })
  {
    settings.gathersDirectLight = isGathered;
    const Eigen::AngleAxisd turn(angle, Vector3::UnitZ());
    objects.dynamicObjects[0].worldFromObject = { turn.toRotationMatrix(), Vector3(-0.3, -0.2, 0) };
    IrradianceEngine engine;
    engine.update(objects, settings, one);
    for (std::size_t cell = 0; cell < 24; ++cell)
    {
      EXPECT_EQ(engine.sums().sum({ 1, cell, 1 }, 0), 0) << "angle " << angle << ", cell " << cell;
    }
    // Interreflection between .5 and .7: 10 / .65 W/m2 on 0.25 m2. With about 5,000 photons, chance
    // exceeds 10 % in 1 of 10^9 runs (with sanitizers, 35 %).
    const double received = wattsOn(engine, 1, 16, 20);
    EXPECT_NEAR(received, 0.25 * 10 / 0.65, (test::kIsSanitized ? 0.35 : 0.1) * 0.25 * 10 / 0.65);
  }
}

// A closed lamp stands in the middle of a floor that is one cell. A third of what arrives directly
// on the floor comes from under the lamp; its samples have to find that. In 40 runs the sum of all
// samples had a standard deviation of 1.6 % (17 % with points chosen on the floor alone); 5 of
// these are exceeded in 1 of 10^6 runs.
TEST(Contacts, ALargeCellFindsTheSmallLampThatStandsOnIt)
{
  ObjectBuilder room;
  room.addBox(test::box({ 0, 0, 0 }, { 3, 3, 3 }), 1, test::grey(0.5), true);
  room.addBox(test::box({ 1.25, 1.25, 0 }, { 1.75, 1.75, 0.5 }), 1, test::grey(0.5, 10));
  const SceneObjects objects{ room.build(), {} };
  constexpr double kWatts = 6 * 0.25 * 10;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
  {
    EngineSettings settings;
    settings.numberOfWalks = test::scaled(20000);
    settings.seed = seed;
    settings.gathersDirectLight = true;
    Execution one;
    IrradianceEngine engine;
    engine.update(objects, settings, one);
    EXPECT_NEAR(
      engine.watts(engine.balance().escaped.total()), 0, (test::kIsSanitized ? 0.3 : 0.08) * kWatts)
      << "seed " << seed;
  }
}

}
