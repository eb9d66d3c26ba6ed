// SPDX-License-Identifier: BSD-3-Clause
// A time budget for the repair: it is kept, and later calls repair what is stale.

#include "EngineRun.h"
#include "MovingScene.h"
#include "OnlySet.h"
#include "StaleLight.h"
#include "TickingExecution.h"

#include <map>

namespace irradiance
{

namespace
{

using test::answerOf;
using test::expectBalance;
using test::freshAnswer;
using test::kNoTime;
using test::MovingScene;
using test::numberOfStale;
using test::scaled;
using test::TickingExecution;

/// Budgets of any size, frames with and without motion, now and then time to catch up.
void converge(EngineSettings settings, int bands, unsigned threads, unsigned seed)
{
  MovingScene scene(bands, false, seed);
  test::RandomVectors random(seed);
  IrradianceEngine engine;
  const int steps = test::kIsSanitized ? 20 : 120;
  int partial = 0, exact = 0;
  for (int step = 0; step < steps; ++step)
  {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
    if (random.engine() % 3 != 0)
    {
      scene.nextFrame();
    }
    settings.repairTimeBudget = std::pow(10, random.uniform(-4, 0));
    const bool isLifted = random.engine() % 12 == 0;
    const bool hasPause = random.engine() % 12 == 0;
    TickingExecution clock(threads);
    EngineSettings now = settings;
    now.repairTimeBudget = isLifted ? 0 : settings.repairTimeBudget;
    engine.update(scene.objects(), now, clock);
    expectBalance(engine);
    for (std::size_t left = numberOfStale(engine); hasPause && left > 0;)
    {
      engine.update(scene.objects(), settings, clock);
      expectBalance(engine);
      ASSERT_LT(numberOfStale(engine), left) << "every call repairs something";
      left = numberOfStale(engine);
    }
    ASSERT_TRUE(!isLifted || !engine.walks().staleSums());
    partial += numberOfStale(engine) > 0;
    if (numberOfStale(engine) == 0)
    {
      ++exact;
      EXPECT_TRUE(engine.stalePower().isZero());
      EXPECT_EQ(engine.walks().staleGainBound(0), 0);
      ASSERT_TRUE(answerOf(engine, scene.objects(), settings.separateSides) ==
        freshAnswer(scene.objects(), settings));
    }
    EXPECT_EQ(engine.statistics().shootSeconds > 0, step == 0) << "shot again";
  }
  EXPECT_GT(partial, test::kIsSanitized ? 0 : steps / 4); // with few walks, most calls repair all
  EXPECT_GT(exact, steps / 20);
}

}

TEST(RepairBudget, ConvergesToTheExactState)
{
  unsigned seed = 40;
  for (const int bands : { 1, 3 })
  {
    for (const unsigned threads : { 1u, 4u })
    {
      for (const bool cache : { true, false })
      {
        EngineSettings settings;
        settings.numberOfWalks = scaled(4000);
        settings.cacheStaticHits = cache;
        settings.separateSides = cache;
        converge(settings, bands, threads, ++seed);
      }
    }
  }
}

TEST(RepairBudget, ConvergesToTheExactStateWithGatheredLight)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(4000);
  settings.gathersDirectLight = true;
  converge(settings, 1, 4, 51);
  settings.separateSides = true;
  converge(settings, 3, 1, 52);
}

// An object moves out and back while walks wait, among them walks whose prefix it crosses on the
// way and walks that hit the object itself.
TEST(RepairBudget, ThereAndBackWhileWalksWait)
{
  SceneObjects objects = MovingScene(1, true, 33).objects();
  EngineSettings settings;
  settings.numberOfWalks = scaled(4000);
  IrradianceEngine engine;
  TickingExecution clock;
  engine.update(objects, settings, clock);
  const test::Answer first = answerOf(engine, objects);
  const AffineMap home = objects.dynamicObjects[0].worldFromObject;
  settings.repairTimeBudget = kNoTime;
  for (int step = 1; step <= 12; ++step)
  {
    objects.dynamicObjects[0].worldFromObject = home;
    objects.dynamicObjects[0].worldFromObject.translation[0] += 0.3 * (step < 6 ? step : 12 - step);
    engine.update(objects, settings, clock);
  }
  EXPECT_GT(numberOfStale(engine), 0u);
  settings.repairTimeBudget = 0;
  engine.update(objects, settings, clock);
  EXPECT_TRUE(answerOf(engine, objects) == first);
}

namespace
{

std::map<std::uint16_t, std::size_t> effects(const IrradianceEngine& engine)
{
  std::map<std::uint16_t, std::size_t> counts;
  for (std::size_t block = 0; block < test::onlySet(engine).stale()->numberOfBlocks(); ++block)
  {
    for (const StaleMark& mark : test::onlySet(engine).stale()->marks(block))
    {
      ++counts[mark.powerClass];
    }
  }
  return counts;
}

}

