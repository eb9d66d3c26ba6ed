// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Views/WalkPaths.h"

// An engine has a set of walks for the lamps, and one for the sky.

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kReplicates = 16;

TEST(WalkSets, ShareTheWalksByFlux)
{
  const MovingScene scene(1, true, 8);
  constexpr std::uint32_t kWalks = 10030; // in sixteens, its shares are not as the fluxes
  const WalkPlan plan(kWalks, 7 * kWalks, kReplicates);
  const SceneObjects objects = underSky(scene.objects());
  const std::vector<WalkSource> sources = sourcesOf(objects, plan);
  ASSERT_EQ(sources.size(), 2u);
  const LightTable all(objects, plan.most());
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

TEST(WalkSets, OneHasTheWholePlan)
{
  const MovingScene scene(3, true, 8);
  const WalkPlan plan(10000, 70000, kReplicates);
  const std::vector<WalkSource> sources = sourcesOf(scene.objects(), plan);
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_TRUE(sources.front().plan == plan);
  EXPECT_TRUE(sources.front().lights == LightTable(scene.objects(), plan.most()));
}

/// A path starts on a light of its set.
TEST(WalkSets, PathsStartAtTheirLights)
{
  const MovingScene scene(1, true, 9);
  Execution serial;
  const SceneObjects objects = underSky(scene.objects());
  const UpdatedEngine engine(objects, Shoot(scaled(5000)).seeded(9).kept());
  ASSERT_EQ(engine.walks().sets().size(), 2u);
  const std::uint32_t firstOfSky = engine.walks().sets()[1].plan().rounds().front().firstWalk;
  const WalkPaths paths(engine);
  const std::vector<std::uint32_t> all = paths.first(engine.numberOfWalks());
  ASSERT_EQ(all.size(), engine.numberOfWalks());
  const Box room = objects.staticObject.worldBounds();
  std::size_t ofSky = 0;
  for (const WalkPath& path : paths.paths(all, serial))
  {
    const Vector3& start = path.points.front();
    const bool isInside = (start.array() >= room.lower.array() - 1e-6).all() &&
      (start.array() <= room.upper.array() + 1e-6).all();
    EXPECT_EQ(isInside, path.walk < firstOfSky) << "walk " << path.walk;
    ofSky += isInside ? 0 : 1;
  }
  // Some walks of each.
  EXPECT_GT(ofSky, 0u);
  EXPECT_LT(ofSky, all.size());
  const std::vector<std::uint32_t> some = paths.first(100);
  const auto few =
    std::count_if(some.begin(), some.end(), [&](std::uint32_t walk) { return walk >= firstOfSky; });
  EXPECT_NEAR(static_cast<double>(few) / 100,
    static_cast<double>(ofSky) / static_cast<double>(all.size()), 0.011);
}

}
}
