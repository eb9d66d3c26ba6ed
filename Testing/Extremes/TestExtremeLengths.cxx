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
class ExtremeFurnace : public testing::TestWithParam<FurnacePlace>
{
};

}

TEST_P(ExtremeFurnace, Holds)
{
  const FurnacePlace& place = GetParam();
  ExpectFurnace({ MakeFurnace(place.Size, place.Offset), White(MakeBox(0.3, 0.2, 0.25)),
                  White(MakeBall(0.15, 24)) },
    place, NumberOfWalks, 5 * 0.177 / std::sqrt(1.0 * NumberOfWalks) + 0.005);
}

INSTANTIATE_TEST_SUITE_P(Each, ExtremeFurnace,
  PlacesOf({ 1e-28, 1e-12, 1e-6, 1.0, 1e6, 1e12, 1e28 }, { 10.0, 1e3, 1e5, 1e6, 1e7 }), NumberOf);

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
  ExpectFurnaceOfSlivers([](const Scene&) {});
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
  ExpectWords(ErrorOf({ { MakeFurnace(1e31, { 0, 0, 0 }) }, {} }), { "out of range" });
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }) }, { MakeMoving(MakeBox(1, 1, 1), { 1e31, 0, 0 }) } };
  ExpectWords(ErrorOf(scene), { "out of range" });

  const double far = 1e9;
  ExpectWords(ErrorOf({ { MakeFurnace(1, { far, far, far }) }, {} }), { "too few digits" });

  // Too small for an area: a warning, and another as there is no light.
  const auto filter = MakeFilter({ { MakeFurnace(1e-31, { 0, 0, 0 }) }, {} }, 100);
  const Reports reports = Update(filter);
  EXPECT_TRUE(reports.Errors.empty());
  ASSERT_EQ(reports.Warnings.size(), 2u);
  ExpectWords(reports.Warnings[0], { "have no area" });
  ExpectWords(reports.Warnings[1], { "no light" });
}
