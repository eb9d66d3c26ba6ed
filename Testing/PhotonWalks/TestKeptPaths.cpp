// SPDX-License-Identifier: BSD-3-Clause
// The paths of a final gather that are kept over motions: those that nothing touches, and no other.

#include "MovingScene.h"
#include "ShownAnswer.h"
#include "Surfaces/Touching.h"
#include "ThreadExecution.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::box;
using test::grey;
using test::ObjectBuilder;

/// A room of large cells with a lamp on its floor, a statue of small cells, and a fine and a coarse
/// part that move.
SceneObjects roomWithStatue(const Vector3& corner, int bands = 1)
{
  const AffineMap place{ Matrix3::Identity(), corner };
  ObjectBuilder room(bands), coarse(bands), fine(bands);
  const auto at = [&](const Vector3& lower, const Vector3& upper) {
    return box(place(lower), place(upper));
  };
  test::Look shiny = grey(0.3);
  shiny.specular = { 0.3, 0.2, 0.1 };
  shiny.exponent = 10;
  room.addBox(at({ 0, 0, 0 }, { 4, 3, 4 }), 6, grey(0.6), true);
  room.addBox(at({ 0.5, 0.5, 0 }, { 1, 1, 0.25 }), 1, grey(0.5, 6));
  room.addBox(at({ 2, 1, 0.5 }, { 2.5, 1.5, 1.5 }), 5, bands > 1 ? shiny : grey(0.5));
  coarse.addBox(box({ -0.25, -0.25, 0 }, { 0.25, 0.25, 0.5 }), 1, grey(0.4));
  fine.addSphere({ 0, 0, 0 }, 0.3, 4, grey(0.7));
  return { room.build(),
    { coarse.build(test::shift(place({ 3, 2, 1 }))),
      fine.build(test::shift(place({ 1, 2, 3 }))) } };
}

EngineSettings gathering()
{
  EngineSettings settings;
  settings.numberOfWalks = 30000;
  settings.gathersDirectLight = true;
  settings.cellEstimate = CellEstimate::Gathered;
  settings.gatherRays = 32;
  return settings;
}

void expectFresh(
  const IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  EXPECT_TRUE(
    test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings));
}

}

// Where floats tell millimetres, and where they tell eighths of the room.
TEST(KeptPaths, AreThoseThatNothingTouches)
{
  for (const auto& [bands, offset] :
    { std::pair(1, 0.0), std::pair(3, 0.0), std::pair(1, 1e5), std::pair(1, 1e7) })
  {
    const Vector3 corner(offset, -offset, 0.5 * offset);
    SceneObjects objects = roomWithStatue(corner, bands);
    const EngineSettings settings = gathering();
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    const std::int64_t all = engine.statistics().followedPaths;
    EXPECT_GT(all, 2 * 32 * 6 * 16);
    engine.update(objects, settings, serial);
    EXPECT_EQ(engine.statistics().followedPaths, 0) << "nothing has moved";
    test::RandomVectors random(91);
    const int frames = test::kIsSanitized ? 4 : 8;
    std::int64_t followed = 0;
    for (int frame = 0; frame < frames; ++frame)
    {
      // Here and there; touching the statue; on the lamp; and away by little.
      AffineMap& pose = objects.dynamicObjects[0].worldFromObject;
      const Vector3 places[] = { Vector3(2, 1.5, 2) +
          Vector3(1.5, 1, 1.5).cwiseProduct(random.inCube()),
        { 2.75, 1.25, 0.75 }, { 0.75, 0.75, 0.25 } };
      pose.translation = frame % 4 == 3 ? Vector3(pose.translation + Vector3(0, 0, 1e-3))
                                        : Vector3(corner + places[frame % 4]);
      pose.linear = frame % 4 == 0 ? random.rotation() : Matrix3::Identity();
      engine.update(objects, settings, serial);
      followed += engine.statistics().followedPaths;
      expectFresh(engine, objects, settings);
    }
    EXPECT_GT(followed, 0);
    std::printf("%.0f m off: %.3f of the paths a frame\n", offset,
      static_cast<double>(followed) / static_cast<double>(all * frames));
    EXPECT_LT(followed, (offset > 1e6 ? 1.0 : 0.25) * static_cast<double>(all * frames)) << offset;
    objects.dynamicObjects[1].worldFromObject.translation += Vector3(0.1, 0, 0);
    engine.update(objects, settings, serial);
    EXPECT_LT(engine.statistics().followedPaths, all);
    EXPECT_GT(engine.statistics().followedPaths, 32) << "what moves gathers anew";
    expectFresh(engine, objects, settings);
  }
}

