// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "MovingScene.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace irradiance
{

namespace
{

using test::WalkSegment;

using test::MovingScene;
using test::scaled;

/// The power that all cells receive, and the balance, recounted from walks shot one by one.
struct Recount
{
  Power received, emitted, escaped;
  std::int64_t segments = 0;
};

Recount recount(const SceneObjects& objects, const EngineSettings& settings)
{
  const LightTable lights(objects, settings.numberOfWalks);
  Scene scene;
  scene.setStatic(objects.staticObject.body);
  scene.setDynamic(objects.dynamicBodies());
  scene.setPointSources(lights.boundsInAir());
  scene.commit({});
  const SobolSequence samples(settings.seed);
  const SceneTriangles triangles(objects);
  const WalkTracer tracer(scene, objects, triangles, lights, samples);
  Recount result;
  for (std::uint32_t walk = 0; walk < settings.numberOfWalks; ++walk)
  {
    result.emitted += tracer.sampler().powerOf(walk);
    for (const WalkSegment& segment : test::shotWalk(tracer, objects, walk))
    {
      ++result.segments;
      (segment.hit ? result.received : result.escaped) += segment.power;
    }
  }
  return result;
}

Power sumOfCells(const IrradianceEngine& engine, const SceneObjects& objects)
{
  Power sum;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const Material& material = *objects[object].material;
    for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
    {
      for (int band = 0; band < material.bands; ++band)
      {
        sum[band] += engine.sums().sum({ object, cell }, band);
      }
    }
  }
  return sum;
}

void expectBalance(const PowerBalance& balance)
{
  Power gone = balance.absorbed;
  gone += balance.escaped;
  EXPECT_EQ(balance.emitted, gone);
}

/// A room with a point light and a box, all of one reflectance. An open room has no ceiling.
SceneObjects uniformRoom(double reflectance, bool isClosed)
{
  test::ObjectBuilder room;
  for (int side = 0; side < (isClosed ? 6 : 5); ++side)
  {
    room.addSide(test::box({ 0, 0, 0 }, { 3, 4, 5 }), side, 2, test::grey(reflectance), true);
  }
  room.addPointLight({ 1, 2, 3 }, 10);
  test::ObjectBuilder object;
  object.addBox(test::box({ -1, -1, -1 }, { 0, 0, 0 }), 1, test::grey(reflectance));
  return { room.build(), { object.build(test::shift({ 2, 3, 2 })) } };
}

}

TEST(PowerBalance, HoldsInIntegersAfterManyUpdates)
{
  for (const bool isClosed : { true, false })
  {
    for (const int bands : { 1, 3 })
    {
      MovingScene scene(bands, isClosed, 11);
      EngineSettings settings;
      settings.numberOfWalks = scaled(3000);
      IrradianceEngine engine;
      Execution execution;
      for (int frame = 0; frame < 60; ++frame, scene.nextFrame())
      {
        engine.update(scene.objects(), settings, execution);
        expectBalance(engine.balance());
        EXPECT_EQ(engine.balance().escaped.isZero(), isClosed) << "frame " << frame;
      }
    }
  }
}

TEST(PowerBalance, EqualsARecountOfTheWalks)
{
  for (const int bands : { 1, 3 })
  {
    MovingScene scene(bands, false, 12);
    EngineSettings settings;
    settings.numberOfWalks = scaled(2000);
    IrradianceEngine engine;
    Execution execution;
    for (int frame = 0; frame < 15; ++frame, scene.nextFrame())
    {
      engine.update(scene.objects(), settings, execution);
      const Recount truth = recount(scene.objects(), settings);
      EXPECT_EQ(sumOfCells(engine, scene.objects()), truth.received);
      EXPECT_EQ(engine.balance().emitted, truth.emitted);
      EXPECT_EQ(engine.balance().escaped, truth.escaped);
      EXPECT_EQ(engine.balance().segments, truth.segments);
    }
  }
}

TEST(PowerBalance, HoldsForAllReflectancesInAnOpenRoom)
{
  for (const double reflectance : { 0.0, 0.5, 0.95, 1.0 })
  {
    SceneObjects objects = uniformRoom(reflectance, false);
    EngineSettings settings;
    settings.numberOfWalks = scaled(3000);
    IrradianceEngine engine;
    Execution execution;
    for (int frame = 0; frame < 10; ++frame)
    {
      engine.update(objects, settings, execution);
      expectBalance(engine.balance());
      EXPECT_FALSE(engine.balance().escaped.isZero());
      // At 1 every walk survives every hit, and keeps its power.
      EXPECT_EQ(engine.balance().absorbed.isZero(), reflectance == 1);
      objects.dynamicObjects[0].worldFromObject.translation[2] += 0.1;
    }
    std::printf("reflectance %.2f: %.2f segments a walk, %.4f of the power escapes\n", reflectance,
      double(engine.balance().segments) / settings.numberOfWalks,
      engine.watts(engine.balance().escaped[0]) / 10);
  }
}

TEST(PowerBalance, NothingEscapesFromAClosedRoom)
{
  for (const double reflectance : { 0.0, 0.5, 0.95 })
  {
    const SceneObjects objects = uniformRoom(reflectance, true);
    EngineSettings settings;
    settings.numberOfWalks = scaled(20000);
    IrradianceEngine engine;
    Execution execution;
    engine.update(objects, settings, execution);
    expectBalance(engine.balance());
    EXPECT_TRUE(engine.balance().escaped.isZero());
    EXPECT_EQ(engine.watts(engine.balance().emitted[0]), 10);
  }
}

// Light that cannot go anywhere is an error, not an endless run, and the engine stays usable. It
// comes within the first bounces, also where some walks end; and where walks leave at last, or are
// absorbed, none comes.
TEST(PowerBalance, ClosedRoomThatAbsorbsNothingEndsWithAClearError)
{
  EngineSettings settings;
  settings.numberOfWalks = 100000;
  IrradianceEngine engine;
  Execution execution;
  for (const bool gathers : { false, true })
  {
    settings.gathersDirectLight = gathers;
    for (const double reflectance : { gathers ? 1 - 1e-7 : 1.0, 1 - 1e-6 })
    {
      try
      {
        engine.update(uniformRoom(reflectance, true), settings, execution);
        FAIL() << "no exception";
      }
      catch (const std::exception& error)
      {
        const std::string text = error.what();
        EXPECT_NE(text.find("reflectances there are too near 1"), std::string::npos) << text;
        EXPECT_NE(text.find("ended in their first 256 bounces"), std::string::npos) << text;
      }
    }
  }
  settings.numberOfWalks = test::scaled(4096);
  engine.update(uniformRoom(0.999, true), settings, execution);
  EXPECT_GT(engine.balance().segments, settings.numberOfWalks / 2 * 1000);
  settings.numberOfWalks = 1000;
  const SceneObjects open = uniformRoom(1, false);
  engine.update(open, settings, execution);
  EXPECT_EQ(test::answerOf(engine, open), test::freshAnswer(open, settings));
}

TEST(PowerBalance, ExcessIsBeyondNoise)
{
  EXPECT_TRUE(isExcess(1000, -251, 20));
  EXPECT_FALSE(isExcess(1000, -99, 20));
  EXPECT_FALSE(isExcess(1000, -1e-8, 0)) << "rounding";
  EXPECT_TRUE(isExcess(1000, -1e-3, 0));
  EXPECT_FALSE(isExcess(1000, 500, 1));
}

}
