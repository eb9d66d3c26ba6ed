// SPDX-License-Identifier: BSD-3-Clause
// Scenes that can be computed, but are hardly meant: lamps that shine away from everything, millimetres.

#include "Reports.h"
#include "TestScenes.h"

#include "vtkReverseSense.h"
#include "vtkTransformPolyDataFilter.h"

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 2000;

Mesh Reversed(const Mesh& mesh)
{
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(mesh);
  reverse->Update();
  return Copy(reverse->GetOutput());
}

Mesh Scaled(const Mesh& mesh, double factor)
{
  vtkNew<vtkTransform> scale;
  scale->Scale(factor, factor, factor);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(mesh);
  filter->SetTransform(scale);
  filter->Update();
  return Copy(filter->GetOutput());
}

/// A lamp of 100 W, 1 m above a floor of 10 m, which shines downwards.
Scene MakeFloor()
{
  return { { MakeRectangle({ -5, -5, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 4),
             MakeLamp({ 0, 0, 1 }, 1, { 100 }) },
    { MakeMoving(MakeBall(0.2, 8), { 1, 0, 0.3 }) } };
}

}

TEST(LampAdvice, LampsThatShineAwayFromEverything)
{
  Scene scene = MakeFloor();
  scene.Fixed[1] = Reversed(scene.Fixed[1]);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  ExpectOnlyWarning(filter,
    { "input port 0, connection 1", "100 W", "front", "counter-clockwise", "vtkReverseSense" });
  EXPECT_EQ(Field(filter, "EscapedPower"), Field(filter, "EmittedPower"));

  scene.Moving[0].Pose->Translate(0.5, 0, 0);
  ExpectNothing(Update(filter)); // said once
  scene.Fixed[1] = Reversed(scene.Fixed[1]);
  Connect(filter, scene);
  ExpectNothing(Update(filter));
  EXPECT_GT(Field(filter, "AbsorbedPower"), 0);
}

// Of two lamps, the wrong one is named; a dynamic one in the world, not in its own coordinates.
TEST(LampAdvice, OneOfSeveral)
{
  Scene scene = MakeFloor();
  scene.Fixed.push_back(Reversed(MakeLamp({ 2, 2, 1 }, 0.5, { 100 })));
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "input port 0, connection 2", "25 W" });

  scene.Fixed.pop_back();
  scene.Moving.push_back(MakeMoving(MakeLamp({ 0, 0, 0 }, 0.5, { 100 }), { 2, 2, 1 }));
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));
  scene.Moving[1].Pose->RotateX(180);
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "input port 1, connection 1", "25 W" });
}

// A closed lamp whose front is inside keeps its light for itself.
TEST(LampAdvice, ClosedLampTurnedInsideOut)
{
  Scene scene = MakeFloor();
  scene.Fixed[1] = Scaled(MakeRoom(1, 1), 0.5); // its front is inside
  scene.Fixed[1]->GetPoints()->Modified();
  vtkNew<vtkTransform> up;
  up->Translate(0, 0, 1);
  vtkNew<vtkTransformPolyDataFilter> lift;
  lift->SetInputData(scene.Fixed[1]);
  lift->SetTransform(up);
  lift->Update();
  scene.Fixed[1] = Copy(lift->GetOutput());
  SetCellValues(scene.Fixed[1], "RadiantExitance", { 100 });
  const auto gathered = MakeFilter(scene, NumberOfWalks);
  gathered->SetDirectLightToGathered(); // it is not known for sure that nothing escapes
  for (const auto& filter : { MakeFilter(scene, NumberOfWalks), gathered })
  {
    ExpectOnlyWarning(filter, { "input port 0, connection 1", "150 W", "front" });
  }
  scene.Fixed[1] = Reversed(scene.Fixed[1]);
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));
}

