// SPDX-License-Identifier: BSD-3-Clause
#include "MovingScene.h"
#include "OnlySet.h"
#include "ShownAnswer.h"
#include "ThreadExecution.h"
#include "TickingExecution.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::MovingScene;

EngineSettings withErrors(std::uint32_t walks)
{
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(walks);
  settings.replicates = 16;
  return settings;
}

/// A closed room with a point light and a shade that hides more or less of its light: the less is
/// left, the more walks the target takes.
class ShadedRoom
{
public:
  ShadedRoom()
  {
    ObjectBuilder room, shade;
    room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 4 }), 2, test::grey(0.3), true);
    room.addPointLight({ 2, 2, 2 }, 100);
    shade.addBox(test::box({ -0.5, -0.5, -0.02 }, { 0.5, 0.5, 0.02 }), 1, test::grey(0.1));
    objects_ = { room.build(), { shade.build() } };
  }
  /// The shade is `height` m below the light.
  const SceneObjects& at(double height)
  {
    objects_.dynamicObjects[0].worldFromObject = test::shift({ 2, 2, 2 - height });
    return objects_;
  }

private:
  using ObjectBuilder = test::ObjectBuilder;
  SceneObjects objects_;
};

}

TEST(ErrorBarUpdates, UpdateEqualsRebuild)
{
  for (const int bands : { 1, 3 })
  {
    MovingScene scene(bands, bands == 3, 71, bands == 1);
    EngineSettings settings = withErrors(10007);
    settings.separateSides = bands == 3;
    IrradianceEngine engine;
    test::ThreadExecution threads(2);
    std::int64_t invalid = 0;
    const int frames = test::kIsSanitized ? 6 : 12;
    for (int frame = 0; frame < frames; ++frame, scene.nextFrame())
    {
      engine.update(scene.objects(), settings, threads);
      ASSERT_TRUE(test::shownAnswer(engine, scene.objects(), settings) ==
        test::freshShownAnswer(scene.objects(), settings))
        << bands << " bands, frame " << frame;
      EXPECT_EQ(engine.statistics().shootSeconds > 0, frame == 0);
      invalid += engine.statistics().invalidWalks;
    }
    EXPECT_GT(invalid, frames * std::int64_t{ settings.numberOfWalks } / 20);
  }
}

TEST(ErrorBarUpdates, SameBitsWhateverTheWay)
{
  MovingScene scene(1, false, 72);
  std::vector<SceneObjects> frames;
  for (int i = 0; i < 3; ++i, scene.nextFrame())
  {
    frames.push_back(scene.objects());
  }
  const std::vector<std::shared_ptr<Execution>> executions = {
    std::make_shared<test::ThreadExecution>(7), std::make_shared<test::BackwardExecution>()
  };
  for (const double target : { 0.0, 1.0 })
  {
    EngineSettings settings = withErrors(6000);
    settings.targetRelativeError = target;
    settings.maximumNumberOfWalks = 8 * settings.numberOfWalks;
    const test::Answer expected = test::freshShownAnswer(frames.back(), settings);
    for (const TraversalMode mode :
      { TraversalMode::OneTree, TraversalMode::Sequential, TraversalMode::Parallel })
    {
      for (const auto& execution : executions)
      {
        for (const bool verify : { true, false })
        {
          settings.traversalMode = mode;
          settings.verify = verify;
          settings.cacheStaticHits = !settings.cacheStaticHits;
          IrradianceEngine engine;
          for (const SceneObjects& objects : frames)
          {
            engine.update(objects, settings, *execution);
          }
          EXPECT_TRUE(test::shownAnswer(engine, frames.back(), settings) == expected)
            << "traversal " << int(mode) << ", verify " << verify << ", target " << target;
        }
      }
    }
  }
}

// The number of rounds rises and falls from frame to frame; earlier frames leave no trace.
class ErrorBarUpdatesInModes : public testing::TestWithParam<bool>
{
};

