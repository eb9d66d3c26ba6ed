// SPDX-License-Identifier: BSD-3-Clause
// A time budget for the repair: stale light loses and gains no more than the bounds say, and later
// calls repair it.

#include "EngineRun.h"
#include "MovingScene.h"
#include "TickingExecution.h"

#include <gtest/gtest.h>

#include <map>

namespace irradiance
{

namespace
{

using test::answerOf;
using test::freshAnswer;
using test::MovingScene;
using test::scaled;
using test::TickingExecution;

constexpr double kNoTime = 1e-9; ///< s; a budget that is over when it begins

std::size_t numberOfStale(const IrradianceEngine& engine)
{
  std::size_t count = 0;
  for (std::size_t block = 0; engine.stale() && block < engine.stale()->numberOfBlocks(); ++block)
  {
    count += engine.stale()->marks(block).size();
  }
  return count;
}

Power stalePower(const IrradianceEngine& engine)
{
  return engine.stale() ? engine.stale()->power() : Power{};
}

double gainBound(const IrradianceEngine& engine, int band)
{
  return engine.stale() ? engine.stale()->gainBound(band) : 0;
}

void expectBalance(const IrradianceEngine& engine)
{
  Power sum = engine.balance().absorbed;
  sum += engine.balance().escaped;
  EXPECT_EQ(sum.quanta, engine.balance().emitted.quanta);
}

/// Checks both bounds, in quanta, and records how much of them is used.
class BoundCheck
{
public:
  BoundCheck(const SceneObjects& objects, bool separateSides)
    : objects_(objects)
    , sides_(separateSides ? 2 : 1)
  {
  }

  void compare(const IrradianceEngine& now, const IrradianceEngine& full)
  {
    for (int band = 0; band < objects_.staticObject.material->bands; ++band)
    {
      double brought = 0; // to all cells by the new tails
      double stale = 0;
      forEachCell([&](std::uint32_t object, std::size_t cell, int side) {
        const std::int64_t before = now.sums().sum({ object, cell, side }, band);
        const std::int64_t after = full.sums().sum({ object, cell, side }, band);
        const std::int64_t tail =
          now.stale() ? now.stale()->sums().sum({ object, cell, side }, band) : 0;
        ASSERT_GE(tail, 0);
        ASSERT_GE(after, before - tail) << "object " << object << ", cell " << cell;
        largestLoss_ = std::max(largestLoss_, tail > 0 ? double(before - after) / double(tail) : 0);
        brought += double(after - (before - tail));
        stale += double(tail);
      });
      const double bound = gainBound(now, band);
      ASSERT_LE(brought, bound) << "band " << band;
      ASSERT_GE(stale, 0);
      if (bound > 0)
      {
        largestGain_ = std::max(largestGain_, brought / bound);
        sumOfGains_ += brought / bound;
        ++count_;
      }
    }
  }

  double largestLoss() const { return largestLoss_; }
  double largestGain() const { return largestGain_; }
  double meanGain() const { return sumOfGains_ / count_; }

private:
  template <class Visit>
  void forEachCell(const Visit& visit) const
  {
    for (std::uint32_t object = 0; object < objects_.size(); ++object)
    {
      for (std::size_t cell = 0; cell < objects_[object].material->numberOfCells; ++cell)
      {
        for (int side = 0; side < sides_; ++side)
        {
          visit(object, cell, side);
        }
      }
    }
  }

