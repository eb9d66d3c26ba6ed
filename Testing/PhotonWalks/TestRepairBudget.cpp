// SPDX-License-Identifier: BSD-3-Clause
// A time budget for the repair: it is kept, and later calls repair what is stale.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

std::map<std::uint16_t, std::size_t> effects(const IrradianceEngine& engine)
{
  std::map<std::uint16_t, std::size_t> counts;
  for (std::size_t block = 0; block < onlySet(engine).stale()->numberOfBlocks(); ++block)
  {
    for (const StaleMark& mark : onlySet(engine).stale()->marks(block))
    {
      ++counts[mark.powerClass];
    }
  }
  return counts;
}

// Classes of few walks are merged up to 128 walks per unit, so the classes above the weakest of a
// group have fewer walks than that. In one band all walks are equal, so there are three.
TEST(RepairBudget, TheStrongestComeFirst)
{
  constexpr std::size_t kBatchSize = 12 * 128; // 12 blocks, each a unit
  MovingScene scene(3, true, 34);
  EngineSettings settings = Shoot(12000).budget(kNoTime);
  IrradianceEngine engine;
  TickingExecution clock;
  engine.update(scene.objects(), settings, clock);
  for (int frame = 0; frame < 3; ++frame)
  {
    scene.nextFrame();
    engine.update(scene.objects(), settings, clock);
  }
  ASSERT_GT(numberOfStale(engine), 2 * kBatchSize);
  settings.repairTimeBudget = 30 * TickingExecution::kTick;
  int calls = 0;
  for (; numberOfStale(engine) > 0; ++calls)
  {
    const auto before = effects(engine);
    engine.update(scene.objects(), settings, clock);
    auto after = effects(engine);
    const std::size_t strongestLeft = after.empty() ? 0 : after.rbegin()->first;
    const auto weakestTouched = std::find_if(before.begin(), before.end(),
      [&](const auto& effect) { return after[effect.first] < effect.second; });
    ASSERT_NE(weakestTouched, before.end());
    std::size_t passedOver = 0; // stronger walks that may be left
    for (auto it = std::next(weakestTouched); it != before.end() && it->first <= strongestLeft;
         ++it)
    {
      passedOver += it->second;
    }
    EXPECT_LT(passedOver, kBatchSize) << "call " << calls;
  }
  EXPECT_GT(calls, 3);
}

// In ticks: a batch ends between two bounces, and each of the six units reads the clock once more.
TEST(RepairBudget, TheTimeIsKept)
{
  MovingScene scene(1, true, 35);
  Shoot settings(6000);
  IrradianceEngine engine;
  for (int frame = 0; frame < 20; ++frame, scene.nextFrame())
  {
    for (const int budget : { 40, 80, 160 })
    {
      TickingExecution clock;
      settings.repairTimeBudget = budget * TickingExecution::kTick;
      engine.update(scene.objects(), settings, clock);
      EXPECT_LE(clock.ticks(), budget + 20) << "frame " << frame;
      EXPECT_TRUE(numberOfStale(engine) == 0 || clock.ticks() >= budget / 2) << "frame " << frame;
    }
  }
}

/// After `jumpAt` readings of the clock, all budgets are over.
class JumpingExecution : public TickingExecution
{
public:
  explicit JumpingExecution(std::int64_t jumpAt)
    : jumpAt_(jumpAt)
  {
  }
  double seconds() const override
  {
    const double now = TickingExecution::seconds();
    return ticks() > jumpAt_ ? now + 1e6 : now;
  }

private:
  std::int64_t jumpAt_;
};