TEST_P(ErrorBarUpdatesInModes, UpdateEqualsRebuildWithATarget)
{
  ShadedRoom room;
  EngineSettings settings = withErrors(3001);
  settings.gathersDirectLight = GetParam();
  settings.targetRelativeError = 0.2;
  settings.maximumNumberOfWalks = 100000;
  IrradianceEngine engine;
  test::ThreadExecution threads(2);
  int rises = 0, falls = 0, stays = 0;
  std::uint32_t before = 0;
  for (const double height : { 1.5, 0.1, 0.12, 1.0, 0.05, 1.7, 0.2, 0.15, 0.5, 0.3, 0.04, 1.5 })
  {
    const SceneObjects& objects = room.at(height);
    engine.update(objects, settings, threads);
    ASSERT_TRUE(
      test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings))
      << "height " << height;
    const std::uint32_t walks = engine.numberOfWalks();
    std::printf("height %.2f: %u walks reach %.3f\n", height, walks, engine.reachedRelativeError());
    rises += before != 0 && walks > before ? 1 : 0;
    falls += walks < before ? 1 : 0;
    stays += walks == before ? 1 : 0;
    before = walks;
  }
  EXPECT_GE(rises, 2);
  EXPECT_GE(falls, 2);
  EXPECT_GE(stays, 1);
}

// While walks wait for repair the number of rounds stays; afterwards it is as in a new engine.
TEST_P(ErrorBarUpdatesInModes, ATargetWaitsWhileWalksAreStale)
{
  ShadedRoom room;
  EngineSettings settings = withErrors(3001);
  settings.gathersDirectLight = GetParam();
  settings.targetRelativeError = 0.2;
  settings.maximumNumberOfWalks = 100000;
  settings.repairTimeBudget = 20 * test::TickingExecution::kTick;
  IrradianceEngine engine;
  test::TickingExecution clock;
  int waits = 0, changes = 0;
  std::uint32_t before = 0;
  for (const double height : { 1.5, 0.1, 1.7, 0.05, 1.0 })
  {
    const SceneObjects& objects = room.at(height);
    engine.update(objects, settings, clock);
    for (; engine.walks().hasStale(); ++waits)
    {
      ASSERT_TRUE(std::isnan(engine.reachedRelativeError()));
      ASSERT_EQ(engine.numberOfWalks(), before);
      engine.update(objects, settings, clock);
    }
    changes += before != 0 && engine.numberOfWalks() != before ? 1 : 0;
    before = engine.numberOfWalks();
    ASSERT_TRUE(
      test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings))
      << "height " << height;
  }
  EXPECT_GT(waits, 10);
  EXPECT_GE(changes, 2);
}

// A new target continues from the existing walks, and the old target returns to them.
TEST_P(ErrorBarUpdatesInModes, TurningTheDialEqualsAFreshStart)
{
  ShadedRoom room;
  const SceneObjects& objects = room.at(1);
  EngineSettings settings = withErrors(1000);
  settings.gathersDirectLight = GetParam();
  settings.maximumNumberOfWalks = 64000;
  IrradianceEngine engine;
  Execution execution;
  std::vector<std::uint32_t> walks;
  for (const double target : { 0.5, 0.2, 0.1, 0.3, 0.0001, 0.5 })
  {
    settings.targetRelativeError = target;
    engine.update(objects, settings, execution);
    EXPECT_TRUE(
      test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings))
      << "target " << target;
    walks.push_back(engine.numberOfWalks());
  }
  EXPECT_LT(walks[0], walks[1]);
  EXPECT_LT(walks[1], walks[2]);
  EXPECT_LT(walks[3], walks[2]);
  EXPECT_EQ(walks[4], settings.maximumNumberOfWalks) << "cannot be reached";
  EXPECT_EQ(walks[5], walks[0]);
  settings.targetRelativeError = 0;
  engine.update(objects, settings, execution);
  EXPECT_TRUE(
    test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings));
}

