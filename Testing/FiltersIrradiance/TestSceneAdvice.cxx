// SPDX-License-Identifier: BSD-3-Clause
// Scenes that can be computed, but are hardly meant: lamps that shine away from everything,
// millimetres.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkReverseSense.h"
#include "vtkSphereSource.h"

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

/// Whether a filter has nothing to say of a scene.
void ExpectNothingOf(const Scene& scene)
{
  ExpectNothing(Update(MakeFilter(scene, NumberOfWalks)));
}

vtkSmartPointer<vtkIrradianceFilter> MakeGathered(const Scene& scene, vtkIdType walks)
{
  auto filter = MakeFilter(scene, walks);
  filter->SetDirectLightToGathered();
  return filter;
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
  // Also a weak one in a room that keeps all other light.
  scene.Moving.clear();
  scene.Fixed[0] = MakeRoom(6, 4);
  scene.Fixed[1] = MakeLamp({ 3, 3, 5 }, 1, { 100 });
  scene.Fixed[2] = MakeLamp({ 3, 3, -1 }, 0.3, { 100 });
  ExpectOnlyWarning(
    MakeGathered(scene, 200000), { "nothing else is lit", "input port 0, connection 2", "9 W" });
  scene = MakeFloor();
  scene.Moving.push_back(MakeMoving(MakeLamp({ 0, 0, 0 }, 0.5, { 100 }), { 2, 2, 1 }));
  ExpectNothingOf(scene);
  scene.Moving[1].Pose->RotateX(180);
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "input port 1, connection 1", "25 W" });
}

// A closed lamp whose front is inside keeps its light for itself.
TEST(LampAdvice, ClosedLampTurnedInsideOut)
{
  Scene scene = MakeFloor();
  scene.Fixed[1] = Placed(MakeRoom(1, 1), 0.5, { 0, 0, 1 }); // its front is inside
  SetCellValues(scene.Fixed[1], "RadiantExitance", { 100 });
  // Where it is gathered, it is not known for sure that nothing escapes.
  for (const auto& filter :
    { MakeFilter(scene, NumberOfWalks), MakeGathered(scene, NumberOfWalks) })
  {
    ExpectOnlyWarning(filter, { "input port 0, connection 1", "150 W", "front" });
  }
  scene.Fixed[1] = Reversed(scene.Fixed[1]);
  ExpectNothingOf(scene);
}

TEST(LampAdvice, NothingIsSaidWithoutCause)
{
  // A lamp alone; lamps alone; light from the sky; a lamp on the floor, up or down, with nothing
  // above.
  Scene scene = MakeFloor();
  scene.Moving.clear();
  const Mesh floor = scene.Fixed[0], lamp = scene.Fixed[1];
  ExpectNothingOf({ { lamp }, {} });
  ExpectNothingOf({ { lamp, MakeLamp({ 3, 0, 1 }, 1, { 100 }) }, {} });
  ExpectNothingOf({ { floor, MakeLamp({ 0, 0, 100 }, 50, { 100 }) }, {} });
  const Mesh lying = Reversed(MakeLamp({ 8, 0, 0 }, 1, { 100 }));
  ExpectNothingOf({ { floor, lamp, lying }, {} });
  // Light that goes up and comes down from a ceiling.
  const Mesh ceiling = MakeRectangle({ -5, -5, 2 }, { 10, 0, 0 }, { 0, 10, 0 }, 1);
  ExpectNothingOf({ { floor, Reversed(lamp), ceiling }, {} });
  // Bulbs shine to all sides.
  Mesh bulb = MakeBall(0.1, 6);
  SetCellValues(bulb, "RadiantExitance", { 100 });
  scene.Moving = { MakeMoving(bulb, { 0, 0, 0.5 }) };
  ExpectNothingOf({ { floor }, scene.Moving });
  // A part that rides past, and is not there yet; a light on a post.
  ExpectNothingOf({ { lamp }, { MakeMoving(MakeBall(0.01, 8), { 500, 0, 0 }) } });
  const Mesh post = MakeRectangle({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1);
  ExpectNothingOf({ { post, MakePointLight({ 0, 0, 1 }, { 10 }) }, {} });
  // A room whose walls shine, on which other walls lie.
  const Mesh furnace = MakeRoom(2, 1), walls = Copy(furnace);
  SetCellValues(furnace, "RadiantExitance", { 1 });
  ExpectNothingOf({ { furnace }, { MakeMoving(walls, { 0, 0, 0 }) } });
  // A light table, below which is something else.
  ExpectNothingOf({ { floor, Reversed(lamp) }, { MakeMoving(MakeBall(0.2, 8), { 0, 0, 1.5 }) } });
}

namespace
{

/// Half of a ball of 4 m that shines to its inner side.
Mesh MakeSky()
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(4);
  source->SetThetaResolution(12);
  source->SetPhiResolution(8);
  source->SetEndPhi(90);
  source->Update();
  const Mesh sky = Reversed(Copy(source->GetOutput()));
  SetCellValues(sky, "RadiantExitance", { 100 });
  return sky;
}

/// How many percent a warning tells.
double PercentIn(const std::string& warning)
{
  return std::stod(warning.substr(warning.find("about ") + 6));
}

}