// Whenever the time is up, the walks of a batch that was begun are finished: the first 16, then as
// many as take half of the time that is left.
TEST(RepairBudget, WhatIsBegunIsFinished)
{
  SceneObjects objects = ballInARoom(0.95, 0.95);
  EngineSettings settings = Shoot(500).budget(1e3);
  int some = 0;
  for (int jumpAt = 1; jumpAt <= 60; ++jumpAt)
  {
    IrradianceEngine engine;
    JumpingExecution clock(jumpAt);
    objects.dynamicObjects[0].worldFromObject = {};
    engine.update(objects, settings, clock);
    objects.dynamicObjects[0].worldFromObject = shift({ 0.3, 0, 0 });
    engine.update(objects, settings, clock);
    expectBalance(engine);
    const auto found = static_cast<std::size_t>(engine.statistics().invalidWalks);
    ASSERT_GT(found, 100u);
    ASSERT_LE(numberOfStale(engine), found - 16);
    some += numberOfStale(engine) > 0;
    settings.repairTimeBudget = 0;
    engine.update(objects, settings, clock);
    ASSERT_TRUE(isAsFresh(engine));
    settings.repairTimeBudget = 1e3;
  }
  EXPECT_GT(some, 3);
}

TEST(RepairBudget, WithoutABudgetNoClockAndNoBooks)
{
  MovingScene scene(1, true, 36);
  Shoot settings(3000);
  IrradianceEngine engine;
  TickingExecution clock;
  for (int frame = 0; frame < 5; ++frame, scene.nextFrame())
  {
    engine.update(scene.objects(), settings, clock);
    EXPECT_EQ(onlySet(engine).stale(), nullptr);
  }
  EXPECT_EQ(clock.ticks(), 0);
  const std::size_t bytes = engine.statistics().historyBytes;
  settings.repairTimeBudget = kNoTime;
  engine.update(scene.objects(), settings, clock);
  EXPECT_GT(engine.statistics().invalidWalks, 0);
  EXPECT_GT(numberOfStale(engine), 0u);
  const std::size_t held = onlySet(engine).stale()->bytes();
  EXPECT_LE(held, 16 * numberOfStale(engine) + 16 * 16 + 4 * 80) << "16 bytes a stale walk";
  settings.repairTimeBudget = 0;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(onlySet(engine).stale(), nullptr);
  EXPECT_LT(engine.statistics().historyBytes, bytes + bytes / 2);
  const std::int64_t ticks = clock.ticks();
  scene.nextFrame();
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(clock.ticks(), ticks);
}

TEST(RepairBudget, NothingIsStaleWhenAllIsShotAnew)
{
  MovingScene scene(1, true, 37);
  EngineSettings settings = Shoot(3000).budget(kNoTime);
  IrradianceEngine engine;
  TickingExecution clock;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(numberOfStale(engine), 0u);
  scene.nextFrame();
  engine.update(scene.objects(), settings, clock);
  EXPECT_GT(numberOfStale(engine), 0u);
  ++settings.seed;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(numberOfStale(engine), 0u);
  EXPECT_TRUE(isAsFresh(engine));
  scene.nextFrame();
  settings.verify = false;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(numberOfStale(engine), 0u);
  EXPECT_TRUE(isAsFresh(engine));
}

TEST(RepairBudget, AnAbortIsNoEndOfABudget)
{
  for (int stopAt = 0; stopAt < 12; ++stopAt)
  {
    MovingScene scene(1, true, 38);
    EngineSettings settings = Shoot(3000).budget(kNoTime);
    IrradianceEngine engine;
    TickingExecution clock;
    engine.update(scene.objects(), settings, clock);
    scene.nextFrame();
    engine.update(scene.objects(), settings, clock);
    scene.nextFrame();
    settings.repairTimeBudget = 1e9;
    StoppingExecution stopping(stopAt);
    bool isStopped = false;
    try
    {
      engine.update(scene.objects(), settings, stopping);
    }
    catch (const Interrupted&)
    {
      isStopped = true;
    }
    engine.update(scene.objects(), settings, clock);
    EXPECT_EQ(engine.statistics().shootSeconds > 0, isStopped) << stopAt;
    EXPECT_EQ(numberOfStale(engine), 0u);
    EXPECT_TRUE(isAsFresh(engine));
  }
}

}
}
