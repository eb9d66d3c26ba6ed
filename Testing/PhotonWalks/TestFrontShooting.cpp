// SPDX-License-Identifier: BSD-3-Clause
#include "FrontWorld.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kBlock = WalkPlan::kWalksPerBlock;

/// Kinds of scenes and tallies that take ways of their own through the stages.
struct Kind
{
  int bands;
  bool isClosed, isGlossy;
  WalkPlan plan;
};

std::vector<Kind> someKinds()
{
  const std::uint32_t walks = scaled(12000);
  return { { 1, true, false, WalkPlan(walks, walks, 1) },
    { 1, false, false, WalkPlan(walks, walks, 16) },
    { 1, true, true, WalkPlan(walks / 8, walks, 3, 500) }, // several rounds
    { 1, false, true, WalkPlan(walks, walks, 1) }, { 3, true, false, WalkPlan(walks, walks, 16) },
    { 3, false, true, WalkPlan(walks / 4, walks, 2) } };
}

Answer answerOf(const FrontRun& run, const Kind& kind, const SceneObjects& objects)
{
  Answer answer = answerOf(run, objects, true);
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
  for (std::size_t cell = 0; cell < sumsBefore.numbers().sizeOf(object); ++cell)
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

TEST(FrontShooting, NoPhotonIsLost)
{
  for (const Kind& kind : someKinds())
  {
    const MovingScene scene(kind.bands, kind.isClosed, 2, kind.isGlossy);
    const FrontWorld world(scene.objects(), kind.plan, 1);
    const FrontRun run(world, WalkFront::kUsualSize);
    const PowerBalance& balance = run.balance();
    EXPECT_EQ(balance.escaped.isZero(), kind.isClosed);
    Power arrived = balance.absorbed;
    arrived += balance.escaped;
    EXPECT_EQ(balance.emitted, arrived);
    double received = 0;
    CellNumbers(scene.objects()).forEach([&](const SceneCell& cell) {
      for (int band = 0; band < kind.bands; ++band)
      {
        received += run.sums().sum({ cell }, band);
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
    const auto expected = answerOf(FrontRun(world, WalkFront::kUsualSize), kind, scene.objects());
    for (const SimdLevel level : simdLevels())
    {
      const SimdLimit limit(level);
      for (const std::uint32_t together : { kBlock, 4 * kBlock, 333u })
      {
        EXPECT_EQ(answerOf(FrontRun(world, together), kind, scene.objects()), expected);
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
      EngineSettings settings = Shoot(kind.plan.most()).seeded(static_cast<std::uint64_t>(seed));
      UpdatedEngine engine(scene.objects(), settings);
      const FrontWorld world(scene.objects(), WalkPlan(kind.plan.most(), kind.plan.most(), 1),
        static_cast<std::uint64_t>(seed));
      const FrontRun run(world, WalkFront::kUsualSize);
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
        EXPECT_NEAR(ratio.mean(), 1, kIsSanitized ? 0.02 : 0.001);
      }
    }
  }
}

// A point light alone, and nothing around it.
TEST(FrontShooting, AllLightEscapesFromNothing)
{
  ObjectBuilder builder;
  builder.addPointLight({ 1, 2, 3 }, 5);
  builder.material().numberOfCells = 1;
  builder.material().reflectance.push_back(0.5);
  SceneObjects objects{ builder.build(), {} };
  objects.staticObject.emission = std::make_shared<Emission>(builder.emission());
  const FrontWorld world(objects, WalkPlan(1000, 1000, 1), 1);
  const FrontRun run(world, kBlock);
  EXPECT_EQ(run.balance().segments, 1000);
  EXPECT_EQ(run.balance().emitted, run.balance().escaped);
  EXPECT_EQ(run.balance().emitted, 1000 * world.stages().powerPerWalk());
}

}
}