// A sun behind the faces of a sky, however far: its light hardly meets the scene at all. Resting
// and moving.
TEST(LampAdvice, SunBehindTheSky)
{
  const Mesh ground = MakeRectangle({ -2, -2, 0.01 }, { 4, 0, 0 }, { 0, 4, 0 }, 4), sky = MakeSky();
  for (const double height : { 5.0, 50.0, 1e5 })
  {
    const Mesh sun = MakeLamp({ 0, 0, height }, 0.01 * height, { 1e5 });
    const Scene resting{ { ground, sky, sun }, {} };
    const Scene moving{ { ground, sun }, { MakeMoving(sky, { 0, 0, 0 }) } };
    for (const auto& filter :
      { MakeFilter(resting, NumberOfWalks), MakeGathered(resting, NumberOfWalks) })
    {
      ExpectOnlyWarning(filter,
        { "backs of lamps", "input port 0, connection 2 (", "about 100 %",
          "behind lamps of input port 0, connection 1" });
    }
    ExpectOnlyWarning(MakeFilter(moving, NumberOfWalks),
      { "input port 0, connection 1 (", "about 100 %",
        "behind lamps of input port 1, connection 0" });
  }
  ExpectNothingOf({ { ground, sky, MakeLamp({ 0, 0, 3.5 }, 0.1, { 1e5 }) }, {} });
  ExpectNothingOf({ { ground, sky, MakePointLight({ 0, 0, 3.5 }, { 1e3 }) }, {} });
  ExpectOnlyWarning(
    MakeFilter({ { ground, sky, MakePointLight({ 0, 1, 10 }, { 1e3 }) }, {} }, NumberOfWalks),
    { "input port 0, connection 2 (1000 W", "about 100 %" });
}

// Squares of 1 m that face each other 0.5 m apart have the view factor 0.4153. Of the light of the
// upper one 0.93 are bound for a floor of 10 m, 1.5 m below, and what meets the lower one is bound
// for it, too.
TEST(LampAdvice, LampsPartlyBehindLamps)
{
  Scene scene = MakeFloor();
  scene.Moving.clear();
  scene.Fixed.push_back(MakeLamp({ 0, 0, 1.5 }, 1, { 100 }));
  const Reports reports = Update(MakeFilter(scene, NumberOfWalks));
  ExpectOne(reports.Warnings, { "input port 0, connection 2 (100 W", "connection 1" });
  ASSERT_FALSE(reports.Warnings.empty());
  EXPECT_NEAR(PercentIn(reports.Warnings[0]), 100 * 0.4153 / 0.93, 8);
  // A bulb in a cover that shines, too; both move together.
  Mesh cover = MakeBall(0.2, 8);
  SetCellValues(cover, "RadiantExitance", { 100 });
  const Mesh floor = scene.Fixed[0];
  ExpectOnlyWarning(MakeFilter({ { floor },
                                 { MakeMoving(cover, { 1, 0, 1 }),
                                   MakeMoving(MakePointLight({ 0, 0, 0 }, { 60 }), { 1, 0, 1 }) } },
                      NumberOfWalks),
    { "input port 1, connection 1 (60 W", "about 100 %" });
  // What is far in front of a lamp, or lights to both sides, or faces it, is meant.
  scene.Fixed[2] = MakeLamp({ 0, 0, 4 }, 1, { 100 });
  ExpectNothingOf(scene);
  const Mesh down = MakeLamp({ 0, 0, 1 }, 1, { 100 }), up = Reversed(down);
  const Mesh ceiling = MakeRectangle({ -5, -5, 2 }, { 10, 0, 0 }, { 0, 10, 0 }, 1);
  ExpectNothingOf({ { floor, ceiling, down, up }, {} });
  // A sheet that shines to both sides stops light with a front.
  ExpectNothingOf({ { floor, MakeLamp({ 0, 0, 1.5 }, 1, { 100 }), up, down }, {} });
  const Mesh above = MakeLamp({ 0, 0, 1.6 }, 2, { 100 });
  ExpectNothingOf({ { floor, above, up }, {} });
}

