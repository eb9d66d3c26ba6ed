// SPDX-License-Identifier: BSD-3-Clause
// Objects inside each other, in walls, under all maps; many of them; lamps that move.

#include "ExtremeScenes.h"

using namespace ExtremeScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 5000;

Mesh GreyBox(double x, double y, double z)
{
  const Mesh box = MakeBox(x, y, z);
  SetCellValues(box, "DiffuseReflectance", { 0.5 });
  return box;
}

}

// Dynamic copies of static walls, exactly in their place: ties go to the static ones, and the room
// is the same as without them. A second copy changes nothing either.
TEST(ExtremePlaces, CoincidentFaces)
{
  const Scene alone{ { MakeFurnace(1, { 0, 0, 0 }) }, {} };
  const auto expected = MakeFilter(alone, NumberOfWalks);
  expected->SetDirectLight(DirectLightOfThisRun());
  expected->Update();
  Mesh copy = Placed(MakeRoom(1, 3), 1, { 0, 0, 0 });
  SetCellValues(copy, "DiffuseReflectance", { 0.9 });
  Scene scene{ alone.Fixed, { MakeMoving(copy, { 0, 0, 0 }), MakeMoving(copy, { 0, 0, 0 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 3; ++frame)
  {
    SCOPED_TRACE(frame);
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    if (frame != 1)
    {
      for (vtkIdType cell = 0; cell < copy->GetNumberOfCells(); ++cell)
      {
        ASSERT_EQ(IrradianceOf(filter, 0, 0)->GetComponent(cell, 0),
          IrradianceOf(expected, 0, 0)->GetComponent(cell, 0));
        ASSERT_EQ(IrradianceOf(filter, 1, 0)->GetComponent(cell, 0), 0);
      }
    }
    scene.Moving[0].Pose->Identity(); // away to one side, and back
    scene.Moving[0].Pose->Translate(frame == 0 ? 0.25 : 0, 0, 0);
  }
}

// A box slides on the floor, its bottom in the plane of the floor and of a lamp in the floor.
TEST(ExtremePlaces, CoplanarFaces)
{
  Mesh lamp = MakeRectangle({ 0.3, 0.3, 0 }, { 0.25, 0, 0 }, { 0, 0.25, 0 }, 1);
  SetCellValues(lamp, "RadiantExitance", { 4 });
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }), lamp },
    { MakeMoving(GreyBox(0.25, 0.25, 0.25), { 0.125, 0.125, 0.125 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 8; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    scene.Moving[0].Pose->Translate(0.125, 0.0625, 0);
  }
}

// Boxes through each other, through a wall, and one around the whole room.
TEST(ExtremePlaces, Interpenetration)
{
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }) },
    { MakeMoving(GreyBox(0.3, 0.3, 0.3), { 0.5, 0.5, 0.5 }),
      MakeMoving(GreyBox(0.3, 0.3, 0.3), { 0.6, 0.55, 0.5 }),
      MakeMoving(GreyBox(0.5, 0.2, 0.2), { 0, 0.5, 0.3 }),
      MakeMoving(GreyBox(3, 3, 3), { 0.5, 0.5, 0.5 }) } };
  RandomNumbers random(4);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 8; ++frame)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    for (std::size_t i = 0; i < 3; ++i)
    {
      scene.Moving[i].Pose->Translate(random.Between(-0.1, 0.1), random.Between(-0.1, 0.1), 0);
      scene.Moving[i].Pose->RotateWXYZ(random.Between(0, 90), 1, random.Between(0, 1), 0.5);
    }
  }
}

// Scaled along one axis by down to 1e-13 (singular begins at 1e-14), sheared, reflected.
TEST(ExtremePlaces, NearSingularAndReflectingMaps)
{
  const Mesh box = White(MakeBox(0.4, 0.3, 0.2));
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }) }, { MakeMoving(box, { 0.5, 0.5, 0.5 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double flat : { 1.0, -1.0, 1e-3, -1e-6, 1e-9, -1e-12, 1e-13 })
  {
    for (const double shear : { 0.0, 1e3 })
    {
      SCOPED_TRACE(testing::Message() << "flattened by " << flat << ", sheared by " << shear);
      SetSheared(scene.Moving[0].Pose, flat, shear);
      ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
      EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, InThisRun(0.03));
    }
  }
  scene.Moving[0].Pose->Identity();
  scene.Moving[0].Pose->Scale(1, 1, 1e-15);
  ExpectWords(ErrorOf(scene), { "is singular" });
}

