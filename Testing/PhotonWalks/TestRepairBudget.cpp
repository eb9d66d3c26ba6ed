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
  TickingExecution clock;
  UpdatedEngine engine(scene.objects(), settings, clock);
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
  TickingExecution clock;
  UpdatedEngine engine(scene.objects(), settings, clock);
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
    TickingExecution clock;
    UpdatedEngine engine(scene.objects(), settings, clock);
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

// Stale light loses and gains no more than the bounds say.

/// Checks both bounds, in quanta, and records how much of them is used.
class BoundCheck
{
public:
  void compare(const IrradianceEngine& now, const IrradianceEngine& full)
  {
    std::array<double, Power::kMaxBands> brought{}; // to all cells by the new tails
    const CellSums* staleSums = now.walks().staleSums();
    forEachSide(now.objects(), now.settings().separateSides, [&](const CellSide& side, int band) {
      const double before = now.sums().sum(side, band), after = full.sums().sum(side, band);
      const double tail = staleSums ? staleSums->sum(side, band) : 0;
      ASSERT_GE(tail, 0);
      const double rounding = 0x1p-50 * before; // what was gathered is no whole number
      ASSERT_GE(after, before - tail - rounding) << side.object << ", cell " << side.cell;
      largestLoss = std::max(largestLoss, tail > 0 ? (before - after) / tail : 0);
      brought[static_cast<std::size_t>(band)] += after - (before - tail);
    });
    for (int band = 0; band < now.sums().bands(); ++band)
    {
      const double bound = now.walks().staleGainBound(band);
      const double gain = brought[static_cast<std::size_t>(band)];
      ASSERT_LE(gain, bound) << "band " << band;
      largestGain = std::max(largestGain, bound > 0 ? gain / bound : 0);
    }
  }

  double largestLoss = 0, largestGain = 0;
};

struct Share
{
  double ofFullRepair;
  UpdatedEngine engine = {};
  BoundCheck check = {};
  double left = 0; ///< part of the walks left stale, mean over the frames
};

void checkBounds(
  const EngineSettings& common, int bands, bool isClosed, unsigned seed, bool isGlossy = false)
{
  const int frames = kIsSanitized ? 15 : 40;
  MovingScene scene(bands, isClosed, seed, isGlossy);
  UpdatedEngine full, timed;
  Share shares[] = { { 0 }, { 0.1 }, { 0.5 } };
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.nextFrame();
    full.update(scene.objects(), common);
    TickingExecution clock;
    EngineSettings settings = common;
    settings.repairTimeBudget = 1e9;
    timed.update(scene.objects(), settings, clock);
    const Answer expected = answerOf(full, scene.objects(), common.separateSides);
    ASSERT_TRUE(answerOf(timed, scene.objects(), common.separateSides) == expected);
    for (Share& share : shares)
    {
      if (frame % 8 == 0) // a full repair now and then, so that at times few walks wait
      {
        share.engine.update(scene.objects(), common);
        continue;
      }
      TickingExecution own;
      settings.repairTimeBudget =
        std::max(kNoTime, share.ofFullRepair * TickingExecution::kTick * double(clock.ticks()));
      share.engine.update(scene.objects(), settings, own);
      expectBalance(share.engine);
      ASSERT_NO_FATAL_FAILURE(share.check.compare(share.engine, full))
        << "frame " << frame << ", " << share.ofFullRepair << " of the full repair";
      share.left += double(numberOfStale(share.engine)) / common.numberOfWalks / frames;
    }
  }
  for (Share& share : shares)
  {
    EXPECT_GT(share.left, 0.01);
    EXPECT_GT(share.check.largestLoss, 0.5) << "the bound says nothing";
    EXPECT_GT(share.check.largestGain, 0.3) << "the bound says nothing";
    share.engine.update(scene.objects(), common); // the budget is lifted
    EXPECT_TRUE(answerOf(share.engine, scene.objects(), common.separateSides) ==
      answerOf(full, scene.objects(), common.separateSides));
  }
}

TEST(RepairBudget, BoundsHoldInAnOpenRoom)
{
  checkBounds(Shoot(scaled(3000)), 1, false, 31);
}

TEST(RepairBudget, BoundsHoldInColourWithSides)
{
  checkBounds(Shoot(scaled(3000)).bySide().seeded(5), 3, true, 32);
}

// Walks that are still to be born count as stale.
TEST(RepairBudget, BoundsHoldWithGatheredLight)
{
  checkBounds(Shoot(scaled(3000)).gathered(), 1, false, 34);
  checkBounds(Shoot(scaled(3000)).gathered().bySide(), 3, true, 35);
}

TEST(RepairBudget, BoundsHoldWithGlossyCells)
{
  checkBounds(Shoot(scaled(1000)), 1, true, 33, true);
}

// Where nothing escapes and all cells reflect alike, walks do what the bound assumes and attain it
// to the quantum.
TEST(RepairBudget, GainBoundIsReachedInAFurnace)
{
  for (const double reflectance : { 0.0, 0.3, 0.8, 0.99 })
  {
    SceneObjects objects = ballInARoom(reflectance, reflectance);
    const EngineSettings settings = Shoot(5000).budget(kNoTime); // a few hundred become stale
    UpdatedEngine now(objects, settings);
    objects.dynamicObjects[0].worldFromObject = shift({ 0.4, -0.3, 0.2 });
    now.update(objects, settings);
    ASSERT_EQ(now.balance().escaped[0], 0);
    const UpdatedEngine full(objects, settings);
    double brought = 0;
    now.cells().numbers().forEach([&](const SceneCell& cell) {
      brought += full.sums().sum({ cell }, 0) - now.sums().sum({ cell }, 0) +
        onlySet(now).stale()->sums().sum({ cell }, 0);
    });
    EXPECT_GT(brought, 0);
    EXPECT_EQ(brought, now.walks().staleGainBound(0)) << "reflectance " << reflectance;
    // A walk survives with probability = reflectance: power / (1 - reflectance), within 5 standard
    // errors (one false alarm in 10^6). The standard deviation of a walk's tail is at most about
    // its mean.
    const double mean = double(now.stalePower()[0]) / (1 - reflectance);
    EXPECT_NEAR(
      brought, mean, 5 * mean / std::sqrt(double(numberOfStale(now))) + double(numberOfStale(now)));
  }
}

TEST(RepairBudget, NoGainBoundWhereNearlyAllIsReflected)
{
  SceneObjects objects = ballInARoom(0.5, 0.999);
  UpdatedEngine engine(objects, Shoot(2000).budget(kNoTime));
  EXPECT_EQ(engine.walks().staleGainBound(0), 0);
  objects.dynamicObjects[0].worldFromObject = shift({ 0.4, -0.3, 0.2 });
  engine.update(objects, Shoot(2000).budget(kNoTime));
  EXPECT_EQ(engine.walks().staleGainBound(0), kInfinity);
  engine.update(objects, Shoot(2000));
  EXPECT_EQ(engine.walks().staleGainBound(0), 0);
}

}
}
