// SPDX-License-Identifier: BSD-3-Clause
// Laws 2 and 6: the same bits whatever the machine does, and whatever the unit of length is.

#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

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

TEST(SameBits, WithEveryBackendNumberOfThreadsAndTraversal)
{
  const auto expected = Compute("Sequential", 1, vtkIrradianceFilter::Parallel, true);
  ASSERT_FALSE(expected[0].IsEmpty());
  EXPECT_FALSE(IsSame(expected[0], expected[1])); // the move is seen
  struct Way
  {
    const char* Backend;
    int Threads, Mode;
    bool Caches;
  };
  std::vector<Way> ways;
  for (const int i : { 0, 1, 2 })
  {
    for (const char* backend : { "Sequential", "STDThread", "TBB" })
    {
      ways.push_back({ backend, 1 << i, vtkIrradianceFilter::Parallel, true });
    }
    ways.push_back({ "STDThread", 2, i, false });
    ways.push_back({ "STDThread", 2, i, true });
  }
  for (const Way& way : ways)
  {
    const auto bits = Compute(way.Backend, way.Threads, way.Mode, way.Caches);
    for (const std::size_t frame : { 0, 1 })
    {
      EXPECT_TRUE(IsSame(bits[frame], expected[frame]))
        << way.Backend << ", " << way.Threads << " threads, traversal " << way.Mode << ", cache "
        << way.Caches << ", frame " << frame;
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
    EXPECT_TRUE(UpdatesLike(verified, rebuilt)) << "frame " << frame;
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
  EXPECT_FALSE(UpdatesLike(one, two));
  two->SetSeed(1);
  EXPECT_TRUE(UpdatesLike(one, two));
}

namespace
{

/// The small scene with another light and turned things, all lengths times 2^k.
Scene MakeScaledScene(const Mesh& light, int k)
{
  const double factor = std::ldexp(1.0, k);
  vtkNew<vtkTransform> scale;
  scale->Scale(factor, factor, factor);
  Scene scene = MakeSmallScene();
  scene.Fixed[1] = light;
  for (Mesh& mesh : scene.Fixed)
  {
    mesh = Transformed(mesh, scale);
  }
  for (MovingObject& object : scene.Moving)
  {
    const double* place = object.Pose->GetPosition();
    object = MakeMoving(Transformed(object.Model, scale),
      { factor * place[0], factor * place[1], factor * place[2] });
    object.Pose->RotateWXYZ(33, 1, 2, 3);
  }
  return scene;
}

}

// Law 6: lengths times 2^k change nothing but the units.
TEST(SameBits, KeepsTheIrradianceOfAnExitanceAtAnyScaleAndDividesThatOfAFlux)
{
  for (const bool isLamp : { true, false })
  {
    const Mesh light = isLamp ? MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 })
                              : MakePointLight({ 1.5, 1.5, 2.5 }, { 60 });
    for (const int k : { -10, 7 })
    {
      for (const int directLight : { 0, 1 }) // shot, gathered
      {
        SCOPED_TRACE(testing::Message() << isLamp << ", k " << k << ", gathered " << directLight);
        const Scene original = MakeScaledScene(light, 0), scaled = MakeScaledScene(light, k);
        const auto one = MakeFilter(original, 3000), other = MakeFilter(scaled, 3000);
        one->SetDirectLight(directLight);
        other->SetDirectLight(directLight);
        for (int frame = 0; frame < 3; ++frame)
        {
          one->Update();
          other->Update();
          for (const auto& [port, i] : { std::pair(0u, 0u), { 0u, 1u }, { 1u, 0u }, { 1u, 1u } })
          {
            std::vector<double> expected = ValuesOf(IrradianceOf(one, port, i));
            for (double& value : expected)
            {
              value = std::ldexp(value, isLamp ? 0 : -2 * k);
            }
            EXPECT_EQ(ValuesOf(IrradianceOf(other, port, i)), expected);
          }
          ASSERT_GT(Field(one, "EmittedPower"), 0);
          for (const char* name : { "EmittedPower", "AbsorbedPower", "EscapedPower" })
          {
            EXPECT_EQ(Field(other, name), std::ldexp(Field(one, name), isLamp ? 2 * k : 0)) << name;
          }
          for (const char* name : { "NumberOfSegments", "NumberOfInvalidWalks" })
          {
            EXPECT_EQ(Field(other, name), Field(one, name)) << name;
          }
          original.Moving[0].Pose->Translate(0.25, 0.125, 0);
          scaled.Moving[0].Pose->Translate(std::ldexp(0.25, k), std::ldexp(0.125, k), 0);
        }
      }
    }
  }
}
