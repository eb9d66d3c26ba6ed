// SPDX-License-Identifier: BSD-3-Clause
// What mouse and keys do.
#include "ShownRoom.h"

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkRendererCollection.h>

#include <cmath>

using namespace interactiveroom;

// In the plane through the middle of the thing, across the view: as far as the mouse goes there.
TEST(DraggedThings, FollowTheMouse)
{
  Shown shown({ "--walks", "1000" });
  shown.TheRoom.Limits.reset();
  vtkRenderer* renderer = shown.Window.GetWindow()->GetRenderers()->GetFirstRenderer();
  const auto pixelOf = [&](TestScenes::Vector x) {
    renderer->SetWorldPoint(x[0], x[1], x[2], 1);
    renderer->WorldToDisplay();
    return std::array<double, 2>{ renderer->GetDisplayPoint()[0], renderer->GetDisplayPoint()[1] };
  };
  const auto before = pixelOf(shown.MiddleOf(Teapot));
  vtkNew<vtkMatrix4x4> old;
  old->DeepCopy(shown.Pose(Teapot));
  shown.Drag(512, 230, 576, 270);
  const auto after = pixelOf(shown.MiddleOf(Teapot));
  EXPECT_NEAR(
    after[0] - before[0], 64, 4); // it is a little nearer or farther than what was pressed
  EXPECT_NEAR(after[1] - before[1], 40, 4);
  for (int i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(shown.Pose(Teapot)->GetElement(i / 3, i % 3), old->GetElement(i / 3, i % 3), 1e-12);
  }
}

TEST(DraggedThings, TurnWithShiftAndStayRigid)
{
  Shown shown({ "--walks", "1000" });
  shown.TheRoom.Limits.reset();
  const auto before = shown.MiddleOf(Ring);
  vtkNew<vtkMatrix4x4> old;
  old->DeepCopy(shown.Pose(Ring));
  for (int i = 0; i < 300; ++i) // the box's rounding does not add up
  {
    shown.Drag(392 + i % 7, 88, 416, 160, true);
  }
  EXPECT_EQ(shown.Window.GetThings().GetChosen(), Ring);
  EXPECT_FALSE(IsEqual(old, shown.Pose(Ring)));
  const auto after = shown.MiddleOf(Ring);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(after[i], before[i], 1e-6);
    for (int j = 0; j < 3; ++j)
    {
      double product = 0;
      for (int k = 0; k < 3; ++k)
      {
        product += shown.Pose(Ring)->GetElement(k, i) * shown.Pose(Ring)->GetElement(k, j);
      }
      EXPECT_NEAR(product, i == j, 1e-12);
    }
  }
}

TEST(DraggedThings, StayInTheLimits)
{
  Shown shown({ "--walks", "1000" });
  shown.Window.GetThings().Choose(Ball); // of radius 0.26, in a room of 4 x 3 x 2.5
  shown.Window.GetThings().Move(100, -100, 100);
  const auto middle = shown.MiddleOf(Ball);
  EXPECT_NEAR(middle[0], 2 - 0.26, 0.002); // a polyhedron is a little smaller than its ball
  EXPECT_NEAR(middle[1], -1.5 + 0.26, 0.002);
  EXPECT_NEAR(middle[2], 2.5 - 0.26, 0.002);
}

TEST(Keys, MoveTurnChooseAndBringBack)
{
  Shown shown({ "--walks", "1000" });
  vtkCamera* camera =
    shown.Window.GetWindow()->GetRenderers()->GetFirstRenderer()->GetActiveCamera();
  const double way = 0.01 * camera->GetDistance();
  const auto before = shown.Place(Teapot);
  const auto expect = [&](const char* key, double x, double y, double z) {
    shown.Press(key);
    EXPECT_NEAR(shown.Place(Teapot)[0], before[0] + x, 1e-9) << key;
    EXPECT_NEAR(shown.Place(Teapot)[1], before[1] + y, 1e-9) << key;
    EXPECT_NEAR(shown.Place(Teapot)[2], before[2] + z, 1e-9) << key;
  };
  expect("Right", way, 0, 0);
  expect("Up", way, way, 0);
  expect("Prior", way, way, way);
  expect("Next", way, way, 0);
  expect("Down", way, 0, 0);
  expect("Left", 0, 0, 0);
  camera->Azimuth(90); // one looks along -x: right is +y
  expect("Right", 0, way, 0);
  expect("Up", -way, way, 0);
  shown.Press("r");
  expect("none", 0, 0, 0);
  shown.Press("comma");
  EXPECT_NEAR(
    std::atan2(shown.Pose(Teapot)->GetElement(1, 0), shown.Pose(Teapot)->GetElement(0, 0)),
    vtkMath::RadiansFromDegrees(25.0 + 5), 1e-9);
  shown.Press("Tab", '\t');
  EXPECT_EQ(shown.Window.GetThings().GetChosen(), Ball);
}

TEST(Keys, HoldAnAxis)
{
  Shown shown({ "--walks", "1000" });
  const auto before = shown.Place(Teapot);
  shown.Press("x", 'x');
  shown.Drag(512, 230, 576, 270);
  shown.Release("x", 'x');
  EXPECT_GT(shown.Place(Teapot)[0], before[0] + 0.1);
  EXPECT_NEAR(shown.Place(Teapot)[1], before[1], 1e-9);
  EXPECT_NEAR(shown.Place(Teapot)[2], before[2], 1e-9);
}

// Of exact light nothing is stale: all cells are black.
TEST(StaleLight, IsShownByAKeyAndByTheCheckBox)
{
  Shown shown({ "--walks", "20000" });
  const auto redOnTheWall = [&] {
    shown.Window.Step();
    return PictureOf(shown)->GetScalarComponentAsDouble(456, 344, 0, 0);
  };
  EXPECT_GT(redOnTheWall(), 100);
  shown.Press("s", 's');
  EXPECT_LT(redOnTheWall(), 5);
  shown.Drag(890, 67, 890, 67); // the check box
  EXPECT_GT(redOnTheWall(), 100);
}
