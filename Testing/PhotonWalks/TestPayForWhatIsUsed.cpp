// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

#include <malloc.h>

namespace irradiance::test
{
namespace
{

TEST(PayForWhatIsUsed, NothingThatMovesNoHistory)
{
  SceneObjects objects = MovingScene(1, true, 61).objects();
  UpdatedEngine engine(objects, Shoot(5000)), still(objects, Shoot(5000).unverified());
  EXPECT_GT(engine.statistics().historyBytes, 0u);
  EXPECT_EQ(still.statistics().historyBytes, 0u) << "every frame is shot again";
  objects.dynamicObjects.clear();
  EXPECT_EQ(UpdatedEngine(objects, Shoot(5000)).statistics().historyBytes, 0u);
  engine.update(objects, Shoot(5000));
  EXPECT_EQ(engine.statistics().historyBytes, 0u) << "nothing moves any more";
}

// The tree over single moving triangles is for many objects of few triangles.
TEST(PayForWhatIsUsed, ManySmallObjectsAreFlattened)
{
  constexpr std::size_t kMany = 128;
  const auto plate = [](int triangles) {
    ObjectBuilder builder;
    builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, triangles / 2, 1, grey(0.5));
    return builder.build();
  };
  const auto flattenedOf = [](SceneObjects objects) {
    flattenManySmall(objects);
    return std::count_if(objects.dynamicObjects.begin(), objects.dynamicObjects.end(),
      [](const SceneObject& object) { return object.isFlattened; });
  };
  SceneObjects objects{ nothing(), { kMany - 1, plate(48) } };
  EXPECT_EQ(flattenedOf(objects), 0);
  objects.dynamicObjects.push_back(plate(50));
  EXPECT_EQ(flattenedOf(objects), 0);
  objects.dynamicObjects.push_back(plate(2));
  EXPECT_EQ(flattenedOf(objects), static_cast<std::ptrdiff_t>(kMany));
}

// The bytes are not counted again where nothing has moved, but they are known.
TEST(PayForWhatIsUsed, AStillFrameKnowsTheBytesOfItsHistory)
{
  const MovingScene scene(1, true, 61);
  EngineSettings settings = Shoot(5000).cached();
  UpdatedEngine engine(scene.objects(), settings);
  const std::size_t first = engine.statistics().historyBytes;
  SceneObjects moved = scene.objects();
  moved.dynamicObjects[0].worldFromObject.translation += Vector3(0.3, 0, 0);
  engine.update(moved, settings);
  const std::size_t second = engine.statistics().historyBytes;
  EXPECT_NE(second, first);
  engine.update(moved, settings);
  EXPECT_EQ(engine.statistics().historyBytes, second);
  settings.cacheStaticHits = false; // drops them
  engine.update(moved, settings);
  EXPECT_LT(engine.statistics().historyBytes, second);
}

// A segment holds its ends (12 bytes), a tag and its bounce (2), the triangle (4), the place on it
// (8), the walk (2), two links (4), and 8 for each of several bands. The last page of a block is
// half empty on average, and the first segments of a block may be the last of its walks.
TEST(PayForWhatIsUsed, HistoryHoldsWhatTheSceneNeeds)
{
  Shoot settings(5000);
  for (const int bands : { 1, 3 })
  {
    for (const bool sides : { false, true })
    {
      const SceneObjects objects = MovingScene(bands, false, 61).objects();
      settings.separateSides = sides;
      UpdatedEngine engine(objects, settings);
      const double perSegment =
        double(engine.statistics().historyBytes) / double(engine.balance().segments);
      const double perWalk = double(settings.numberOfWalks) / double(engine.balance().segments);
      const double needed = 32 + (bands > 1 ? 8 * bands : 0);
      const double pages = BouncePage::kSize / double(WalkPlan::kWalksPerBlock) * perWalk * needed;
      EXPECT_GE(perSegment, needed);
      EXPECT_LE(perSegment, needed + pages + perWalk); // a little for each block
    }
  }
}

// Law 7: one number for each cell, side and band; with error bars, one for each replicate.
TEST(PayForWhatIsUsed, NoErrorBarsNoReplicateSums)
{
  const SceneObjects objects = MovingScene(3, true, 73).objects();
  std::size_t cells = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    cells += objects[i].material->numberOfCells;
  }
  for (const std::uint32_t replicates : { 1u, 16u })
  {
    EngineSettings settings = Shoot(5000).errors(replicates);
    UpdatedEngine engine(objects, settings);
    EXPECT_EQ(engine.sums().bytes(), 2 * cells * 3 * 8 * replicates) << "two sides";
    EXPECT_EQ(engine.sums().rounds(), 1u);
    const std::size_t history = engine.statistics().historyBytes;
    settings.replicates = 1;
    engine.update(objects, settings);
    EXPECT_NEAR(double(history), double(engine.statistics().historyBytes), 0.03 * double(history))
      << "stored walks do not carry their replicate";
  }
}