  const SceneObjects objects_;
  int sides_;
  double largestLoss_ = 0, largestGain_ = 0, sumOfGains_ = 0;
  int count_ = 0;
};

struct Share
{
  double ofFullRepair;
  IrradianceEngine engine;
  std::unique_ptr<BoundCheck> check;
  double left = 0; ///< part of the walks left stale, mean over the frames
};

void checkBounds(
  const EngineSettings& common, int bands, bool isClosed, unsigned seed, bool isGlossy = false)
{
  const int frames = test::kIsSanitized ? 15 : 200;
  MovingScene scene(bands, isClosed, seed, isGlossy);
  IrradianceEngine full, timed;
  std::vector<Share> shares(3);
  const double parts[] = { 0, 0.1, 0.5 };
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    shares[i].ofFullRepair = parts[i];
    shares[i].check = std::make_unique<BoundCheck>(scene.objects(), common.separateSides);
  }
  Execution execution;
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.nextFrame();
    full.update(scene.objects(), common, execution);
    TickingExecution clock;
    EngineSettings settings = common;
    settings.repairTimeBudget = 1e9;
    timed.update(scene.objects(), settings, clock);
    ASSERT_TRUE(answerOf(timed, scene.objects(), common.separateSides) ==
      answerOf(full, scene.objects(), common.separateSides));
    for (Share& share : shares)
    {
      if (frame % 8 == 0) // a full repair now and then, so that at times few walks wait
      {
        share.engine.update(scene.objects(), common, execution);
        continue;
      }
      TickingExecution own;
      settings.repairTimeBudget =
        std::max(kNoTime, share.ofFullRepair * TickingExecution::kTick * double(clock.ticks()));
      share.engine.update(scene.objects(), settings, own);
      expectBalance(share.engine);
      ASSERT_NO_FATAL_FAILURE(share.check->compare(share.engine, full))
        << "frame " << frame << ", " << share.ofFullRepair << " of the full repair";
      share.left += double(numberOfStale(share.engine)) / common.numberOfWalks / frames;
    }
  }
  for (Share& share : shares)
  {
    std::printf(
      "%2.0f %% of the full repair: %4.1f %% of the walks stale; of the bounds used, loss "
      "%.2f, gain %.2f (mean %.2f)\n",
      100 * share.ofFullRepair, 100 * share.left, share.check->largestLoss(),
      share.check->largestGain(), share.check->meanGain());
    EXPECT_GT(share.left, 0.01);
    EXPECT_GT(share.check->largestLoss(), 0.5) << "the bound says nothing";
    EXPECT_GT(share.check->largestGain(), 0.3) << "the bound says nothing";
    share.engine.update(scene.objects(), common, execution); // the budget is lifted
    EXPECT_TRUE(answerOf(share.engine, scene.objects(), common.separateSides) ==
      answerOf(full, scene.objects(), common.separateSides));
  }
}

}

TEST(RepairBudget, BoundsHoldInAnOpenRoom)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(3000);
  checkBounds(settings, 1, false, 31);
}

TEST(RepairBudget, BoundsHoldInColourWithSides)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(3000);
  settings.separateSides = true;
  settings.seed = 5;
  checkBounds(settings, 3, true, 32);
}

TEST(RepairBudget, BoundsHoldWithGlossyCells)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(1000);
  checkBounds(settings, 1, true, 33, true);
}

// Where nothing escapes and all cells reflect alike, walks do what the bound assumes and attain it
// to the quantum.
TEST(RepairBudget, GainBoundIsReachedInAFurnace)
{
  for (const double reflectance : { 0.0, 0.3, 0.8, 0.99 })
  {
    test::ObjectBuilder room, ball;
    room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(reflectance), true);
    room.addPointLight({ 1.5, 1.5, 1.5 }, 3);
    ball.addSphere({ 0, 0, 0 }, 0.7, 4, test::grey(reflectance));
    SceneObjects objects{ room.build(), { ball.build() } };
    EngineSettings settings;
    settings.numberOfWalks = 5000; // a few hundred become stale
    settings.repairTimeBudget = kNoTime;
    IrradianceEngine now, full;
    Execution execution;
    now.update(objects, settings, execution);
    objects.dynamicObjects[0].worldFromObject = test::shift({ 0.4, -0.3, 0.2 });
    now.update(objects, settings, execution);
    ASSERT_EQ(now.balance().escaped[0], 0);
    full.update(objects, settings, execution);
    double brought = 0;
    for (std::uint32_t object = 0; object < 2; ++object)
    {
      for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
      {
        brought += double(full.sums().sum({ object, cell }, 0) -
          now.sums().sum({ object, cell }, 0) + now.stale()->sums().sum({ object, cell }, 0));
      }
    }
    EXPECT_GT(brought, 0);
    EXPECT_EQ(brought, gainBound(now, 0)) << "reflectance " << reflectance;
    // A walk survives with probability = reflectance: power / (1 - reflectance), within 5 standard errors (one false alarm
    // in 10^6). The standard deviation of a walk's tail is at most about its mean.
    const double mean = double(stalePower(now)[0]) / (1 - reflectance);
    EXPECT_NEAR(
      brought, mean, 5 * mean / std::sqrt(double(numberOfStale(now))) + double(numberOfStale(now)));
  }
}

