// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "MovingScene.h"
#include "ShownAnswer.h"
#include "StaleLight.h"
#include "ThreadRanks.h"
#include "TwoGroups.h"
#include "Views/WalkPaths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <mutex>

// Engines on several ranks bring what one engine alone brings, bit for bit.

namespace irradiance
{
namespace
{

using test::Answer;
using test::ThreadRanks;

EngineSettings settingsOf(std::uint32_t walks, std::uint32_t replicates = 16)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.replicates = replicates;
  return settings;
}

/// Takes engines on so many ranks through frames, and compares each with an engine that starts
/// alone.
void expectSameAsAlone(std::uint32_t ranks, const EngineSettings& settings, bool hasGroups)
{
  constexpr int kFrames = 5;
  std::vector<SceneObjects> frames;
  test::MovingScene scene(3, false, 4 + ranks);
  std::vector<Answer> expected;
  for (int frame = 0; frame < kFrames; ++frame)
  {
    frames.push_back(hasGroups ? test::inTwoGroups(scene.objects()) : scene.objects());
    scene.nextFrame();
    IrradianceEngine alone;
    Execution serial;
    alone.update(frames.back(), settings, serial);
    expected.push_back(test::shownAnswer(alone, frames.back(), settings));
  }
  ThreadRanks all(ranks);
  std::mutex mutex;
  const std::vector<std::string> errors = all.run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    std::int64_t invalid = 0;
    for (int frame = 0; frame < kFrames; ++frame)
    {
      const auto i = static_cast<std::size_t>(frame);
      engine.update(frames[i], settings, rank);
      invalid += engine.statistics().invalidWalks;
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_EQ(test::shownAnswer(engine, frames[i], settings), expected[i])
        << "rank " << rank.rank() << " of " << ranks << ", frame " << frame;
    }
    EXPECT_GT(invalid, 0);
  });
  EXPECT_EQ(errors, std::vector<std::string>(ranks));
}

TEST(Ranks, BringTheBitsOfOne)
{
  for (const std::uint32_t ranks : { 1u, 2u, 3u, 7u })
  {
    expectSameAsAlone(ranks, settingsOf(5000), false);
  }
}

TEST(Ranks, ShareWalksOfSeveralSets)
{
  expectSameAsAlone(3, settingsOf(5000), true);
}

TEST(Ranks, ShareCellsThatGather)
{
  EngineSettings settings = settingsOf(5000);
  settings.gathersDirectLight = true;
  expectSameAsAlone(2, settings, false);
  expectSameAsAlone(3, settings, true);
}

// More ranks than blocks: some have nothing to do.
TEST(Ranks, MayHaveNoWalks)
{
  expectSameAsAlone(5, settingsOf(1500, 1), false);
}

TEST(Ranks, SpreadSidesAndReachATarget)
{
  EngineSettings settings = settingsOf(2000);
  settings.cellEstimate = CellEstimate::Spread;
  settings.spreadPhotons = 60;
  settings.separateSides = true;
  expectSameAsAlone(2, settings, false);
  settings.targetRelativeError = 0.4;
  settings.maximumNumberOfWalks = 40000;
  expectSameAsAlone(3, settings, false);
}

TEST(Ranks, GatherAndReachATarget)
{
  EngineSettings settings = settingsOf(1000, 8);
  settings.gathersDirectLight = true;
  settings.cellEstimate = CellEstimate::Gathered;
  settings.gatherRays = 8;
  settings.gathersEverywhere = true;
  settings.targetRelativeError = 0.6;
  settings.maximumNumberOfWalks = 4000;
  settings.maximumGatherRays = 32;
  expectSameAsAlone(3, settings, false);
}

/// What is stale on this rank, in quanta on all cells.
double staleOf(const IrradianceEngine& engine)
{
  double stale = 0;
  for (const WalkSet& set : engine.walks().sets())
  {
    engine.cells().numbers().forEach(
      [&](const SceneCell& cell) { stale += set.stale()->sums().sum({ cell }, 0); });
  }
  return stale;
}