TEST(PayForWhatIsUsed, MotionOutOfReachInvalidatesNothing)
{
  SceneObjects objects = MovingScene(1, true, 63).objects();
  Shoot settings(5000);
  UpdatedEngine engine;
  objects.dynamicObjects[0].worldFromObject = shift({ 50, 0, 0 });
  engine.update(objects, settings);
  for (int frame = 1; frame <= 5; ++frame)
  {
    objects.dynamicObjects[0].worldFromObject.translation[0] += frame;
    engine.update(objects, settings);
    EXPECT_EQ(engine.statistics().invalidWalks, 0);
    EXPECT_EQ(engine.statistics().repairedSegments, 0);
  }
}

TEST(PayForWhatIsUsed, NoLightNoWalks)
{
  SceneObjects objects = MovingScene(1, true, 64).objects();
  objects.staticObject.emission = nullptr;
  UpdatedEngine engine(objects, EngineSettings());
  EXPECT_FALSE(engine.hasLights());
  EXPECT_EQ(engine.balance().segments, 0);
  objects.dynamicObjects[0].worldFromObject.translation[0] += 0.5;
  engine.update(objects, EngineSettings());
  EXPECT_EQ(engine.statistics().invalidWalks, 0);
}

#if !defined(VTKIRRADIANCE_IS_SANITIZED) &&                                                        \
  defined(__GLIBC__) // sanitizers have a heap of their own

double heap()
{
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

struct Bytes
{
  double allocated, told;
};

Bytes bytesOf(const SceneObjects& objects, EngineSettings settings, std::uint32_t walks)
{
  settings.numberOfWalks = walks;
  const double before = heap();
  UpdatedEngine engine(objects, settings);
  return { heap() - before, static_cast<double>(engine.statistics().historyBytes) };
}

// The bytes that the engine tells are the bytes that it allocates: of more and fewer walks, so that the scene and what threads work with cancel out.
TEST(HistoryBytes, AreWhatIsAllocated)
{
  ObjectBuilder room = plainRoom({ 4, 4, 4 }, 12, grey(0.5)), thing;
  addPanel(room, { 1, 1, 3.75 }, 1, 1, 3);
  thing.addSphere({ 2, 2, 1 }, 0.5, 8, grey(0.5));
  const SceneObjects objects{ room.build(), { thing.build() } };
  for (const EngineSettings& settings : { Shoot(1), Shoot(1).gathered(),
         Shoot(1).gathered().errors(8), Shoot(1).finalGather(16).everywhere() })
  {
    const Bytes few = bytesOf(objects, settings, 150000), many = bytesOf(objects, settings, 600000);
    // Each of the largest vectors begins at a page of 2 MiB, and ends with one.
    EXPECT_NEAR((many.told - few.told) / (many.allocated - few.allocated), 1, 0.25);
    EXPECT_GT(many.told, 0.7 * many.allocated);
    EXPECT_LT(many.told, 1.05 * many.allocated);
  }
}

#endif

}
}