TEST(RepairBudget, NoGainBoundWhereNearlyAllIsReflected)
{
  test::ObjectBuilder room, ball;
  room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(0.5), true);
  room.addPointLight({ 1.5, 1.5, 1.5 }, 3);
  ball.addSphere({ 0, 0, 0 }, 0.7, 4, test::grey(0.999));
  SceneObjects objects{ room.build(), { ball.build() } };
  EngineSettings settings;
  settings.numberOfWalks = 2000;
  settings.repairTimeBudget = kNoTime;
  IrradianceEngine engine;
  Execution execution;
  engine.update(objects, settings, execution);
  EXPECT_EQ(gainBound(engine, 0), 0);
  objects.dynamicObjects[0].worldFromObject = test::shift({ 0.4, -0.3, 0.2 });
  engine.update(objects, settings, execution);
  EXPECT_EQ(gainBound(engine, 0), kInfinity);
  settings.repairTimeBudget = 0;
  engine.update(objects, settings, execution);
  EXPECT_EQ(gainBound(engine, 0), 0);
}

namespace
{

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
    ASSERT_TRUE(!isLifted || !engine.stale());
    partial += numberOfStale(engine) > 0;
    if (numberOfStale(engine) == 0)
    {
      ++exact;
      EXPECT_TRUE(stalePower(engine).isZero());
      EXPECT_EQ(gainBound(engine, 0), 0);
      ASSERT_TRUE(answerOf(engine, scene.objects(), settings.separateSides) ==
        freshAnswer(scene.objects(), settings));
    }
    EXPECT_EQ(engine.statistics().shootSeconds > 0, step == 0) << "shot anew";
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
  for (std::size_t block = 0; block < engine.stale()->numberOfBlocks(); ++block)
  {
    for (const StaleMark& mark : engine.stale()->marks(block))
    {
      ++counts[mark.effect];
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

// The first 16 walks are finished regardless of the clock. The next batch reads it at every bounce;
// where that batch is interrupted, none of its walks counts.
TEST(RepairBudget, WhatIsHalfDoneIsDropped)
{
  test::ObjectBuilder room, ball;
  room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(0.95), true);
  room.addPointLight({ 1.5, 1.5, 1.5 }, 3);
  ball.addSphere({ 0, 0, 0 }, 0.7, 4, test::grey(0.95));
  SceneObjects objects{ room.build(), { ball.build() } };
  EngineSettings settings;
  settings.numberOfWalks = 500;
  settings.repairTimeBudget = 1e3;
  int dropped = 0;
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
    dropped += numberOfStale(engine) == found - 16;
  }
  EXPECT_GT(dropped, 25);
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
    EXPECT_EQ(engine.stale(), nullptr);
  }
  EXPECT_EQ(clock.ticks(), 0);
  const std::size_t bytes = engine.statistics().historyBytes;
  settings.repairTimeBudget = kNoTime;
  engine.update(scene.objects(), settings, clock);
  EXPECT_GT(engine.statistics().invalidWalks, 0);
  EXPECT_GT(numberOfStale(engine), 0u);
  const std::size_t held = engine.stale()->bytes();
  EXPECT_LE(held, 16 * numberOfStale(engine) + 16 * 16 + 4 * 80) << "16 bytes a stale walk";
  settings.repairTimeBudget = 0;
  engine.update(scene.objects(), settings, clock);
  EXPECT_EQ(engine.stale(), nullptr);
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
