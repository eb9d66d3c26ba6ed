// SPDX-License-Identifier: BSD-3-Clause
// Very weak and very strong lights, and rooms that hardly absorb.

#include "ExtremeScenes.h"

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
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0) / level, 1, InThisRun(0.0125));
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Watts, ExtremePower, testing::Values(1e-200, 1e-12, 1e-6, 1e6, 1e12, 1e30), NumberOf);

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

// Of its lamps only the square has an area that a double can tell from none; all it emits arrives
// in the black room.
TEST(ExtremeLight, LampsWithoutArea)
{
  const auto lampOf = [](const Vector& u, const Vector& v) {
    const Mesh lamp =
      Placed(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1), 1, { 0, 0, 0 });
    for (vtkIdType i = 0; i < 4; ++i)
    {
      const double a = i % 2, b = i / 2;
      lamp->GetPoints()->SetPoint(i, 0.3 + a * u[0] + b * v[0], 0.4 + a * u[1] + b * v[1], 0.9);
    }
    SetCellValues(lamp, "RadiantExitance", { 100 });
    return lamp;
  };
  Mesh room = MakeRoom(1, 3);
  SetCellValues(room, "DiffuseReflectance", { 0 });
  const Mesh square = MakeLamp({ 0.5, 0.5, 0.95 }, 0.2, { 100 });
  SetCellValues(square, "DiffuseReflectance", { 0 });
  Scene scene{ { room, square, lampOf({ 0, 0, 0 }, { 0, 0, 0 }), lampOf({ 0.2, 0, 0 }, { 0, 0, 0 }),
                 lampOf({ 0.2, 0.1, 0 }, { 0.1, 0.05, 0 }),
                 lampOf({ 1e-200, 0, 0 }, { 0, 1e-200, 0 }) },
    { MakeMoving(White(MakeBox(0.1, 0.1, 0.1)), { 0.4, 0.5, 0.3 }) } };
  const auto filter = MakeFilter(scene, 10000);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(Field(filter, "EmittedPower"), 4, 1e-5); // points are floats
    EXPECT_NEAR(Received(filter, 0, 0), 4, 0.1);         // gathered, an estimate
    scene.Moving[0].Pose->Translate(0, 0, 0.1);
  }
}

// Lamps a million times as long as wide, and one of a thousand; the last hangs a millimetre over
// the floor.
TEST(ExtremeLight, LampsOfAspect1e6)
{
  const auto strip = [](double x, double y, double z, double width) {
    const Mesh lamp =
      Placed(MakeRectangle({ 0, 0, 0 }, { 0, 0.8, 0 }, { width, 0, 0 }, 1), 1, { x, y, z });
    SetCellValues(lamp, "RadiantExitance", { 1 / width });
    SetCellValues(lamp, "DiffuseReflectance", { 0 });
    return lamp;
  };
  Mesh room = MakeRoom(1, 3);
  SetCellValues(room, "DiffuseReflectance", { 0 });
  Scene scene{ { room, strip(0.3, 0.1, 0.9, 8e-7), strip(0.5, 0.1, 0.9, 1e-3),
                 strip(1 / 3.0, 0.1, 0.99, 8e-7), strip(0.3, 0.1, 1e-3, 8e-7) },
    { MakeMoving(White(MakeBox(0.1, 0.1, 0.1)), { 0.4, 0.5, 0.3 }) } };
  const auto filter = MakeFilter(scene, 20000);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(Field(filter, "EmittedPower"), 3.2, 1e-6);
    // The lowest strip brings a quarter, which is much noise where it is gathered.
    EXPECT_NEAR(Received(filter, 0, 0), 3.2, 0.4);
    scene.Moving[0].Pose->Translate(0.05, 0, 0.1);
  }
}

// 3,200 lamps in a black room: each sample chooses one.
TEST(ExtremeLight, ThousandsOfLamps)
{
  Mesh room = MakeRoom(1, 3);
  SetCellValues(room, "DiffuseReflectance", { 0 });
  const Mesh panel = MakeRectangle({ 0.1, 0.1, 0.8 }, { 0, 0.8, 0 }, { 0.8, 0, 0 }, 40);
  SetCellValues(panel, "DiffuseReflectance", { 0 });
  SetCellValues(panel, "RadiantExitance", { 1 });
  Scene scene{ { room, panel }, { MakeMoving(White(MakeBox(0.1, 0.1, 0.1)), { 0.4, 0.5, 0.3 }) } };
  const auto filter = MakeFilter(scene, 20000);
  for (int frame = 0; frame < 2; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(Field(filter, "EmittedPower"), 0.64, 1e-6);
    EXPECT_NEAR(Received(filter, 0, 0), 0.64, 0.02);
    scene.Moving[0].Pose->Translate(0.05, 0, 0.1);
  }
}

// Walks of 10,000 bounces on average: 5 million segments, none of which may leak. A walk that ends
// with a chance of 1e-4 at each bounce brings as much as the mean, give or take the mean.
TEST(ExtremeLight, Reflectance09999)
{
  const vtkIdType walks = IsThorough() ? 2000 : 500;
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }, 0.9999) },
    { MakeMoving(White(MakeBox(0.3, 0.2, 0.25)), { 0.4, 0.5, 0.6 }) } };
  const auto filter = MakeFilter(scene, walks);
  ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
  EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, 5 / std::sqrt(double(walks)));
}

TEST(ExtremeLight, BeyondAreRefusedInWords)
{
  ExpectWords(ErrorOf({ { MakeFurnace(1, { 0, 0, 0 }, 0.5, 1e31) }, {} }), { "exitance 5e+30" });
  // No power is absorbed, so no walk ends.
  Mesh room = MakeFurnace(1, { 0, 0, 0 });
  SetCellValues(room, "DiffuseReflectance", { 1 });
  ExpectWords(ErrorOf({ { room }, {} }, 3), { "too near 1" });
  // Too weak for a double: no light, and a warning.
  const auto filter = MakeFilter({ { MakeFurnace(1, { 0, 0, 0 }, 0.5, 1e-322) }, {} }, 100);
  ExpectOnlyWarning(filter, { "no light" });
}