// Each rank repairs in a time of its own, and some have no walks. What is stale on one is stale for
// all, until all have repaired.
TEST(Ranks, RepairWithinABudget)
{
  test::MovingScene scene(1, true, 7);
  const SceneObjects first = scene.objects();
  scene.nextFrame();
  const SceneObjects second = scene.objects();
  const EngineSettings settings = settingsOf(1500);
  const Answer expected = test::freshAnswer(second, settings);
  std::mutex mutex;
  const auto errors = ThreadRanks(5).run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    engine.update(first, settings, rank);
    EngineSettings hurried = settings;
    hurried.repairTimeBudget = test::kNoTime;
    engine.update(second, hurried, rank);
    auto sum = static_cast<std::int64_t>(staleOf(engine));
    rank.ranks().sum(&sum, 1);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      double told = 0;
      engine.cells().numbers().forEach(
        [&](const SceneCell& cell) { told += engine.walks().staleSums()->sum({ cell }, 0); });
      EXPECT_GT(told, 0);
      EXPECT_EQ(told, sum);
      EXPECT_GT(engine.staleGainBound(0), 0);
      test::expectBalance(engine);
    }
    while (!engine.stalePower().isZero())
    {
      engine.update(second, hurried, rank);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(test::answerOf(engine, second), expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(5));
}

// Whoever fails ends the work of all. Then they begin again together, also with a new engine on one
// of them.
TEST(Ranks, EndTogetherWhenOneFails)
{
  test::MovingScene scene(1, true, 3);
  const EngineSettings settings = settingsOf(5000);
  std::vector<std::unique_ptr<IrradianceEngine>> engines;
  std::generate_n(
    std::back_inserter(engines), 3, [] { return std::make_unique<IrradianceEngine>(); });
  ThreadRanks all(3);
  const auto update = [&](ThreadRanks::Rank& rank) {
    engines[rank.rank()]->update(scene.objects(), settings, rank);
  };
  EXPECT_EQ(all.run(update), std::vector<std::string>(3));
  scene.nextFrame();
  const std::vector<std::string> errors = all.run([&](ThreadRanks::Rank& rank) {
    if (rank.rank() == 1)
    {
      throw std::runtime_error("a disk is full");
    }
    update(rank);
  });
  EXPECT_EQ(errors[0], "process 1 of 3 failed or was stopped, so this one stopped too");
  EXPECT_EQ(errors[1], "a disk is full");
  EXPECT_EQ(errors[2], errors[0]);
  engines[2] = std::make_unique<IrradianceEngine>();
  EXPECT_EQ(all.run(update), std::vector<std::string>(3));
  const Answer expected = test::freshAnswer(scene.objects(), settings);
  for (const auto& engine : engines)
  {
    EXPECT_EQ(test::answerOf(*engine, scene.objects()), expected);
  }

  // An engine that goes on alone has to shoot what the others had.
  scene.nextFrame();
  Execution alone;
  engines[1]->update(scene.objects(), settings, alone);
  EXPECT_EQ(
    test::answerOf(*engines[1], scene.objects()), test::freshAnswer(scene.objects(), settings));
}

