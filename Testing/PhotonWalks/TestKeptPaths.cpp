// SPDX-License-Identifier: BSD-3-Clause
// The paths of a final gather that are kept over motions: those that nothing touches, and no other.

#include "Kit.h"
#include "Surfaces/CoincidentTriangles.h"

namespace irradiance::test
{
namespace
{

/// An engine that follows a scene, each frame to the bits of a new one.
struct Followed
{
  SceneObjects objects;
  EngineSettings settings;
  UpdatedEngine engine = {};

  AffineMap& pose(std::size_t object) { return objects.dynamicObjects[object].worldFromObject; }
  /// Returns how many paths were followed.
  std::int64_t update()
  {
    engine.update(objects, settings);
    EXPECT_TRUE(isShownAsFresh(engine));
    return engine.statistics().followedPaths;
  }
  /// Of all frames in which the coarse part is there, on the average.
  double meanOver(const std::vector<Vector3>& places)
  {
    std::int64_t followed = 0;
    for (const Vector3& place : places)
    {
      pose(0).translation = place;
      followed += update();
    }
    return static_cast<double>(followed) / static_cast<double>(places.size());
  }
};

Followed statue(const EngineSettings& settings, const Vector3& corner = { 0, 0, 0 }, int bands = 1)
{
  return { roomWithStatue(corner, bands), settings };
}

const Shoot kGathering = Shoot(30000).finalGather(32);

// Here and there; touching the statue; on the lamp; and away by little. Where floats tell
// millimetres, and where they tell eighths of the room.
TEST(KeptPaths, AreThoseThatNothingTouches)
{
  for (const auto& [bands, offset] :
    { std::pair(1, 0.0), std::pair(3, 0.0), std::pair(1, 1e5), std::pair(1, 1e7) })
  {
    const Vector3 corner(offset, -offset, 0.5 * offset);
    Followed scene = statue(kGathering, corner, bands);
    const auto all = static_cast<double>(scene.update());
    EXPECT_GT(all, 2 * 32 * 6 * 16);
    EXPECT_EQ(scene.update(), 0) << "nothing has moved";
    RandomVectors random(91);
    for (int round = 0; round < (kIsSanitized ? 1 : 2); ++round)
    {
      scene.pose(0).linear = random.rotation();
      const Vector3 anywhere = Vector3(1.5, 1, 1.5).cwiseProduct(random.inCube());
      double part = scene.meanOver({ corner + Vector3(2, 1.5, 2) + anywhere }) / 4;
      scene.pose(0).linear = Matrix3::Identity();
      part += 0.75 *
        scene.meanOver({ corner + Vector3(2.75, 1.25, 0.75), corner + Vector3(0.75, 0.75, 0.25),
          corner + Vector3(0.75, 0.75, 0.251) });
      EXPECT_GT(part, 0);
      EXPECT_LT(part, (offset > 1e6 ? 1.0 : 0.25) * all) << offset;
    }
    scene.pose(1).translation += Vector3(0.1, 0, 0);
    const std::int64_t followed = scene.update();
    EXPECT_LT(followed, all);
    EXPECT_GT(followed, 32) << "what moves gathers anew";
  }
}

// The lights are asked at each hit. Most of their rays are of no interest to a motion either, but
// some arrive now, and some no longer.
TEST(KeptPaths, KeepTheRaysOfLights)
{
  for (const int bands : { 1, 3 })
  {
    Followed scene = statue(Shoot(30000).finalGather(8).unbiased(), { 0, 0, 0 }, bands);
    const auto all = static_cast<double>(scene.update());
    const double mean =
      scene.meanOver({ { 2, 1.2, 0.7 }, { 1.6, 0.9, 0.6 }, { 3, 2, 2 }, { 0.75, 0.75, 0.5 } });
    EXPECT_GT(mean, 0);
    EXPECT_LT(mean, 0.6 * all);
  }
}

// A small block passes few of their ways and of the rays of lights: in the air; touching the
// statue; over the lamp; and away by little.
TEST(KeptPaths, KeepTheirChecks)
{
  for (const int bands : { 1, 3 })
  {
    Followed scene = statue(Shoot(kGathering).errors(4), { 0, 0, 0 }, bands);
    scene.pose(0).linear *= 0.05;
    const auto all = static_cast<double>(scene.update());
    EXPECT_EQ(scene.update(), 0) << "nothing has moved";
    for (const Vector3& place : { Vector3(3, 2, 2), Vector3(2.525, 1.25, 0.75),
           Vector3(0.75, 0.75, 0.3), Vector3(0.75, 0.75, 0.301) })
    {
      EXPECT_LT(scene.meanOver({ place }), 0.04 * all);
    }
  }
}

// A lamp and a white sheet lie in one plane over a statue, and a block stands on the lamp, so
// closely that rays from below come to it first. Then the lamp, which it touches, is before it;
// without it the sheet is before the lamp. So hits on what never moves change, though the block,
// which is too large to gather, goes where no ray is.
TEST(KeptPaths, KnowThatContactsDecide)
{
  ObjectBuilder room = plainRoom({ 4, 4, 4 }, 6, grey(0.5)), block;
  room.addQuad({ 1.5, 1.5, 2 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0, 20));
  room.addQuad({ 1.5, 1.5, 2 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0.9));
  room.addBox(box({ 1.8, 1.8, 0.2 }, { 2.2, 2.2, 0.4 }), 6, grey(0.5));
  block.addBox(box({ -0.3, -0.3, 0 }, { 0.3, 0.3, 0.6 }), 1, grey(0.5));
  for (const bool isUnbiased : { false, true })
  {
    Followed scene{ { room.build(), { block.build(shift({ 2, 2, 2 - 0.25 * kTouching })) } },
      Shoot(kGathering).errors(4) };
    scene.settings.unbiasedGather = isUnbiased;
    scene.update();
    scene.pose(0) = shift({ 0.5, 0.5, 3 });
    scene.update();
    EXPECT_EQ(scene.engine.statistics().shootSeconds, 0);
  }
}

// What paths depend on besides poses.
TEST(KeptPaths, AreForgottenWhenAnythingElseChanges)
{
  Followed scene = statue(kGathering);
  scene.update();
  const std::function<void()> changes[] = { [&] { scene.settings.gatherRays = 24; },
    [&] { scene.settings.seed = 2; }, [&] { scene.settings.replicates = 4; },
    [&] { scene.settings.numberOfWalks = 60000; }, // other cells are large
    [&] {
      scene.objects.staticObject = roomWithStatue({ 0, 0, 0.5 }).staticObject;
    },
    [&] { scene.objects.dynamicObjects[1].isPresent = false; }, // other cells gather
    [&] { scene.objects.dynamicObjects[1].isPresent = true; },
    [&] { scene.settings.verify = false; }, [] {} }; // nothing is to be kept
  for (const auto& change : changes)
  {
    change();
    EXPECT_GE(scene.update(), 2 * 24 * 6 * 16) << "change " << &change - changes;
  }
}

}
}
