// SPDX-License-Identifier: BSD-3-Clause
// Stale light loses and gains no more than the bounds say.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

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