TEST(LampAdvice, NothingIsSaidWithoutCause)
{
  // A lamp alone; lamps alone; light from the sky; a lamp on the floor, up or down, with nothing above.
  Scene scene = MakeFloor();
  scene.Moving.clear();
  const Mesh floor = scene.Fixed[0], lamp = scene.Fixed[1];
  ExpectNothing(Update(MakeFilter({ { lamp }, {} }, NumberOfWalks)));
  ExpectNothing(
    Update(MakeFilter({ { lamp, MakeLamp({ 3, 0, 1 }, 1, { 100 }) }, {} }, NumberOfWalks)));
  ExpectNothing(
    Update(MakeFilter({ { floor, MakeLamp({ 0, 0, 100 }, 50, { 100 }) }, {} }, NumberOfWalks)));
  const Mesh lying = Reversed(MakeLamp({ 8, 0, 0 }, 1, { 100 }));
  ExpectNothing(Update(MakeFilter({ { floor, lamp, lying }, {} }, NumberOfWalks)));
  // Light that goes up and comes down from a ceiling.
  const Mesh ceiling = MakeRectangle({ -5, -5, 2 }, { 10, 0, 0 }, { 0, 10, 0 }, 1);
  ExpectNothing(Update(MakeFilter({ { floor, Reversed(lamp), ceiling }, {} }, NumberOfWalks)));
  // Bulbs shine to all sides.
  Mesh bulb = MakeBall(0.1, 6);
  SetCellValues(bulb, "RadiantExitance", { 100 });
  scene.Moving = { MakeMoving(bulb, { 0, 0, 0.5 }) };
  ExpectNothing(Update(MakeFilter({ { floor }, scene.Moving }, NumberOfWalks)));
  // A part that rides past, and is not there yet; a light on a post.
  ExpectNothing(Update(
    MakeFilter({ { lamp }, { MakeMoving(MakeBall(0.01, 8), { 500, 0, 0 }) } }, NumberOfWalks)));
  const Mesh post = MakeRectangle({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1);
  ExpectNothing(
    Update(MakeFilter({ { post, MakePointLight({ 0, 0, 1 }, { 10 }) }, {} }, NumberOfWalks)));
  // A room whose walls shine, on which other walls lie.
  const Mesh furnace = MakeRoom(2, 1), walls = Copy(furnace);
  SetCellValues(furnace, "RadiantExitance", { 1 });
  ExpectNothing(
    Update(MakeFilter({ { furnace }, { MakeMoving(walls, { 0, 0, 0 }) } }, NumberOfWalks)));
  // A light table, below which is something else.
  ExpectNothing(Update(
    MakeFilter({ { floor, Reversed(lamp) }, { MakeMoving(MakeBall(0.2, 8), { 0, 0, 1.5 }) } },
      NumberOfWalks)));
}

TEST(LengthAdvice, PartInMillimetresInARoomInMetres)
{
  Scene scene = MakeSmallScene();
  scene.Moving[1].Model = Scaled(MakeBox(0.025, 0.02, 0.015), 1000);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  ExpectOnlyWarning(
    filter, { "input port 1, connection 1", "25 m", "3 m", "millimetres", "0.001" });
  scene.Moving[1].Pose->Translate(0.5, 0, 0);
  ExpectNothing(Update(filter)); // said once
  scene.Moving[1].Pose->Scale(0.001, 0.001, 0.001);
  ExpectNothing(Update(filter));
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));
}

TEST(LengthAdvice, SceneInMillimetres)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = Scaled(scene.Fixed[0], 1000);
  scene.Fixed[1] = MakePointLight({ 1500, 1500, 2800 }, { 100 });
  scene.Moving.clear();
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks),
    { "input port 0, connection 0", "3000 m", "W/m2", "millimetres", "0.001" });
  scene.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }); // in metres
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "input port 0, connection 0", "3000 m" });
}

TEST(LengthAdvice, NothingIsSaidOfLargeScenes)
{
  // A hall of 300 m with lamps of 20 kW; 2 km of land in the sun; a model of any size with exitance.
  const double hall = 300;
  ExpectNothing(
    Update(MakeFilter({ { Scaled(MakeRoom(1, 2), hall), MakeLamp({ 150, 150, 20 }, 10, { 200 }) },
                        { MakeMoving(MakeBox(30, 4, 4), { 100, 100, 2 }) } },
      NumberOfWalks)));
  ExpectNothing(Update(MakeFilter({ { MakeRectangle({ 0, 0, 0 }, { 2000, 0, 0 }, { 0, 2000, 0 }, 2),
                                      MakeLamp({ 1000, 1000, 500 }, 2000, { 1000 }) },
                                    {} },
    NumberOfWalks)));
  // A large part beside small ones that are lamps alone, or that it does not touch.
  ExpectNothing(Update(MakeFilter(
    { { MakeLamp({ 0, 0, 0 }, 1, { 100 }) }, { MakeMoving(MakeBox(30, 30, 2), { 0, 0, -3 }) } },
    NumberOfWalks)));
  Scene scene = MakeSmallScene();
  scene.Moving[1] = MakeMoving(MakeBox(30, 30, 2), { 50, 0, 0 });
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));
}

// Of 1000 walks the cells of a fine room expect less than one each, so rays have nothing to read.
TEST(ReadingAdvice, TooFewWalksForAnyCell)
{
  const Scene scene{ { MakeRoom(3, 16), MakeLamp({ 1.5, 1.5, 2.875 }, 0.15, { 100 }) }, {} };
  const auto make = [&](vtkIdType walks) {
    auto filter = MakeFilter(scene, walks);
    filter->SetDirectLightToGathered();
    filter->SetCellEstimateToGathered();
    filter->SetNumberOfGatherRays(16);
    return filter;
  };
  ExpectOnlyWarning(make(1000),
    { "finds no cell to read", "of 1000 walks", "multiply NumberOfWalks by 39", "UnbiasedGather" });
  ExpectNothing(Update(make(39 * 1000)));
  const auto unbiased = make(1000);
  unbiased->UnbiasedGatherOn();
  ExpectNothing(Update(unbiased));
}