// A lamp that faces up lights only the upper half of a black room. Mirrored left to right it still
// does, though its corners run the other way round; mirrored in its plane it lights the lower half.
TEST(ExtremePlaces, AReflectionMirrorsTheFrontOfALamp)
{
  Mesh walls = MakeRoom(1, 2); // floor first, then the ceiling, 4 cells each
  SetCellValues(walls, "DiffuseReflectance", { 0 });
  const Mesh lamp = MakeRectangle({ -0.1, -0.1, 0 }, { 0.2, 0, 0 }, { 0, 0.2, 0 }, 1);
  SetCellValues(lamp, "RadiantExitance", { 1 });
  Scene scene{ { walls }, { MakeMoving(lamp, { 0.5, 0.5, 0.5 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const Vector steps[] = { { -1, 1, 1 }, { 1, 1, -1 }, { 1, -1, 1 }, { -1, -1, -1 } };
  bool isUp = true;
  for (const Vector& step : steps)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    const double onFloor = Received(filter, 0, 0, 0, 4), onCeiling = Received(filter, 0, 0, 4, 8);
    EXPECT_EQ(isUp ? onFloor : onCeiling, 0);
    EXPECT_GT(isUp ? onCeiling : onFloor, 0.3 * Field(filter, "EmittedPower"));
    scene.Moving[0].Pose->Scale(step[0], step[1], step[2]);
    isUp = isUp == (step[2] > 0);
  }
}

TEST(ExtremePlaces, AThousandObjects)
{
  constexpr int kObjects = 1000;
  const Mesh box = White(MakeBox(0.03, 0.02, 0.025));
  Scene scene{ { MakeFurnace(1, { 0, 0, 0 }) }, {} };
  RandomNumbers random(9);
  const auto place = [&] { return random.Between(0.03, 0.97); };
  for (int i = 0; i < kObjects; ++i)
  {
    const double x = place(), y = place();
    scene.Moving.push_back(MakeMoving(box, { x, y, place() }));
  }
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const int moved : { 0, 1, 30, kObjects })
  {
    for (int i = 0; i < moved; ++i)
    {
      scene.Moving[static_cast<std::size_t>(i)].Pose->RotateWXYZ(random.Between(0, 360), 1, 2, 3);
    }
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_NEAR(MeanIrradiance(filter, 0, 0), 1, InThisRun(0.05));
  }
}

// A lamp in a closed box that moves: the box keeps all light to the last quantum, wherever it goes.
TEST(ExtremePlaces, AnEmitterInsideAMovingClosedBox)
{
  Mesh walls = MakeRoom(1, 2);
  const Mesh lamp = MakeLamp({ 0, 0, 0.05 }, 0.1, { 10 });
  Scene scene{ { walls },
    { MakeMoving(GreyBox(0.3, 0.3, 0.3), { 0, 0, 0 }), MakeMoving(lamp, { 0, 0, 0 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double x : { 0.5, 0.3, 40.0, 1e6 })
  {
    for (const MovingObject& object : scene.Moving)
    {
      object.Pose->Identity();
      object.Pose->Translate(x, 0.5, 0.5);
      object.Pose->RotateWXYZ(10 * x, 1, 1, 0);
    }
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_EQ(Received(filter, 0, 0), 0) << "at " << x;
  }
}

// A box is put over a static lamp and taken away: both are verified and repaired.
TEST(ExtremePlaces, AClosedBoxOverALampAndAway)
{
  Mesh walls = MakeRoom(1, 2);
  Scene scene{ { walls, MakeLamp({ 0.5, 0.5, 0.5 }, 0.1, { 10 }) },
    { MakeMoving(GreyBox(0.3, 0.3, 0.3), { 0.5, 0.5, 0.5 }) } };
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double x : { 0.5, 0.55, 3.0, 0.45, 0.5, -2.0 })
  {
    scene.Moving[0].Pose->Identity();
    scene.Moving[0].Pose->Translate(x, 0.5, 0.5);
    ASSERT_NO_FATAL_FAILURE(ExpectLaws(filter, scene));
    EXPECT_EQ(Received(filter, 0, 0) == 0, std::abs(x - 0.5) < 0.1) << "at " << x;
  }
}
