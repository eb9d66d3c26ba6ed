// SPDX-License-Identifier: BSD-3-Clause
// Faces in one plane: one of them is lit, as if it lay one millimetre above the other, whichever
// way light is known and whether it rests or moves.

#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace TestScenes;

namespace
{

struct How
{
  bool IsGathered, IsDynamic;
  friend std::ostream& operator<<(std::ostream& os, const How& how)
  {
    return os << (how.IsGathered ? "Gathered" : "Shot") << (how.IsDynamic ? "Dynamic" : "Static");
  }
};

class FacesInOnePlane : public testing::TestWithParam<How>
{
protected:
  /// `thing` lies over the meshes of `fixed`, `lift` along z above its own place.
  static vtkSmartPointer<vtkIrradianceFilter> Run(
    const std::vector<Mesh>& fixed, const Mesh& thing, double lift)
  {
    Scene scene{ fixed, {} };
    if (GetParam().IsDynamic)
    {
      scene.Moving = { MakeMoving(thing, { 0, 0, lift }) };
    }
    else
    {
      scene.Fixed.push_back(Lifted(thing, lift));
    }
    const auto filter = MakeFilter(scene, 200000);
    filter->SeparateSidesOn();
    GetParam().IsGathered ? filter->SetDirectLightToGathered() : void();
    filter->Update();
    return filter;
  }
  static Mesh Lifted(const Mesh& mesh, double lift) { return Placed(mesh, 1, { 0, 0, lift }); }
  /// Mean over the cells [first, end) of one side of an input; `end` < 0: of all.
  static double Mean(vtkIrradianceFilter* filter, unsigned int input, const char* side,
    vtkIdType first = 0, vtkIdType end = -1)
  {
    return MeanOf(OutputOf(filter->GetOutput(), 0, input), side, first, end);
  }
  static double MeanOfThing(vtkIrradianceFilter* filter, unsigned int fixed, const char* side)
  {
    return MeanOf(Thing(filter, fixed), side, 0, -1);
  }
  /// `fixed`: its connection where it rests.
  static vtkPolyData* Thing(vtkIrradianceFilter* filter, unsigned int fixed)
  {
    return GetParam().IsDynamic ? OutputOf(filter->GetOutput(), 1, 0)
                                : OutputOf(filter->GetOutput(), 0, fixed);
  }

private:
  static double MeanOf(vtkPolyData* mesh, const char* side, vtkIdType first, vtkIdType end)
  {
    const std::vector<double> values = ValuesOf(mesh->GetCellData()->GetArray(side));
    const auto begin = values.begin() + first, stop = end < 0 ? values.end() : values.begin() + end;
    return std::accumulate(begin, stop, 0.0) / static_cast<double>(stop - begin);
  }
};

}

// The rug has 800 triangles on the two of a cell of the floor. With 200,000 walks all means have an
// error below .7 %, so chance exceeds 5 % of a difference in 1 of 10^6 runs.
TEST_P(FacesInOnePlane, ARugIsLitAndTheFloorBelowIsNot)
{
  const std::vector<Mesh> fixed{ MakeRoom(3, 1), MakeLamp({ 1.5, 1.5, 2.75 }, 1, { 100 }) };
  const Mesh rug = MakeRectangle({ 0.5, 0.5, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 20);
  const auto lies = Run(fixed, rug, 0), hovers = Run(fixed, rug, 1e-3);
  EXPECT_EQ(MeanOfThing(lies, 2, "IrradianceBack"), 0);
  EXPECT_NEAR(Field(lies, "EscapedPower"), 0, 0.5);
  for (const auto& [first, end] : { std::pair<vtkIdType, vtkIdType>(0, 1), { 1, 2 }, { 2, 6 } })
  {
    const double expected = Mean(hovers, 0, "IrradianceFront", first, end);
    EXPECT_NEAR(Mean(lies, 0, "IrradianceFront", first, end), expected, 0.05 * expected)
      << "cells of the room from " << first;
  }
  const double expected = MeanOfThing(hovers, 2, "IrradianceFront");
  EXPECT_NEAR(MeanOfThing(lies, 2, "IrradianceFront"), expected, 0.05 * expected);
}

// A lamp in a closed box that stands flush on a floor lights the inside of the box, and nothing
// else.
TEST_P(FacesInOnePlane, ALightBoxOnAFloorKeepsItsLight)
{
  const Mesh box = Lifted(MakeBox(1, 0.75, 0.5), 0.25); // numbers that are floats
  const std::vector<Mesh> fixed{ MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 2),
    MakeLamp({ 0.125, 0, 0.375 }, 0.2, { 1000 }) };
  const auto stands = Run(fixed, box, 0);
  EXPECT_EQ(Mean(stands, 0, "IrradianceFront"), 0);
  EXPECT_EQ(Mean(stands, 0, "IrradianceBack"), 0);
  EXPECT_EQ(MeanOfThing(stands, 2, "IrradianceFront"), 0);
  EXPECT_NEAR(Field(stands, "EscapedPower"), 0, 0.2); // of 40 W
}

