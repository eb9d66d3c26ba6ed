// SPDX-License-Identifier: BSD-3-Clause
// Stale light loses and gains no more than the bounds say.

#include "EngineRun.h"
#include "MovingScene.h"
#include "OnlySet.h"
#include "StaleLight.h"
#include "TickingExecution.h"

#include <memory>

namespace irradiance
{

namespace
{

using test::answerOf;
using test::expectBalance;
using test::kNoTime;
using test::MovingScene;
using test::numberOfStale;
using test::scaled;
using test::TickingExecution;

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
        const double before = now.sums().sum({ object, cell, side }, band);
        const double after = full.sums().sum({ object, cell, side }, band);
        const CellSums* staleSums = now.walks().staleSums();
        const double tail = staleSums ? staleSums->sum({ object, cell, side }, band) : 0;
        ASSERT_GE(tail, 0);
        const double rounding = 0x1p-50 * before; // what was gathered is no whole number
        ASSERT_GE(after, before - tail - rounding) << "object " << object << ", cell " << cell;
        largestLoss_ = std::max(largestLoss_, tail > 0 ? double(before - after) / double(tail) : 0);
        brought += double(after - (before - tail));
        stale += double(tail);
      });
      const double bound = now.walks().staleGainBound(band);
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

// Walks that are still to be born count as stale.
TEST(RepairBudget, BoundsHoldWithGatheredLight)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(3000);
  settings.gathersDirectLight = true;
  checkBounds(settings, 1, false, 34);
  settings.separateSides = true;
  checkBounds(settings, 3, true, 35);
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
        brought +=
          double(full.sums().sum({ object, cell }, 0) - now.sums().sum({ object, cell }, 0) +
            test::onlySet(now).stale()->sums().sum({ object, cell }, 0));
      }
    }
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
  EXPECT_EQ(engine.walks().staleGainBound(0), 0);
  objects.dynamicObjects[0].worldFromObject = test::shift({ 0.4, -0.3, 0.2 });
  engine.update(objects, settings, execution);
  EXPECT_EQ(engine.walks().staleGainBound(0), kInfinity);
  settings.repairTimeBudget = 0;
  engine.update(objects, settings, execution);
  EXPECT_EQ(engine.walks().staleGainBound(0), 0);
}

}
