// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "TestScenes.h"
#include "TwoGroups.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::box;
using test::grey;
using test::ObjectBuilder;
using test::ReplicateMean;

constexpr std::uint64_t kBiasSeeds = 24;

/// Every cell reflects another part of the light, from .05 to .9.
SceneObject textured(ObjectBuilder builder, test::RandomVectors& random, const Vector3& place)
{
  for (double& reflectance : builder.material().reflectance)
  {
    reflectance = random.uniform(0.05, 0.9);
  }
  return builder.build(test::shift(place));
}

/// A closed room with a panel and a point light, a box that stands on the floor and a ball.
SceneObjects closedRoom()
{
  test::RandomVectors random(28);
  ObjectBuilder room, standing, ball;
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 6, {}, true);
  room.addQuad({ 1.5, 1.5, 2.9 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 50));
  room.addPointLight({ 3, 1, 1.5 }, 20);
  standing.addBox(box({ 0, 0, 0 }, { 0.8, 0.7, 1 }), 2, {});
  ball.addSphere({ 0, 0, 0 }, 0.5, 6, {});
  return { textured(room, random, { 0, 0, 0 }),
    { textured(standing, random, { 1, 2.5, 0 }), textured(ball, random, { 2.5, 1.5, 1 }) } };
}

/// Over seeds: the part of the power that escapes, and what six walls and two bodies receive, W.
struct Means
{
  ReplicateMean escaped;
  std::array<ReplicateMean, 8> received;

  Means(const SceneObjects& objects, bool isGathered)
  {
    for (std::uint64_t seed = 1; seed <= kBiasSeeds; ++seed)
    {
      EngineSettings settings;
      settings.numberOfWalks = test::scaled(200000);
      settings.seed = seed;
      settings.gathersDirectLight = isGathered;
      settings.verify = false;
      IrradianceEngine engine;
      Execution serial;
      engine.update(objects, settings, serial);
      const PowerBalance& balance = engine.balance();
      escaped.add(double(balance.escaped.total()) / double(balance.emitted.total()));
      for (std::size_t wall = 0; wall < 6; ++wall)
      {
        received[wall].add(test::wattsOn(engine, 0, 36 * wall, 36 * wall + 36));
      }
      for (std::uint32_t body : { 1u, 2u })
      {
        const std::size_t cells = objects[body].material->numberOfCells;
        received[5 + body].add(test::wattsOn(engine, body, 0, cells));
      }
    }
  }
};

}

// The mean of 24 seeds: nothing escapes but .1 %, and walls and bodies receive what they do where
// all light is shot, from all lights together or from two groups of them. 18 comparisons, |t| > 4
// with 23 degrees of freedom or more: a false alarm in 1 % of all choices of seeds.
TEST(GatheringBias, IsNoneInTheMeanOf24Seeds)
{
  const SceneObjects objects = closedRoom();
  const Means shot(objects, false);
  EXPECT_EQ(shot.escaped.mean(), 0);
  for (const SceneObjects& gathering : { objects, test::inTwoGroups(objects) })
  {
    const Means gathered(gathering, true);
    const double off = gathered.escaped.mean(), error = gathered.escaped.standardError();
    std::printf("%+.4f +- %.4f %% escape\n", 100 * off, 100 * error);
    EXPECT_LE(std::abs(off), 4 * error);
    if (!test::kIsSanitized)
    {
      EXPECT_LE(std::abs(off), 1e-3);
      EXPECT_LE(error, 3e-4) << "else a test of nothing";
    }
    for (std::size_t i = 0; i < shot.received.size(); ++i)
    {
      const ReplicateMean &a = gathered.received[i], &b = shot.received[i];
      const double together = std::hypot(a.standardError(), b.standardError());
      std::printf("%8.4f W, %+.3f %% of them more than shot, +- %.3f %% (shot alone %.3f %%)\n",
        a.mean(), 100 * (a.mean() / b.mean() - 1), 100 * together / b.mean(),
        100 * b.standardError() / b.mean());
      EXPECT_LE(std::abs(a.mean() - b.mean()), 4 * together) << i;
      EXPECT_TRUE(test::kIsSanitized || together < 3e-3 * b.mean()) << "else a test of nothing";
    }
  }
}

}