// A screen in the plane of a wall that is a sheet, lit from both sides: each side of the two is lit
// once. In a black scene what arrives is what the lamps send there.
TEST_P(FacesInOnePlane, AScreenInTheWallOfTwoRooms)
{
  const std::vector<Mesh> fixed{ MakeRectangle({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2),
    MakeLamp({ 0, 0, 1 }, 0.5, { 100 }),
    MakeRectangle({ -0.25, -0.25, -1 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, 1) };
  SetCellValues(fixed[2], "RadiantExitance", { 50 });
  for (const Mesh& mesh : fixed)
  {
    SetCellValues(mesh, "DiffuseReflectance", { 0 });
  }
  const Mesh screen = MakeRectangle({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3);
  SetCellValues(screen, "DiffuseReflectance", { 0 });
  const auto lies = Run(fixed, screen, 0), hovers = Run(fixed, screen, 1e-3);
  const auto powerOf = [](vtkIrradianceFilter* filter, const char* side) {
    return 4 * Mean(filter, 0, side) + MeanOfThing(filter, 3, side);
  };
  for (const char* const side : { "IrradianceFront", "IrradianceBack" })
  {
    const double expected = powerOf(hovers, side);
    EXPECT_NEAR(powerOf(lies, side), expected, 0.03 * expected) << side;
  }
  const double expected = MeanOfThing(hovers, 3, "IrradianceFront");
  EXPECT_NEAR(MeanOfThing(lies, 3, "IrradianceFront"), expected, 0.03 * expected);
}

// The ceiling of a room is the floor of the next one. Each has its own light, half of which its
// walls reflect: it receives twice what its lamp emits.
TEST_P(FacesInOnePlane, RoomsShareAWall)
{
  const std::vector<Mesh> fixed{ MakeRoom(2, 2), MakeLamp({ 1, 1, 1.75 }, 0.5, { 100 }),
    Lifted(MakeLamp({ 1, 1, 1.75 }, 0.5, { 10 }), 2) };
  const auto above = Run(fixed, Lifted(MakeRoom(2, 2), 2), 0);
  // The lamp has .25 m2, its two sides reflect half as well, and receive what the walls do.
  const double below = Mean(above, 0, "IrradianceFront"),
               upper = MeanOfThing(above, 3, "IrradianceFront");
  EXPECT_EQ(Mean(above, 0, "IrradianceBack"), 0);
  EXPECT_EQ(MeanOfThing(above, 3, "IrradianceBack"), 0);
  EXPECT_NEAR(upper, 0.1 * below, 0.005 * below);
  EXPECT_NEAR(below, 100 * 0.25 / (24.5 * 0.5), 0.1);
}

// A leaf of two opposite faces at one place: each side receives its own light.
TEST_P(FacesInOnePlane, ALeafOfTwoFaces)
{
  const std::vector<Mesh> fixed{ MakeLamp({ 0, 0, 1 }, 0.5, { 100 }) };
  const Mesh leaf = Join({ MakeRectangle({ -0.5, -0.5, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2),
    MakeRectangle({ -0.5, -0.5, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 2) });
  const auto filter = Run(fixed, leaf, 0);
  const auto of = [&](const char* side, vtkIdType cell) {
    return Thing(filter, 1)->GetCellData()->GetArray(side)->GetComponent(cell, 0);
  };
  for (vtkIdType cell = 0; cell < 4; ++cell)
  {
    EXPECT_GT(of("IrradianceFront", cell), 1);
    EXPECT_EQ(of("IrradianceBack", cell), 0);
    EXPECT_EQ(of("IrradianceFront", cell + 4), 0);
    EXPECT_EQ(of("IrradianceBack", cell + 4), 0);
  }
}

// A screen slides over a floor, leaves it, and comes back.
TEST(SheetsThatMoveInAPlane, UpdatesEqualRebuilds)
{
  Scene scene{ { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.5 }, 1, { 100 }) },
    { MakeMoving(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 5), {}),
      MakeMoving(MakeBox(0.5, 0.5, 0.5), { 2, 2, 0.25 }) } };
  for (const bool isGathered : { true, false })
  {
    const auto make = [&] {
      const auto filter = MakeFilter(scene, 20000);
      isGathered ? filter->SetDirectLightToGathered() : void();
      return filter;
    };
    const auto updated = make();
    for (const auto& [x, z] : { std::pair(0.5, 0.0), { 1.0, 0.0 }, { 1.0, 0.01 }, { 1.5, 1e-11 },
           { 0.25, 0.0 }, { 0.5, 0.0 } })
    {
      scene.Moving[0].Pose->Identity();
      scene.Moving[0].Pose->Translate(x, 0.75, z);
      ASSERT_TRUE(UpdatesLike(updated, make())) << x << " " << z;
    }
  }
}

// A closed body that a pose mirrors is lit outside and dark within, whichever way light is known;
// on a lamp, too. Half of the light table is hidden by the body, so what it receives below is M /
// (1 - rho^2).
TEST(MirroredBodies, AreLitOutside)
{
  for (const int method : { vtkIrradianceFilter::Walks, vtkIrradianceFilter::Gathered })
  {
    Scene scene{ { MakeRectangle({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2),
                   MakeLamp({ 0, 0, 2 }, 1, { 100 }) },
      { MakeMoving(MakeBox(0.5, 0.5, 0.5), { 0, 0, 0.25 }) } };
    SetCellValues(scene.Fixed[0], "RadiantExitance", { 100 });
    scene.Moving[0].Pose->Scale(-1, 1, 1);
    const auto filter = MakeFilter(scene, 100000);
    filter->SetMethod(method);
    filter->SeparateSidesOn();
    filter->Update();
    vtkCellData* const box = OutputOf(filter->GetOutput(), 1, 0)->GetCellData();
    for (vtkIdType cell = 0; cell < 6; ++cell)
    {
      EXPECT_EQ(box->GetArray("IrradianceBack")->GetComponent(cell, 0), 0);
      EXPECT_GT(box->GetArray("IrradianceFront")->GetComponent(cell, 0), 1);
    }
    // Some 1,500 photons: chance exceeds 15 % in 1 of 10^8 runs.
    EXPECT_NEAR(box->GetArray("IrradianceFront")->GetComponent(4, 0), 100 / 0.75, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, FacesInOnePlane,
  testing::Values(How{ false, false }, How{ true, false }, How{ false, true }, How{ true, true }),
  testing::PrintToStringParamName());