// Who reads photons needs all of them in each engine; then the walks are shot again, and stay.
TEST(Ranks, EachHasAllWalksWherePhotonsAreRead)
{
  test::MovingScene scene(1, true, 5);
  std::vector<SceneObjects> frames;
  for (int i = 0; i < 3; ++i)
  {
    frames.push_back(scene.objects());
    scene.nextFrame();
  }
  EngineSettings settings = settingsOf(9000), reading = settings;
  reading.keepPhotons = reading.allOnEachRank = true;
  const Answer expected = test::freshAnswer(frames[2], settings);
  std::mutex mutex;
  const std::vector<std::string> errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    engine.update(frames[0], settings, rank);
    const std::size_t share = engine.walks().numberOfBlocks();
    engine.update(frames[1], reading, rank);
    const std::size_t all = engine.walks().numberOfBlocks();
    engine.update(frames[2], settings, rank);
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(share, 3u);
    EXPECT_EQ(all, 9u); // of 1024 walks at most
    EXPECT_EQ(engine.walks().numberOfBlocks(), all);
    EXPECT_GT(engine.statistics().invalidWalks, 0);
    EXPECT_EQ(engine.statistics().shootSeconds, 0);
    EXPECT_EQ(test::answerOf(engine, frames[2]), expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

/// All that a path tells.
std::vector<double> numbersOf(const std::vector<WalkPath>& paths)
{
  std::vector<double> numbers;
  for (const WalkPath& path : paths)
  {
    numbers.insert(numbers.end(),
      { double(path.walk), double(path.power[0]), path.escapes ? 1.0 : 0.0,
        path.isStale ? 1.0 : 0.0, double(path.firstRepaired), double(path.points.size()) });
    for (const Vector3& point : path.points)
    {
      numbers.insert(numbers.end(), point.data(), point.data() + 3);
    }
  }
  return numbers;
}

namespace
{

void expectWalksOfOne(bool isGathered)
{
  test::MovingScene scene(1, true, 5);
  const SceneObjects first = test::inTwoGroups(scene.objects());
  scene.nextFrame();
  const SceneObjects second = test::inTwoGroups(scene.objects());
  EngineSettings settings = settingsOf(5000);
  settings.keepPhotons = settings.listRepaired = true;
  settings.gathersDirectLight = isGathered;
  const auto numbers = [&](Execution& execution) {
    IrradianceEngine engine;
    engine.update(first, settings, execution);
    engine.update(second, settings, execution);
    const WalkPaths paths(engine);
    auto all = numbersOf(paths.paths(paths.first(200), execution));
    const auto touching =
      numbersOf(paths.paths(paths.touching({ 1, 0 }, 50, execution), execution));
    EXPECT_FALSE(touching.empty());
    all.insert(all.end(), touching.begin(), touching.end());
    return all;
  };
  Execution alone;
  const std::vector<double> expected = numbers(alone);
  std::mutex mutex;
  const std::vector<std::string> errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    const std::vector<double> shown = numbers(rank);
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(shown, expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

}

TEST(Ranks, ShowTheWalksOfOne)
{
  expectWalksOfOne(false);
  expectWalksOfOne(true);
}

// Each has what all cells gathered, and spreads the light of all walks.
TEST(Ranks, SpreadTheLightOfOneWithGatheredLight)
{
  test::MovingScene scene(1, true, 6);
  const SceneObjects first = scene.objects();
  scene.nextFrame();
  EngineSettings settings = settingsOf(5000);
  settings.cellEstimate = CellEstimate::Spread;
  settings.gathersDirectLight = true;
  const auto irradiances = [&](Execution& execution) {
    IrradianceEngine engine;
    engine.update(first, settings, execution);
    engine.update(scene.objects(), settings, execution);
    std::vector<double> all;
    engine.cells().numbers().forEach(
      [&](const SceneCell& cell) { all.push_back(engine.irradiance({ cell }, 0)); });
    return all;
  };
  Execution alone;
  const std::vector<double> expected = irradiances(alone);
  std::mutex mutex;
  const std::vector<std::string> errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    const std::vector<double> values = irradiances(rank);
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(values, expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

TEST(Ranks, MustBeGivenTheSame)
{
  const test::MovingScene scene(1, true, 3), other(1, true, 4);
  const std::string end = " on 1 of 3 processes";
  std::vector<std::string> errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    engine.update(scene.objects(), settingsOf(rank.rank() == 2 ? 5001 : 5000), rank);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3, "other settings than on the first process" + end));
  errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    engine.update(rank.rank() == 1 ? other.objects() : scene.objects(), settingsOf(5000), rank);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3, "other inputs than on the first process" + end));
  // Later only what has changed is looked at.
  errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    engine.update(scene.objects(), settingsOf(5000), rank);
    SceneObjects moved = scene.objects();
    moved.dynamicObjects[0].worldFromObject.translation[0] += rank.rank() == 1 ? 0.02 : 0.01;
    engine.update(moved, settingsOf(5000), rank);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3, "other inputs than on the first process" + end));
}

}
}