// With any number of rounds, the power is what the lights emit, and balances to the last quantum.
TEST_P(ErrorBarUpdatesInModes, PowerIsThatOfTheScene)
{
  ShadedRoom room;
  EngineSettings settings = withErrors(1000);
  settings.gathersDirectLight = GetParam();
  settings.maximumNumberOfWalks = 50000;
  IrradianceEngine engine;
  Execution execution;
  for (const double target : { 0.5, 0.2, 0.0001, 0.5 })
  {
    settings.targetRelativeError = target;
    engine.update(room.at(0.5), settings, execution);
    const PowerBalance& balance = engine.balance();
    EXPECT_NEAR(engine.watts(balance.emitted[0]), 100, 1e-9);
    EXPECT_EQ(balance.emitted[0], balance.absorbed[0] + balance.escaped[0]);
  }
}

// A tenth of the area is the inside of a box that no light can reach.
TEST_P(ErrorBarUpdatesInModes, DarkCellsDoNotMakeTheDialRunForever)
{
  test::ObjectBuilder room;
  room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(0.3), true);
  room.addBox(test::box({ -1.5, -1, -1 }, { -0.3, 1, 1 }), 1, test::grey(0.5));
  room.addBox(test::box({ -1.4, -0.9, -0.9 }, { -0.4, 0.9, 0.9 }), 2, test::grey(0.5), true);
  room.addPointLight({ 1, 0, 0 }, 100);
  EngineSettings settings;
  settings.numberOfWalks = 1000;
  settings.maximumNumberOfWalks = 4000000;
  settings.replicates = 16;
  settings.gathersDirectLight = GetParam();
  settings.targetRelativeError = test::kIsSanitized ? 0.5 : 0.2;
  IrradianceEngine engine;
  Execution execution;
  engine.update({ room.build(), {} }, settings, execution);
  EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
  EXPECT_LT(engine.numberOfWalks(), settings.maximumNumberOfWalks);
  std::printf("%u walks\n", engine.numberOfWalks());
}

INSTANTIATE_TEST_SUITE_P(ShotAndGathered, ErrorBarUpdatesInModes, testing::Bool());

// Law 7: one number for each cell, side and band; with error bars, one for each replicate.
TEST(PayForWhatIsUsed, NoErrorBarsNoReplicateSums)
{
  const SceneObjects objects = MovingScene(3, true, 73).objects();
  std::size_t cells = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].material->numberOfCells;
  }
  for (const std::uint32_t replicates : { 1u, 16u })
  {
    EngineSettings settings;
    settings.numberOfWalks = 5000;
    settings.replicates = replicates;
    IrradianceEngine engine;
    Execution execution;
    engine.update(objects, settings, execution);
    EXPECT_EQ(engine.sums().bytes(), cells * 3 * 8 * replicates);
    EXPECT_EQ(engine.sums().rounds(), 1u);
    const std::size_t history = engine.statistics().historyBytes;
    settings.replicates = 1;
    engine.update(objects, settings, execution);
    EXPECT_NEAR(double(history), double(engine.statistics().historyBytes), 0.03 * double(history))
      << "stored walks do not carry their replicate";
  }
}

// The remains of an interrupted round do not pass for a frame.
TEST(ErrorBarUpdates, AnInterruptionLeavesNoTrace)
{
  ShadedRoom room;
  EngineSettings settings = withErrors(8000);
  settings.targetRelativeError = 0.08;
  settings.maximumNumberOfWalks = 64000;
  IrradianceEngine engine;
  Execution execution;
  int stops = 0;
  for (int stopAt = 0; stopAt < 64; stopAt = stopAt < 4 ? stopAt + 1 : 2 * stopAt)
  {
    engine.update(room.at(1), settings, execution);
    test::StoppingExecution stopping(stopAt);
    try
    {
      engine.update(room.at(0.1), settings, stopping);
    }
    catch (const Interrupted&)
    {
      ++stops;
    }
    engine.update(room.at(0.2), settings, execution);
    ASSERT_TRUE(test::shownAnswer(engine, room.at(0.2), settings) ==
      test::freshShownAnswer(room.at(0.2), settings))
      << "stopped at call " << stopAt;
  }
  EXPECT_GE(stops, 3);
}

}
