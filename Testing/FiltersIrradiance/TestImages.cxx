// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the results, and for each a scene that is a little wrong and must not pass.
// They need an X server: see Utilities/run-under-xvfb.sh.

#include "ImageComparison.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

void AddOutput(Picture& picture, vtkIrradianceFilter* filter, unsigned int port, unsigned int i,
  double brightest)
{
  picture.Add(OutputOf(filter->GetOutput(), port, i), brightest);
}

/// A ball above a floor under a small lamp.
Scene MakeBallOverFloor(double x)
{
  Mesh floor = MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 40);
  Mesh ball = MakeBall(0.5, 24);
  SetCellValues(floor, "DiffuseReflectance", { 0.3 });
  SetCellValues(ball, "DiffuseReflectance", { 0.6 });
  return { { floor, MakeLamp({ 0, 0, 3.5 }, 0.2, { 1000 }) }, { MakeMoving(ball, { x, 0, 0.9 }) } };
}

bool IsShadowOfTheBall(double x)
{
  const auto filter = MakeFilter(MakeBallOverFloor(x), 1000000);
  filter->Update();
  Picture picture({ 0, -7, 5 }, { 0, 0, 0.3 });
  AddOutput(picture, filter, 0, 0, 1);
  AddOutput(picture, filter, 1, 0, 1);
  return picture.IsSame("ShadowOfABall", x == 0);
}

/// A white room with a red wall on the left and a green one on the right.
Scene MakeColouredRoom(const std::vector<double>& left, const std::vector<double>& right)
{
  Mesh room = MakeRoom(3, 10);
  SetCellValues(room, "DiffuseReflectance", { 0.75, 0.75, 0.75 });
  vtkDataArray* reflectance = room->GetCellData()->GetArray("DiffuseReflectance");
  for (vtkIdType i = 0; i < 100; ++i)
  {
    reflectance->SetTuple(200 + i, left.data());
    reflectance->SetTuple(300 + i, right.data());
  }
  Mesh box = MakeBox(1, 0.8, 1.4);
  SetCellValues(box, "DiffuseReflectance", { 0.75, 0.75, 0.75 });
  Mesh lamp = MakeLamp({ 1.5, 1.5, 2.95 }, 1, { 100, 90, 75 });
  SetCellValues(lamp, "DiffuseReflectance", { 0 });
  Scene scene{ { room, lamp }, { MakeMoving(box, { 1.7, 1.7, 0.7 }) } };
  scene.Moving[0].Pose->RotateZ(25);
  return scene;
}

bool IsColouredRoom(const std::vector<double>& left, const std::vector<double>& right)
{
  const auto filter = MakeFilter(MakeColouredRoom(left, right), 300000);
  filter->Update();
  Picture picture({ 1.5, -4, 1.5 }, { 1.5, 1.5, 1.5 });
  AddOutput(picture, filter, 0, 0, 20);
  AddOutput(picture, filter, 0, 1, 20);
  AddOutput(picture, filter, 1, 0, 20);
  return picture.IsSame("ColouredRoom", left[0] > left[1]);
}

/// A ball moves over the floor and a box turns; the picture shows the last of five frames.
bool IsWalkingBall(int frames)
{
  Scene scene = MakeBallOverFloor(-1.2);
  Mesh box = MakeBox(0.6, 0.6, 0.6);
  SetCellValues(box, "DiffuseReflectance", { 0.4 });
  scene.Moving.push_back(MakeMoving(box, { 0.8, 0.8, 0.31 }));
  const auto filter = MakeFilter(scene, 1000000);
  filter->Update();
  for (int frame = 0; frame < frames; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.2, -0.05, 0);
    scene.Moving[1].Pose->RotateZ(9);
    filter->Update();
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  }
  Picture picture({ 0, -7, 5 }, { 0, 0, 0.3 });
  AddOutput(picture, filter, 0, 0, 1);
  AddOutput(picture, filter, 1, 0, 1);
  AddOutput(picture, filter, 1, 1, 1);
  return picture.IsSame("WalkingBall", frames == 5);
}

}

TEST(Images, ShadowOfABall)
{
  EXPECT_TRUE(IsShadowOfTheBall(0));
  EXPECT_FALSE(IsShadowOfTheBall(0.15)) << "a ball 15 cm beside it passes";
}

TEST(Images, ColouredRoom)
{
  const std::vector<double> red{ 0.75, 0.15, 0.15 }, green{ 0.15, 0.75, 0.15 };
  EXPECT_TRUE(IsColouredRoom(red, green));
  EXPECT_FALSE(IsColouredRoom(green, red)) << "exchanged walls pass";
}

TEST(Images, WalkingBall)
{
  EXPECT_TRUE(IsWalkingBall(5));
  EXPECT_FALSE(IsWalkingBall(4)) << "the frame before passes";
}
