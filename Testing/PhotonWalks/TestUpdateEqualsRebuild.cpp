// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "MovingScene.h"
#include "ThreadExecution.h"

#include <gtest/gtest.h>

#include <memory>

namespace irradiance
{

namespace
{

using test::answerOf;
using test::freshAnswer;
using test::MovingScene;
using test::scaled;

/// An engine with one of the ways to compute the same bits.
struct Variant
{
  EngineSettings settings;
  unsigned threads;
  IrradianceEngine engine;
};

std::vector<std::unique_ptr<Variant>> allVariants(const EngineSettings& common)
{
  std::vector<std::unique_ptr<Variant>> variants;
  for (const TraversalMode mode :
    { TraversalMode::OneTree, TraversalMode::Sequential, TraversalMode::Parallel })
  {
    for (const bool cache : { true, false })
    {
      for (const unsigned threads : { 1u, 2u })
      {
        variants.push_back(std::make_unique<Variant>());
        variants.back()->settings = common;
        variants.back()->settings.traversalMode = mode;
        variants.back()->settings.cacheStaticHits = cache;
        variants.back()->threads = threads;
      }
    }
  }
  return variants;
}

std::ostream& operator<<(std::ostream& out, const Variant& variant)
{
  return out << "traversal " << int(variant.settings.traversalMode) << ", cache "
             << variant.settings.cacheStaticHits << ", threads " << variant.threads;
}

void compareOverFrames(
  const EngineSettings& settings, int bands, bool isClosed, unsigned seed, bool isGlossy = false)
{
  MovingScene scene(bands, isClosed, seed, isGlossy);
  const auto variants = allVariants(settings);
  std::int64_t invalid = 0, repaired = 0;
  const int frames = test::kIsSanitized ? 12 : 40;
  for (int frame = 0; frame < frames; ++frame, scene.nextFrame())
  {
    const test::Answer fresh = freshAnswer(scene.objects(), settings);
    for (const auto& variant : variants)
    {
      test::ThreadExecution execution(variant->threads);
      variant->engine.update(scene.objects(), variant->settings, execution);
      ASSERT_TRUE(answerOf(variant->engine, scene.objects(), settings.separateSides) == fresh)
        << "scene " << seed << ", frame " << frame << ", " << *variant;
      EXPECT_EQ(variant->engine.statistics().shootSeconds > 0, frame == 0) << "shot again";
    }
    invalid += variants[0]->engine.statistics().invalidWalks;
    repaired += variants[0]->engine.statistics().repairedSegments;
  }
  EXPECT_GT(invalid, frames * std::int64_t{ settings.numberOfWalks } / 20);
  std::printf("scene %u: %.1f %% of the walks became invalid in a frame, %.2f segments each\n",
    seed, 100.0 * double(invalid) / frames / settings.numberOfWalks,
    double(repaired) / double(invalid));
}

}

TEST(UpdateEqualsRebuild, OverRandomFramesInAnOpenRoom)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(3000);
  compareOverFrames(settings, 1, false, 21);
}

TEST(UpdateEqualsRebuild, OverRandomFramesInColourWithSides)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(2000);
  settings.separateSides = true;
  settings.seed = 99;
  compareOverFrames(settings, 3, true, 22);
}

TEST(UpdateEqualsRebuild, OverRandomFramesWithGlossyWallsAndMirrors)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(2000);
  compareOverFrames(settings, 1, true, 24, true);
}

TEST(UpdateEqualsRebuild, OverRandomFramesWithGlossyWallsInColourWithSides)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(1000);
  settings.separateSides = true;
  compareOverFrames(settings, 3, false, 25, true);
}

TEST(UpdateEqualsRebuild, OverRandomFramesWithGatheredLight)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(3000);
  settings.gathersDirectLight = true;
  compareOverFrames(settings, 1, false, 26);
}

TEST(UpdateEqualsRebuild, OverRandomFramesWithGatheredLightInColourWithSidesAndReplicates)
{
  EngineSettings settings;
  settings.numberOfWalks = scaled(1000);
  settings.gathersDirectLight = true;
  settings.separateSides = true;
  settings.replicates = 3;
  compareOverFrames(settings, 3, false, 27, true);
}

// 10,000 frames out and the same 10,000 back: nothing drifts, nothing is left behind.
TEST(UpdateEqualsRebuild, ThereAndBackRestoresEveryBit)
{
  const int frames = test::kIsSanitized ? 250 : 10000;
  MovingScene scene(1, false, 23);
  SceneObjects objects = scene.objects();
  EngineSettings settings;
  settings.numberOfWalks = 100;
  IrradianceEngine engine;
  Execution execution;
  const auto pose = [&](int frame) {
    for (std::size_t i = 0; i < 3; ++i)
    {
      AffineMap& map = objects.dynamicObjects[i].worldFromObject;
      const double angle = 0.001 * frame * double(i + 1);
      map.linear = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
      map.translation = Vector3(2 + std::sin(angle), 2 + std::cos(1.7 * angle), 1.0 + double(i));
    }
  };
  pose(0);
  engine.update(objects, settings, execution);
  const test::Answer first = answerOf(engine, objects);
  std::int64_t invalid = 0;
  for (int step = 1; step <= 2 * frames; ++step)
  {
    pose(step <= frames ? step : 2 * frames - step);
    engine.update(objects, settings, execution);
    invalid += engine.statistics().invalidWalks;
  }
  EXPECT_TRUE(answerOf(engine, objects) == first);
  EXPECT_TRUE(freshAnswer(objects, settings) == first);
  EXPECT_GT(invalid, frames);
  std::printf("%d frames, %ld walks repaired\n", 2 * frames, long(invalid));
}

// Poses that are equal as numbers but differ in the sign of a zero.
TEST(UpdateEqualsRebuild, SignOfAZeroInAPose)
{
  test::ObjectBuilder room, wall;
  room.addBox(test::box({ -2, -2, -2 }, { 2, 2, 2 }), 2, test::grey(0.5), true);
  room.addPointLight({ 1, 1, 1 }, 1);
  wall.addQuad({ -1, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 2, test::grey(0.9));
  wall.addQuad({ 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2, test::grey(0.9));
  EngineSettings settings;
  settings.numberOfWalks = 2000;
  SceneObjects objects{ room.build(), { wall.build() } };
  for (unsigned signs = 0; signs < 4096; signs += 31)
  {
    IrradianceEngine engine;
    Execution execution;
    AffineMap& pose = objects.dynamicObjects[0].worldFromObject;
    pose = {};
    engine.update(objects, settings, execution);
    for (int i = 0; i < 12; ++i)
    {
      double& entry = i < 9 ? pose.linear(i / 3, i % 3) : pose.translation[i - 9];
      entry = entry == 0 && (signs >> i & 1u) != 0 ? -0.0 : entry;
    }
    engine.update(objects, settings, execution);
    ASSERT_TRUE(answerOf(engine, objects) == freshAnswer(objects, settings)) << "signs " << signs;
  }
}

}
