// SPDX-License-Identifier: BSD-3-Clause
#include "../RayCasting/TestSimdLevels.h"
#include "FrontWorld.h"
#include "MovingScene.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::FrontRun;
using test::FrontWorld;
using test::MovingScene;
using test::ReplicateMean;

constexpr std::uint32_t kBlock = WalkPlan::kWalksPerBlock;

/// Kinds of scenes and tallies that take ways of their own through the stages.
struct Kind
{
  int bands;
  bool isClosed, isGlossy;
  int sides;
  WalkPlan plan;
};

std::vector<Kind> someKinds()
{
  const std::uint32_t walks = test::scaled(12000);
  return { { 1, true, false, 1, WalkPlan(walks, walks, 1) },
    { 1, false, false, 2, WalkPlan(walks, walks, 16) },
    { 1, true, true, 1, WalkPlan(walks / 8, walks, 3, 500) }, // several rounds
    { 1, false, true, 2, WalkPlan(walks, walks, 1) },
    { 3, true, false, 1, WalkPlan(walks, walks, 16) },
    { 3, false, true, 2, WalkPlan(walks / 4, walks, 2) } };
}

test::Answer answerOf(const FrontRun& run, const Kind& kind, const SceneObjects& objects)
{
  test::Answer answer = test::answerOf(run, objects, kind.sides == 2);
  CellNumbers(objects).forEach([&](const SceneCell& cell) {
    for (std::uint32_t replicate = 0; replicate < kind.plan.replicates().count(); ++replicate)
    {
      for (std::size_t rounds = 1; rounds <= run.sums().rounds(); ++rounds)
      {
        answer.push_back(run.sums().sum({ cell, 0 }, 0, replicate, rounds));
      }
    }
  });
  return answer;
}

/// What one side of an object receives in all, over what it received before; nothing if it did not.
void addRatio(const CellSums& sumsBefore, const CellSums& sumsNow, std::uint32_t object, int side,
  ReplicateMean& ratio)
{
  double before = 0, now = 0;
  for (std::size_t cell = 0;
       side < sumsBefore.sides() && cell < sumsBefore.numbers().sizeOf(object); ++cell)
  {
    for (int band = 0; band < sumsBefore.bands(); ++band)
    {
      before += sumsBefore.sum({ { object, cell }, side }, band);
      now += sumsNow.sum({ { object, cell }, side }, band);
    }
  }
  if (before > 0)
  {
    ratio.add(now / before);
  }
}

}

TEST(FrontShooting, NoPhotonIsLost)
{
  for (const Kind& kind : someKinds())
  {
    const MovingScene scene(kind.bands, kind.isClosed, 2, kind.isGlossy);
    const FrontWorld world(scene.objects(), kind.plan, 1);
    const FrontRun run(world, kind.sides, WalkFront::kUsualSize);
    const PowerBalance& balance = run.balance();
    EXPECT_EQ(balance.escaped.isZero(), kind.isClosed);
    Power arrived = balance.absorbed;
    arrived += balance.escaped;
    EXPECT_EQ(balance.emitted, arrived);
    double received = 0;
    CellNumbers(scene.objects()).forEach([&](const SceneCell& cell) {
      for (int part = 0; part < kind.sides * kind.bands; ++part)
      {
        received += run.sums().sum({ cell, part % kind.sides }, part / kind.sides);
      }
    });
    EXPECT_EQ(balance.received, received);
    EXPECT_GT(balance.segments, static_cast<std::int64_t>(kind.plan.most()));
  }
}

// Also with walks that start in other fronts, with others, or go on when few are left.
TEST(FrontShooting, SameBitsForEveryFrontAndInstructionSet)
{
  for (const Kind& kind : someKinds())
  {
    const MovingScene scene(kind.bands, kind.isClosed, 2, kind.isGlossy);
    const FrontWorld world(scene.objects(), kind.plan, 1);
    const auto expected =
      answerOf(FrontRun(world, kind.sides, WalkFront::kUsualSize), kind, scene.objects());
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      for (const std::uint32_t together : { kBlock, 4 * kBlock, 333u })
      {
        EXPECT_EQ(answerOf(FrontRun(world, kind.sides, together), kind, scene.objects()), expected);
      }
    }
  }
}

