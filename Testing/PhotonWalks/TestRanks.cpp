// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Views/WalkPaths.h"

// Engines on several ranks bring what one engine alone brings, bit for bit.

namespace irradiance::test
{
namespace
{

EngineSettings rankSettings(std::uint32_t walks, std::uint32_t replicates = 16)
{
  return Shoot(walks).errors(replicates);
}

/// In quanta on all cells.
double totalOf(const CellSums& sums)
{
  double total = 0;
  sums.numbers().forEach([&](const SceneCell& cell) { total += sums.sum({ cell }, 0); });
  return total;
}

// Each rank repairs in a time of its own, and some have no walks. What is stale on one is stale for
// all, until all have repaired.
TEST(Ranks, RepairWithinABudget)
{
  MovingScene scene(1, true, 7);
  const SceneObjects first = scene.objects();
  scene.nextFrame();
  const SceneObjects second = scene.objects();
  const EngineSettings settings = rankSettings(1500);
  const Answer expected = freshAnswer(second, settings);
  std::mutex mutex;
  const auto errors = ThreadRanks(5).run([&](ThreadRanks::Rank& rank) {
    UpdatedEngine engine(first, settings, rank);
    EngineSettings hurried = settings;
    hurried.repairTimeBudget = kNoTime;
    engine.update(second, hurried, rank);
    auto sum = static_cast<std::int64_t>(totalOf(onlySet(engine).stale()->sums()));
    rank.ranks().sum(&sum, 1);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      const double told = totalOf(*engine.walks().staleSums());
      EXPECT_GT(told, 0);
      EXPECT_EQ(told, sum);
      EXPECT_GT(engine.staleGainBound(0), 0);
      expectBalance(engine);
    }
    while (!engine.stalePower().isZero())
    {
      engine.update(second, hurried, rank);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    EXPECT_EQ(answerOf(engine, second), expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(5));
}

// Whoever fails ends the work of all. Then they begin again together, also with a new engine on one
// of them.
TEST(Ranks, EndTogetherWhenOneFails)
{
  MovingScene scene(1, true, 3);
  const EngineSettings settings = rankSettings(5000);
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
  const Answer expected = freshAnswer(scene.objects(), settings);
  for (const auto& engine : engines)
  {
    EXPECT_EQ(answerOf(*engine, scene.objects()), expected);
  }

  // An engine that goes on alone has to shoot what the others had.
  scene.nextFrame();
  Execution alone;
  engines[1]->update(scene.objects(), settings, alone);
  EXPECT_TRUE(isAsFresh(*engines[1]));
}

// Who reads photons needs all of them in each engine; then the walks are shot again, and stay.
TEST(Ranks, EachHasAllWalksWherePhotonsAreRead)
{
  MovingScene scene(1, true, 5);
  std::vector<SceneObjects> frames;
  for (int i = 0; i < 3; ++i, scene.nextFrame())
  {
    frames.push_back(scene.objects());
  }
  EngineSettings settings = rankSettings(9000), reading = settings;
  reading.keepPhotons = reading.allOnEachRank = true;
  const Answer expected = freshAnswer(frames[2], settings);
  std::mutex mutex;
  const std::vector<std::string> errors = ThreadRanks(3).run([&](ThreadRanks::Rank& rank) {
    UpdatedEngine engine(frames[0], settings, rank);
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
    EXPECT_EQ(answerOf(engine, frames[2]), expected);
  });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

TEST(Ranks, MustBeGivenTheSame)
{
  const MovingScene scene(1, true, 3), other(1, true, 4);
  const auto expectOther = [](const std::string& what, const auto& work) {
    EXPECT_EQ(ThreadRanks(3).run(work),
      std::vector<std::string>(
        3, "other " + what + " than on the first process on 1 of 3 processes"));
  };
  expectOther("settings", [&](ThreadRanks::Rank& rank) {
    UpdatedEngine engine(scene.objects(), rankSettings(rank.rank() == 2 ? 5001 : 5000), rank);
  });
  expectOther("inputs", [&](ThreadRanks::Rank& rank) {
    UpdatedEngine engine(
      rank.rank() == 1 ? other.objects() : scene.objects(), rankSettings(5000), rank);
  });
  // Later only what has changed is looked at.
  expectOther("inputs", [&](ThreadRanks::Rank& rank) {
    UpdatedEngine engine(scene.objects(), rankSettings(5000), rank);
    SceneObjects moved = scene.objects();
    moved.dynamicObjects[0].worldFromObject.translation[0] += rank.rank() == 1 ? 0.02 : 0.01;
    engine.update(moved, rankSettings(5000), rank);
  });
}

}
}
