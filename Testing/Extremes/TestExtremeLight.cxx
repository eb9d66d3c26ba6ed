// SPDX-License-Identifier: BSD-3-Clause
// Very weak and very strong lights, and rooms that hardly absorb.

#include "ExtremeScenes.h"

#include <cstdio>

using namespace ExtremeScenes;

class ExtremePower : public testing::TestWithParam<double>
{
};

// The furnace again; see TestExtremeLengths for the deviation.
TEST_P(ExtremePower, TheFurnaceHolds)
{
  constexpr vtkIdType kWalks = 20000;
  const double level = GetParam();
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }, 0.5, level) },
    { MakeMoving(White(MakeBox(0.3, 0.2, 0.25)), { 0.4, 0.5, 0.6 }) } };
  const auto filter = MakeFilter(scene, kWalks);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(Field(filter, "EmittedPower") / (3 * level), 1, 1e-12);
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0) / level, 1, 0.0125);
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Watts, ExtremePower, testing::Values(1e-200, 1e-12, 1e-6, 1e6, 1e12, 1e30),
  [](const auto& info) { return "Number" + std::to_string(info.index); });

// Lights of 1e-12 W and of 1e12 W in one scene: the sum is right; no walk starts at the weak one.
TEST(ExtremeLight, WeakBesideStrong)
{
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }), MakePointLight({ 0.5, 0.5, 0.5 }, { 1e12 }),
                 MakePointLight({ 0.2, 0.5, 0.5 }, { 1e-12 }) },
    {} };
  const auto filter = MakeFilter(scene, 10000);
  ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
  EXPECT_NEAR(Field(filter, "EmittedPower") / 1e12, 1, 1e-11);
}

// Walks of 10,000 bounces on average: 5 million segments, none of which may leak. A walk that ends with
// a chance of 1e-4 at each bounce brings as much as the mean, give or take the mean.
TEST(ExtremeLight, Reflectance09999)
{
  const vtkIdType walks = IsThorough() ? 2000 : 500;
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }, 0.9999) },
    { MakeMoving(White(MakeBox(0.3, 0.2, 0.25)), { 0.4, 0.5, 0.6 }) } };
  const auto filter = MakeFilter(scene, walks);
  ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
  std::printf("%.0f segments, mean irradiance %.4f\n", Field(filter, "NumberOfSegments"),
    MeanIrradiance(filter, 0, 0));
  EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 5 / std::sqrt(double(walks)));
}

TEST(ExtremeLight, BeyondAreRefusedInWords)
{
  EXPECT_NE(ErrorOf({ { MakeFurnace(1, { 0, 0, 0 }, 0.5, 1e31) }, {} }).find("exitance 5e+30"),
    std::string::npos);
  // No power is absorbed, so no walk ends.
  Mesh room = MakeFurnace(1, { 0, 0, 0 });
  SetCellValues(room, "DiffuseReflectance", { 1 });
  EXPECT_NE(ErrorOf({ { room }, {} }, 3).find("too near 1"), std::string::npos);
  // Too weak for a double: no light, and a warning.
  const auto filter = MakeFilter({ { MakeFurnace(1, { 0, 0, 0 }, 0.5, 1e-322) }, {} }, 100);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_NE(observer->Warnings[0].find("no light"), std::string::npos);
}