// Both draw the same samples, so that most walks go the same way but for roundings to float. What
// all cells of an object receive on a side differs by chance alone: over 16 seeds, at most 14
// sides, |t| > 5 of 15 degrees in one of 450 choices of seeds for a kind.
TEST(FrontShooting, BringsWhatWalkBatchBrings)
{
  constexpr int kSeeds = 16;
  for (const Kind& kind : someKinds())
  {
    const MovingScene scene(kind.bands, kind.isClosed, 2, kind.isGlossy);
    std::vector<ReplicateMean> ratios(2 * scene.objects().size()); // by object and side
    for (int seed = 1; seed <= kSeeds; ++seed)
    {
      EngineSettings settings;
      settings.numberOfWalks = kind.plan.most();
      settings.seed = static_cast<std::uint64_t>(seed);
      settings.separateSides = kind.sides == 2;
      IrradianceEngine engine;
      Execution execution;
      engine.update(scene.objects(), settings, execution);
      const FrontWorld world(scene.objects(), WalkPlan(kind.plan.most(), kind.plan.most(), 1),
        static_cast<std::uint64_t>(seed));
      const FrontRun run(world, kind.sides, WalkFront::kUsualSize);
      for (std::uint32_t part = 0; part < ratios.size(); ++part)
      {
        addRatio(engine.sums(), run.sums(), part / 2, static_cast<int>(part % 2), ratios[part]);
      }
    }
    for (const ReplicateMean& ratio : ratios)
    {
      if (ratio.count() == kSeeds)
      {
        EXPECT_LE(std::abs(ratio.t(1)), 5);
        EXPECT_NEAR(ratio.mean(), 1, test::kIsSanitized ? 0.02 : 0.001);
        ratio.print("sums / those of WalkBatch", 1);
      }
    }
  }
}

// A furnace: every cell has a reflectance of its own and the exitance 1 - reflectance, so E = 1
// everywhere, on a box and a ball in the room as well. 8 areas, 16 seeds, |t| > 4 of 15 degrees: a
// false alarm in 0.9 % of all choices of seeds.
TEST(FrontShooting, EveryAreaOfAFurnaceReceivesOneWatt)
{
  constexpr int kCellsASide = 3;
  const std::uint32_t walks = test::scaled(30000);
  test::RandomVectors random(81);
  const auto shining = [&](test::ObjectBuilder builder) {
    Material& material = builder.material();
    for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
    {
      material.reflectance[cell] = random.uniform(0, 0.9);
      builder.emission().exitance[cell] = 1 - material.reflectance[cell];
    }
    return builder.build({ random.rotation(), Vector3(2, 1.5, 2.5) });
  };
  test::ObjectBuilder room, thing, ball;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 3, 5 }), kCellsASide, {}, true);
  thing.addBox(test::box({ -0.5, -0.3, -1.6 }, { 0.5, 0.3, -0.8 }), 1, {});
  ball.addSphere({ 0, 0, 0 }, 0.6, 4, {});
  SceneObjects objects{ shining(room), { shining(thing), shining(ball) } };
  objects.staticObject.worldFromObject = {};
  std::vector<ReplicateMean> areas;
  for (std::uint64_t seed = 1; seed <= 16; ++seed)
  {
    const FrontWorld world(objects, WalkPlan(walks, walks, 1), seed);
    const FrontRun run(world, 1, WalkFront::kUsualSize);
    EXPECT_TRUE(run.balance().escaped.isZero());
    const double wattsPerQuantum =
      world.lights().flux() / (static_cast<double>(world.lights().quantaPerWalk()) * walks);
    std::size_t number = 0;
    for (std::uint32_t object = 0; object < objects.size(); ++object)
    {
      const std::vector<double> cells = cellAreas(objects[object]);
      const std::size_t group = object == 0 ? kCellsASide * kCellsASide : cells.size();
      for (std::size_t first = 0; first < cells.size(); first += group)
      {
        double area = 0, watts = 0;
        for (std::size_t cell = first; cell < first + group; ++cell)
        {
          area += cells[cell];
          watts += wattsPerQuantum * run.sums().sum({ { object, cell } }, 0);
        }
        areas.resize(std::max(areas.size(), ++number));
        areas[number - 1].add(watts / area);
      }
    }
  }
  ASSERT_EQ(areas.size(), 8u);
  for (const ReplicateMean& area : areas)
  {
    area.print("area mean", 1);
    EXPECT_LE(std::abs(area.t(1)), 4);
    EXPECT_NEAR(area.mean(), 1, test::kIsSanitized ? 0.05 : 0.01);
  }
}

// A point light alone, and nothing around it.
TEST(FrontShooting, AllLightEscapesFromNothing)
{
  test::ObjectBuilder builder;
  builder.addPointLight({ 1, 2, 3 }, 5);
  builder.material().numberOfCells = 1;
  builder.material().reflectance.push_back(0.5);
  SceneObjects objects{ builder.build(), {} };
  objects.staticObject.emission = std::make_shared<Emission>(builder.emission());
  const FrontWorld world(objects, WalkPlan(1000, 1000, 1), 1);
  const FrontRun run(world, 1, kBlock);
  EXPECT_EQ(run.balance().segments, 1000);
  EXPECT_EQ(run.balance().emitted, run.balance().escaped);
  EXPECT_EQ(run.balance().emitted, 1000 * world.sampler().powerPerWalk());
}

}