// Classes of few walks are merged up to 128 walks per unit, so the classes above the weakest of a
// group have fewer walks than that. In one band all walks are equal, so there are three.
TEST(RepairBudget, TheStrongestComeFirst)
{
  constexpr std::size_t kBatchSize = 12 * 128; // 12 blocks, each a unit
  MovingScene scene(3, true, 34);
  EngineSettings settings;
  settings.numberOfWalks = 12000;
  settings.repairTimeBudget = kNoTime;
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
  EngineSettings settings;
  settings.numberOfWalks = 6000;
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

namespace
{

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

}

// Whenever the time is up, the walks of a batch that was begun are finished: the first 16, then as
// many as take half of the time that is left.
TEST(RepairBudget, WhatIsBegunIsFinished)
{
  test::ObjectBuilder room, ball;
  room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(0.95), true);
  room.addPointLight({ 1.5, 1.5, 1.5 }, 3);
  ball.addSphere({ 0, 0, 0 }, 0.7, 4, test::grey(0.95));
  SceneObjects objects{ room.build(), { ball.build() } };
  EngineSettings settings;
  settings.numberOfWalks = 500;
  settings.repairTimeBudget = 1e3;
  int some = 0;
  for (int jumpAt = 1; jumpAt <= 60; ++jumpAt)
  {
    IrradianceEngine engine;
    JumpingExecution clock(jumpAt);
    objects.dynamicObjects[0].worldFromObject = {};
    engine.update(objects, settings, clock);
    objects.dynamicObjects[0].worldFromObject = test::shift({ 0.3, 0, 0 });
    engine.update(objects, settings, clock);
    expectBalance(engine);
    const auto found = static_cast<std::size_t>(engine.statistics().invalidWalks);
    ASSERT_GT(found, 100u);
    ASSERT_LE(numberOfStale(engine), found - 16);
    some += numberOfStale(engine) > 0;
    settings.repairTimeBudget = 0;
    engine.update(objects, settings, clock);
    ASSERT_EQ(test::answerOf(engine, objects), test::freshAnswer(objects, settings));
    settings.repairTimeBudget = 1e3;
  }
  EXPECT_GT(some, 3);
}

TEST(RepairBudget, WithoutABudgetNoClockAndNoBooks)
{
  MovingScene scene(1, true, 36);
  EngineSettings settings;
  settings.numberOfWalks = 3000;
  IrradianceEngine engine;
  TickingExecution clock;
  for (int frame = 0; frame < 5; ++frame, scene.nextFrame())
  {
    engine.update(scene.objects(), settings, clock);
    EXPECT_EQ(test::onlySet(engine).stale(), nullptr);
  }
  EXPECT_EQ(clock.ticks(), 0);
  const std::size_t bytes = engine.statistics().historyBytes;
  settings.repairTimeBudget = kNoTime;
  engine.update(scene.objects(), settings, clock);
  EXPECT_GT(engine.statistics().invalidWalks, 0);
  EXPECT_GT(numberOfStale(engine), 0u);
  const std::size_t held = test::onlySet(engine).stale()->bytes();
  EXPECT_LE(held, 16 * numberOfStale(engine) + 16 * 16 + 4 * 80) << "16 bytes a stale walk";
  settings.repairTimeBudget = 0;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(test::onlySet(engine).stale(), nullptr);
  EXPECT_LT(engine.statistics().historyBytes, bytes + bytes / 2);
  const std::int64_t ticks = clock.ticks();
  scene.nextFrame();
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(clock.ticks(), ticks);
}

TEST(RepairBudget, NothingIsStaleWhenAllIsShotAnew)
{
  MovingScene scene(1, true, 37);
  EngineSettings settings;
  settings.numberOfWalks = 3000;
  settings.repairTimeBudget = kNoTime;
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
  EXPECT_TRUE(answerOf(engine, scene.objects()) == freshAnswer(scene.objects(), settings));
  scene.nextFrame();
  settings.verify = false;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(numberOfStale(engine), 0u);
  EXPECT_TRUE(answerOf(engine, scene.objects()) == freshAnswer(scene.objects(), settings));
}

TEST(RepairBudget, AnAbortIsNoEndOfABudget)
{
  for (int stopAt = 0; stopAt < 12; ++stopAt)
  {
    MovingScene scene(1, true, 38);
    EngineSettings settings;
    settings.numberOfWalks = 3000;
    settings.repairTimeBudget = kNoTime;
    IrradianceEngine engine;
    TickingExecution clock;
    engine.update(scene.objects(), settings, clock);
    scene.nextFrame();
    engine.update(scene.objects(), settings, clock);
    scene.nextFrame();
    settings.repairTimeBudget = 1e9;
    test::StoppingExecution stopping(stopAt);
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
    EXPECT_TRUE(answerOf(engine, scene.objects()) == freshAnswer(scene.objects(), settings));
  }
}

}
