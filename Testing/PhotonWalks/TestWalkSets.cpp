// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Views/WalkPaths.h"

// An engine has a set of walks for each group of lights. It follows motions to the bits of a new
// engine, and brings what one set with all lamps brings.

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kReplicates = 16;

EngineSettings withErrorBars(std::uint64_t seed, std::uint32_t walks)
{
  return Shoot(scaled(walks)).seeded(seed).errors(kReplicates);
}

TEST(WalkSets, ShareTheWalksByFlux)
{
  const MovingScene scene(1, true, 8);
  constexpr std::uint32_t kWalks = 10030; // in sixteens, its shares are not as the fluxes
  const WalkPlan plan(kWalks, 7 * kWalks, kReplicates);
  const std::vector<WalkSource> sources = sourcesOf(inTwoGroups(scene.objects()), plan);
  ASSERT_EQ(sources.size(), 2u);
  const LightTable all(scene.objects(), plan.most());
  std::uint32_t next = 0;
  for (const WalkSource& source : sources)
  {
    const double share = source.lights.flux() / all.flux();
    EXPECT_NEAR(source.plan.walksAfter(1), kWalks * share, kReplicates);
    EXPECT_EQ(source.plan.walksAfter(1) % kReplicates, 0u);
    ASSERT_EQ(source.plan.rounds().size(), 3u); // as often as it doubles below the limit
    EXPECT_EQ(source.plan.most(), 4 * source.plan.walksAfter(1));
    EXPECT_EQ(source.plan.rounds().front().firstWalk, next);
    next = source.plan.endWalk();
  }
  // As many watts in a quantum: quanta over flux are the same.
  EXPECT_NEAR(quantaPerWatt(sources[0]) / quantaPerWatt(sources[1]), 1, 1e-6);
}

TEST(WalkSets, OneGroupHasTheWholePlan)
{
  const MovingScene scene(3, true, 8);
  const WalkPlan plan(10000, 70000, kReplicates);
  const std::vector<WalkSource> sources = sourcesOf(scene.objects(), plan);
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_TRUE(sources.front().plan == plan);
  EXPECT_TRUE(sources.front().lights == LightTable(scene.objects(), plan.most()));
}

/// A path starts on a light of its group, and points of a path lie in the room.
TEST(WalkSets, PathsStartAtLightsOfTheirGroup)
{
  const MovingScene scene(1, true, 9);
  EngineSettings settings = withErrorBars(9, 5000);
  settings.keepPhotons = true;
  Execution serial;
  const SceneObjects objects = inTwoGroups(scene.objects());
  const UpdatedEngine engine(objects, settings);
  const WalkPaths paths(engine);
  const std::vector<std::uint32_t> all = paths.first(engine.numberOfWalks());
  ASSERT_EQ(all.size(), engine.numberOfWalks());
  const Vector3 point = objects.staticObject.emission->points.front().position;
  std::size_t atPoint = 0;
  for (const WalkPath& path : paths.paths(all, serial))
  {
    const bool isSecond = path.walk >= engine.walks().sets()[1].plan().rounds().front().firstWalk;
    EXPECT_EQ((path.points.front() - point).norm() < 1e-9, isSecond) << "walk " << path.walk;
    atPoint += isSecond ? 1 : 0;
  }
  // Some walks of each.
  EXPECT_GT(atPoint, 0u);
  EXPECT_LT(atPoint, all.size());
  std::size_t few = 0;
  for (const std::uint32_t walk : paths.first(100))
  {
    few += walk >= engine.walks().sets()[1].plan().rounds().front().firstWalk ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(few) / 100,
    static_cast<double>(atPoint) / static_cast<double>(all.size()), 0.011);
}

/// Of some 220 cells with an error bar, one is off by more than 5.5 standard errors (Student's t of
/// 15 degrees of freedom) in one run of 70.
TEST(WalkSets, TwoBringWhatOneWithAllLampsBrings)
{
  const MovingScene scene(1, true, 12);
  const UpdatedEngine one(scene.objects(), withErrorBars(3, 200000));
  const UpdatedEngine two(inTwoGroups(scene.objects()), withErrorBars(4, 200000));
  ASSERT_EQ(two.walks().sets().size(), 2u);
  EXPECT_NEAR(
    two.watts(two.balance().emitted.total()) / one.watts(one.balance().emitted.total()), 1, 1e-6);
  EXPECT_GT(expectAgreement(one, two), kIsSanitized ? 50 : 150);
}

}
}