// The lights are asked at each hit. Most of their rays are of no interest to a motion either, but
// some arrive now, and some no longer.
TEST(KeptPaths, KeepTheRaysOfLights)
{
  for (const int bands : { 1, 3 })
  {
    SceneObjects objects = roomWithStatue(Vector3::Zero(), bands);
    EngineSettings settings = gathering();
    settings.gatherRays = 8;
    settings.unbiasedGather = true;
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    const std::int64_t all = engine.statistics().followedPaths;
    std::int64_t followed = 0;
    const std::vector<Vector3> places{ { 2, 1.2, 0.7 }, { 1.6, 0.9, 0.6 }, { 3, 2, 2 },
      { 0.75, 0.75, 0.5 } };
    for (const Vector3& place : places)
    {
      objects.dynamicObjects[0].worldFromObject = test::shift(place);
      engine.update(objects, settings, serial);
      EXPECT_GT(engine.statistics().followedPaths, 0);
      followed += engine.statistics().followedPaths;
      expectFresh(engine, objects, settings);
    }
    const double part =
      static_cast<double>(followed) / static_cast<double>(all * std::int64_t(places.size()));
    std::printf("%d bands: %.3f of the paths a frame\n", bands, part);
    EXPECT_LT(part, 0.6);
  }
}

// A small block passes few of
// their ways and of the rays of lights; so most of them are kept, and what they say is read anew.
TEST(KeptPaths, KeepTheirChecks)
{
  for (const int bands : { 1, 3 })
  {
    SceneObjects objects = roomWithStatue(Vector3::Zero(), bands);
    EngineSettings settings = gathering();
    settings.replicates = 4;
    AffineMap& pose = objects.dynamicObjects[0].worldFromObject;
    pose.linear *= 0.05;
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    const std::int64_t all = engine.statistics().followedPaths;
    engine.update(objects, settings, serial);
    EXPECT_EQ(engine.statistics().followedPaths, 0) << "nothing has moved";
    expectFresh(engine, objects, settings);
    // In the air; touching the statue; over the lamp; and away by little.
    for (const Vector3& place : { Vector3(3, 2, 2), Vector3(2.525, 1.25, 0.75),
           Vector3(0.75, 0.75, 0.3), Vector3(0.75, 0.75, 0.301) })
    {
      pose.translation = place;
      engine.update(objects, settings, serial);
      const double part =
        static_cast<double>(engine.statistics().followedPaths) / static_cast<double>(all);
      std::printf("%d bands: %.4f of the paths\n", bands, part);
      EXPECT_LT(part, 0.04);
      expectFresh(engine, objects, settings);
    }
  }
}

// A lamp and a white sheet lie in one plane over a statue, and a block stands on the lamp, so
// closely that rays from below come to it first. Then the lamp, which it touches, is before it;
// without it the sheet is before the lamp. So hits on what never moves change, though the block,
// which is too large to gather, goes where no ray is.
TEST(KeptPaths, KnowThatContactsDecide)
{
  ObjectBuilder room, block;
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 4 }), 6, grey(0.5), true);
  room.addQuad({ 1.5, 1.5, 2 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0, 20));
  room.addQuad({ 1.5, 1.5, 2 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0.9));
  room.addBox(box({ 1.8, 1.8, 0.2 }, { 2.2, 2.2, 0.4 }), 6, grey(0.5));
  block.addBox(box({ -0.3, -0.3, 0 }, { 0.3, 0.3, 0.6 }), 1, grey(0.5));
  const double below = 0.25 * kTouching;
  SceneObjects objects{ room.build(), { block.build(test::shift({ 2, 2, 2 - below })) } };
  const SceneObjects touching = objects;
  for (const bool isUnbiased : { false, true })
  {
    EngineSettings settings = gathering();
    settings.unbiasedGather = isUnbiased;
    settings.replicates = 4;
    objects = touching;
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    objects.dynamicObjects[0].worldFromObject = test::shift({ 0.5, 0.5, 3 });
    engine.update(objects, settings, serial);
    EXPECT_EQ(engine.statistics().shootSeconds, 0);
    expectFresh(engine, objects, settings);
  }
}

