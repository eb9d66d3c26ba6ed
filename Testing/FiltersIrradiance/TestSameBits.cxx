// SPDX-License-Identifier: BSD-3-Clause
// Law 2: the same bits whatever the machine does.

#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// The first frame, and the update after a move.
std::array<OutputBits, 2> Compute(const char* backend, int threads, int mode, bool cache)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 20000);
  filter->SetTraversalMode(mode);
  filter->SetCacheStaticHits(cache);
  const auto update = [&] {
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config{ threads, backend, false }, [&] { filter->Update(); });
    return OutputBits(filter);
  };
  const OutputBits first = update();
  scene.Moving[0].Pose->Translate(0.5, 0.2, 0.1);
  return { first, update() };
}

}

TEST(SameBits, WithEveryBackendAndNumberOfThreads)
{
  const auto expected = Compute("Sequential", 1, vtkIrradianceFilter::Parallel, true);
  ASSERT_FALSE(expected[0].IsEmpty());
  EXPECT_FALSE(IsSame(expected[0], expected[1])); // the move is seen
  for (const char* backend : { "Sequential", "STDThread", "TBB" })
  {
    for (const int threads : { 1, 2, 4 })
    {
      const auto bits = Compute(backend, threads, vtkIrradianceFilter::Parallel, true);
      EXPECT_TRUE(IsSame(bits[0], expected[0])) << backend << ", " << threads << " threads";
      EXPECT_TRUE(IsSame(bits[1], expected[1]))
        << backend << ", " << threads << " threads, after the move";
    }
  }
}

TEST(SameBits, WithEveryTraversalAndWithoutTheCache)
{
  const auto expected = Compute("Sequential", 1, vtkIrradianceFilter::OneTree, false);
  for (const int mode : { 0, 1, 2 })
  {
    for (const bool cache : { false, true })
    {
      const auto bits = Compute("STDThread", 2, mode, cache);
      EXPECT_TRUE(IsSame(bits[0], expected[0])) << "traversal " << mode << ", cache " << cache;
      EXPECT_TRUE(IsSame(bits[1], expected[1]))
        << "traversal " << mode << ", cache " << cache << ", after the move";
    }
  }
}

TEST(SameBits, WhetherFramesAreVerifiedOrRebuilt)
{
  const Scene scene = MakeSmallScene();
  const auto verified = MakeFilter(scene, 5000), rebuilt = MakeFilter(scene, 5000);
  rebuilt->SetUpdateModeToRebuild();
  for (int frame = 0; frame < 4; ++frame)
  {
    verified->Update();
    rebuilt->Update();
    EXPECT_TRUE(IsSame(OutputBits(verified), OutputBits(rebuilt))) << "frame " << frame;
    scene.Moving[1].Pose->RotateZ(20);
  }
  EXPECT_EQ(Field(verified, "ShootSeconds"), 0);
  EXPECT_GT(Field(rebuilt, "ShootSeconds"), 0);
}

TEST(SameBits, AnotherSeedIsAnotherResult)
{
  const Scene scene = MakeSmallScene();
  const auto one = MakeFilter(scene, 2000), two = MakeFilter(scene, 2000);
  two->SetSeed(2);
  one->Update();
  two->Update();
  EXPECT_FALSE(IsSame(OutputBits(one), OutputBits(two)));
  two->SetSeed(1);
  two->Update();
  EXPECT_TRUE(IsSame(OutputBits(one), OutputBits(two)));
}