TEST(LengthAdvice, PartInMillimetresInARoomInMetres)
{
  Scene scene = MakeSmallScene();
  scene.Moving[1].Model = Placed(MakeBox(0.025, 0.02, 0.015), 1000, { 0, 0, 0 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  ExpectOnlyWarning(
    filter, { "input port 1, connection 1", "25 m", "3 m", "millimetres", "0.001" });
  scene.Moving[1].Pose->Translate(0.5, 0, 0);
  ExpectNothing(Update(filter)); // said once
  scene.Moving[1].Pose->Scale(0.001, 0.001, 0.001);
  ExpectNothing(Update(filter));
  ExpectNothingOf(scene);
}

TEST(LengthAdvice, SceneInMillimetres)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = Placed(scene.Fixed[0], 1000, { 0, 0, 0 });
  scene.Fixed[1] = MakePointLight({ 1500, 1500, 2800 }, { 100 });
  scene.Moving.clear();
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks),
    { "input port 0, connection 0", "3000 m", "W/m2", "millimetres", "0.001" });
  scene.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }); // in metres
  ExpectOnlyWarning(MakeFilter(scene, NumberOfWalks), { "input port 0, connection 0", "3000 m" });
}

TEST(LengthAdvice, NothingIsSaidOfLargeScenes)
{
  // A hall of 300 m with lamps of 20 kW; 2 km of land in the sun; a model of any size with
  // exitance.
  const double hall = 300;
  ExpectNothingOf(
    { { Placed(MakeRoom(1, 2), hall, { 0, 0, 0 }), MakeLamp({ 150, 150, 20 }, 10, { 200 }) },
      { MakeMoving(MakeBox(30, 4, 4), { 100, 100, 2 }) } });
  ExpectNothingOf({ { MakeRectangle({ 0, 0, 0 }, { 2000, 0, 0 }, { 0, 2000, 0 }, 2),
                      MakeLamp({ 1000, 1000, 500 }, 2000, { 1000 }) },
    {} });
  // A large part beside small ones that are lamps alone, or that it does not touch.
  ExpectNothingOf(
    { { MakeLamp({ 0, 0, 0 }, 1, { 100 }) }, { MakeMoving(MakeBox(30, 30, 2), { 0, 0, -3 }) } });
  Scene scene = MakeSmallScene();
  scene.Moving[1] = MakeMoving(MakeBox(30, 30, 2), { 50, 0, 0 });
  ExpectNothingOf(scene);
}

// Of 1000 walks the cells of a fine room expect less than one each, so rays have nothing to read.
TEST(ReadingAdvice, TooFewWalksForAnyCell)
{
  const Scene scene{ { MakeRoom(3, 16), MakeLamp({ 1.5, 1.5, 2.875 }, 0.15, { 100 }) }, {} };
  const auto make = [&](vtkIdType walks) {
    auto filter = MakeFilter(scene, walks);
    filter->SetMethodToGathered();
    filter->SetNumberOfRays(16);
    return filter;
  };
  ExpectOnlyWarning(make(1000),
    { "finds no cell to read", "of 1000 walks", "multiply NumberOfWalks by 39", "PathTraced" });
  ExpectNothing(Update(make(39 * 1000)));
  const auto unbiased = make(1000);
  unbiased->SetMethodToPathTraced();
  ExpectNothing(Update(unbiased));
}