// A target that fewer rounds of walks reach than were shot: what lights bring where they are asked
// is of these alone.
TEST(KeptPaths, ReadNoMoreRoundsThanATargetNeeds)
{
  const SceneObjects objects = roomWithStatue(Vector3::Zero());
  EngineSettings settings = gathering();
  settings.numberOfWalks = 8000;
  settings.maximumNumberOfWalks = 32000;
  settings.replicates = 4;
  settings.targetRelativeError = 1e-3;
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  EXPECT_EQ(engine.sums().rounds(), 3u);
  settings.targetRelativeError = 0.9;
  engine.update(objects, settings, serial);
  EXPECT_LT(engine.sums().rounds(), 3u);
  EXPECT_EQ(engine.statistics().shootSeconds, 0);
  expectFresh(engine, objects, settings);
}

// What paths depend on besides poses.
TEST(KeptPaths, AreForgottenWhenAnythingElseChanges)
{
  SceneObjects objects = roomWithStatue(Vector3::Zero());
  EngineSettings settings = gathering();
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  const auto expectAnew = [&](const char* what) {
    engine.update(objects, settings, serial);
    EXPECT_GE(engine.statistics().followedPaths, 2 * 24 * 6 * 16) << what;
    expectFresh(engine, objects, settings);
  };
  settings.gatherRays = 24;
  expectAnew("rays");
  settings.seed = 2;
  expectAnew("seed");
  settings.replicates = 4;
  expectAnew("replicates");
  settings.numberOfWalks = 60000; // other cells are large
  expectAnew("walks");
  const SceneObjects others = roomWithStatue({ 0, 0, 0.5 });
  objects.staticObject = others.staticObject;
  expectAnew("static geometry");
  objects.dynamicObjects[1].isPresent = false;
  expectAnew("cells that gather");
  objects.dynamicObjects[1].isPresent = true;
  expectAnew("cells that gather");
  settings.verify = false;
  expectAnew("nothing is to be kept");
  expectAnew("nothing is to be kept");
}

// What is away may become another thing: then the cells behind it have other numbers, though
// nothing moves.
TEST(KeptPaths, KnowCellsByTheirObjects)
{
  SceneObjects objects = roomWithStatue(Vector3::Zero());
  const EngineSettings settings = gathering();
  objects.dynamicObjects[0].isPresent = false;
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  ObjectBuilder other;
  other.addSphere({ 0, 0, 0 }, 0.2, 4, grey(0.2));
  objects.dynamicObjects[0] = other.build();
  objects.dynamicObjects[0].isPresent = false;
  engine.update(objects, settings, serial);
  expectFresh(engine, objects, settings);
  objects.dynamicObjects[1].worldFromObject.translation += Vector3(0.1, 0, 0);
  engine.update(objects, settings, serial);
  expectFresh(engine, objects, settings);
}

TEST(KeptPaths, OutliveNoInterruption)
{
  SceneObjects objects = roomWithStatue(Vector3::Zero());
  const EngineSettings settings = gathering();
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, settings, serial);
  bool isInterrupted = true;
  int interruptions = 0;
  for (int stopAt = 0; isInterrupted; ++stopAt)
  {
    const Vector3 before = objects.dynamicObjects[0].worldFromObject.translation;
    objects.dynamicObjects[0].worldFromObject.translation = Vector3(3, 1.25, 1);
    isInterrupted = false;
    try
    {
      test::StoppingExecution stopping(stopAt);
      engine.update(objects, settings, stopping);
    }
    catch (const Interrupted&)
    {
      isInterrupted = true;
      ++interruptions;
    }
    // As if nothing had been.
    objects.dynamicObjects[0].worldFromObject.translation = before;
    engine.update(objects, settings, serial);
    expectFresh(engine, objects, settings);
  }
  std::printf("%d interruptions\n", interruptions);
  EXPECT_GT(interruptions, 3);
}

}
