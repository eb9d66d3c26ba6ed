// SPDX-License-Identifier: BSD-3-Clause
// Very small and very large scenes, scenes far away, slivers, and small objects in large halls.

#include "ExtremeScenes.h"

using namespace ExtremeScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 20000;

/// A furnace with a white box and a white ball that move in it. At reflectance 0.5 a walk brings 2
/// with a standard deviation of 0.354 (a geometric tail of quarters), so the mean irradiance of the
/// room is 1 within 5 standard deviations, a false alarm in 2 million; so it is in repaired frames.
void ExpectDiffuseFurnace(double size, const Vector& offset)
{
  ExpectFurnace(
    { MakeFurnace(size, offset), White(MakeBox(0.3, 0.2, 0.25)), White(MakeBall(0.15, 24)) }, size,
    offset, NumberOfWalks, 5 * 0.177 / std::sqrt(1.0 * NumberOfWalks) + 0.005);
}

}

class ExtremeScale : public testing::TestWithParam<double>
{
};

TEST_P(ExtremeScale, TheFurnaceHolds)
{
  ExpectDiffuseFurnace(GetParam(), { 0, 0, 0 });
}

INSTANTIATE_TEST_SUITE_P(Metres, ExtremeScale,
  testing::Values(1e-28, 1e-12, 1e-6, 1.0, 1e6, 1e12, 1e28),
  [](const auto& info) { return "Number" + std::to_string(info.index); });

class ExtremeOffset : public testing::TestWithParam<double>
{
};

// In units of the room, whose size is not 1 m, so that size and offset both matter.
TEST_P(ExtremeOffset, TheFurnaceHolds)
{
  const double size = 0.01, far = GetParam() * size;
  ExpectDiffuseFurnace(size, { far, -0.7 * far, 0.4 * far });
}

INSTANTIATE_TEST_SUITE_P(Sizes, ExtremeOffset, testing::Values(10.0, 1e3, 1e5, 1e6, 1e7),
  [](const auto& info) { return "Number" + std::to_string(info.index); });

// Far away, a walk that hits beside an edge, here the floor's diagonal, continues a good way from
// there. A ball that rolls there hits segments that do not end where the next ones begin.
TEST(ExtremeLengths, ABallRollsOverAnEdgeFarAway)
{
  const Vector offset{ 1e7, -1e7, 4e6 };
  Scene scene{ { MakeFurnace(1, offset, 0.5, 1, 1) },
    { MakeMovingIn(White(MakeBall(0.04, 16)), 1, offset, { 0.2, 0.2, 0.045 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 12; ++frame)
  {
    SCOPED_TRACE(frame);
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    scene.Moving[0].Pose->Translate(0.05, 0.05, 0);
  }
}

TEST(ExtremeSliver, StripsOfAspect1e6)
{
  // A sheet 1e-6 thick and a needle 7e-7 wide.
  Scene scene{ MakeFurnaceOfStrips(),
    { MakeMoving(White(Placed(MakeBox(0.5, 0.5, 1e-6), 1, { 0, 0, 0 })), { 0.4, 0.5, 0.6 }),
      MakeMoving(White(Placed(MakeBox(0.7, 7e-7, 7e-7), 1, { 0, 0, 0 })), { 0.5, 0.4, 0.3 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 4; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 0.02);
    EXPECT_NEAR(MeanIrradiance(filter, 0, 1), 1, 0.06);
    EXPECT_NEAR(MeanIrradiance(filter, 1, 0), 1, 0.1);
    scene.Moving[0].Pose->RotateWXYZ(40, 1, 0.3, 0.2);
    scene.Moving[1].Pose->RotateWXYZ(33, 0.1, 0.3, 1);
  }
}

// A square of 1 cm that lies 1 cm under a light, in a black hall of 100 km: it receives its solid
// angle over 4 pi.
TEST(ExtremeRatio, ThingsOf1cmInAHallOf100km)
{
  constexpr double side = 0.01, height = 0.01, hall = 1e5;
  const double solidAngle =
    4 * std::atan(side * side / (2 * height * std::sqrt(4 * height * height + 2 * side * side)));
  for (const double place : { 0.5, 0.99 }) // also where the coordinates are largest
  {
    const double at = place * hall;
    Mesh walls = Placed(MakeRoom(1, 2), hall, { 0, 0, 0 });
    SetCellValues(walls, "DiffuseReflectance", { 0 });
    const Mesh square =
      Placed(MakeRectangle({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1), side, { 0, 0, 0 });
    SetCellValues(square, "DiffuseReflectance", { 0 });
    Scene scene{ { walls, MakePointLight({ at, at, at }, { 1 }) },
      { MakeMoving(square, { at, at, at - height }),
        MakeMoving(MakeBox(side, side, side), { at + 3 * side, at, at - height }) } };
    const auto filter = MakeFilter(scene, NumberOfWalks);
    for (int frame = 0; frame < 4; ++frame)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
      const double share = solidAngle / (4 * vtkMath::Pi());
      const double error = std::sqrt(share * (1 - share) / NumberOfWalks);
      EXPECT_NEAR(Received(filter, 1, 0), share, 5 * error);
      scene.Moving[1].Pose->Translate(0, 0.3 * side, 0.1 * side);
      scene.Moving[1].Pose->RotateZ(20);
    }
  }
}

TEST(ExtremeLengths, BeyondAreRefusedInWords)
{
  EXPECT_NE(
    ErrorOf({ { MakeFurnace(1e31, { 0, 0, 0 }) }, {} }).find("out of range"), std::string::npos);
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }) }, { MakeMoving(MakeBox(1, 1, 1), { 1e31, 0, 0 }) } };
  EXPECT_NE(ErrorOf(scene).find("out of range"), std::string::npos);

  const double far = 1e9;
  EXPECT_NE(ErrorOf({ { MakeFurnace(1, { far, far, far }) }, {} }).find("too few digits"),
    std::string::npos);

  // Too small for an area: a warning, and another as there is no light.
  const auto filter = MakeFilter({ { MakeFurnace(1e-31, { 0, 0, 0 }) }, {} }, 100);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  ASSERT_EQ(observer->Warnings.size(), 2u);
  EXPECT_NE(observer->Warnings[0].find("have no area"), std::string::npos);
  EXPECT_NE(observer->Warnings[1].find("no light"), std::string::npos);
}
