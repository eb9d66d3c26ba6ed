// SPDX-License-Identifier: BSD-3-Clause
// Input at the edge of what can be computed: without light or cells, without area, with all light
// reflected.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 500;

}

// A point that no cell uses may have any coordinates.
TEST(OddInput, UnusedPointThatIsNaN)
{
  const double nan = std::nan("");
  Scene scene = MakeSmallScene();
  scene.Moving[0].Model->GetPoints()->InsertNextPoint(nan, nan, nan);
  scene.Moving[0].Model->GetPointData()->Initialize();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  EXPECT_TRUE(Update(filter).Errors.empty());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
}

TEST(OddInput, NoLightIsOneWarningAndZeros)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.resize(1);
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  ExpectOne(observer->Warnings, { "no light" });
  EXPECT_EQ(ValuesOf(IrradianceOf(filter, 0, 0)), std::vector<double>(54));
  EXPECT_EQ(Field(filter, "EmittedPower"), 0);
}

TEST(OddInput, NoInputIsAnEmptyOutput)
{
  const auto filter = MakeFilter({}, NumberOfWalks);
  ExpectNothing(Update(filter));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
}

TEST(OddInput, EmptyPolyData)
{
  Scene scene = MakeSmallScene();
  scene.Fixed.push_back(Mesh::New());
  scene.Moving.push_back(MakeMoving(Mesh::New(), { 1, 1, 1 }));
  const auto filter = MakeFilter(scene, NumberOfWalks);
  EXPECT_TRUE(Update(filter).Errors.empty());
  EXPECT_EQ(OutputOf(filter->GetOutput(), 0, 2)->GetNumberOfCells(), 0);
  EXPECT_EQ(OutputOf(filter->GetOutput(), 1, 2)->GetNumberOfCells(), 0);
}

TEST(OddInput, CellsWithoutAreaAreKeptAndReported)
{
  Scene scene = MakeSmallScene();
  Mesh ball = Copy(scene.Moving[0].Model);
  const vtkIdType ids[3] = { 5, 5, 6 };
  ball->GetPolys()->ReplaceCellAtId(9, 3, ids);
  ball->GetPolys()->ReplaceCellAtId(11, 3, ids);
  scene.Moving[0].Model = ball;
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  ExpectOne(observer->Warnings, { "input port 1, connection 0", "2 cells", "cell 9" });
  EXPECT_EQ(IrradianceOf(filter, 1, 0)->GetNumberOfTuples(), ball->GetNumberOfCells());
  EXPECT_EQ(IrradianceOf(filter, 1, 0)->GetComponent(9, 0), 0);
  EXPECT_EQ(IrradianceOf(filter, 1, 0)->GetComponent(11, 0), 0);

  observer->Clear();
  scene.Moving[0].Pose->Translate(0.1, 0, 0);
  filter->Update();
  EXPECT_TRUE(observer->Warnings.empty()); // reported once
}

// A model of many parts has such cells in many: they are one warning, with the first and their
// number.
TEST(OddInput, CellsWithoutAreaOfManyInputsAreOneWarning)
{
  Scene scene = MakeSmallScene();
  constexpr vtkIdType parts = 12;
  for (vtkIdType i = 0; i < parts; ++i)
  {
    Mesh part = MakeBox(0.01, 0.01, 0.01);
    const vtkIdType line[3] = { 0, 1, 1 };
    for (vtkIdType cell = 0; cell <= i; ++cell)
    {
      part->GetPolys()->InsertNextCell(3, line);
    }
    part->GetCellData()->Initialize();
    i % 2 == 0 ? scene.Fixed.push_back(part)
               : scene.Moving.push_back(MakeMoving(part, { 1, 1, 1 }));
  }
  const auto filter = MakeFilter(scene, NumberOfWalks);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Update();
  ExpectOne(observer->Warnings,
    { "input port 0, connection 2: 1 cells", "the first is cell ",
      std::to_string(parts) + " such inputs",
      std::to_string(parts * (parts + 1) / 2) + " such cells" });
}

// Light that is never absorbed is an error, not an endless update.
TEST(OddInput, ReflectanceOneInAClosedRoom)
{
  Scene scene{ { MakeRoom(3, 1), MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }) }, {} };
  for (const Mesh& mesh : scene.Fixed)
  {
    SetCellValues(mesh, "DiffuseReflectance", { 1 });
  }
  ExpectWords(OnlyErrorOf(MakeFilter(scene, NumberOfWalks)), { "reflectance" });
}

// Very little light counts: powers times 2^k give irradiances times 2^k.
TEST(OddInput, TinyPowers)
{
  const Scene scene = MakeSmallScene();
  const auto expected = MakeFilter(scene, NumberOfWalks);
  expected->Update();
  for (const int k : { -100, -900 })
  {
    SetCellValues(scene.Fixed[1], "RadiantExitance", { std::ldexp(100.0, k) });
    const auto filter = MakeFilter(scene, NumberOfWalks);
    filter->Update();
    for (vtkIdType cell = 0; cell < 54; ++cell)
    {
      const double value = IrradianceOf(expected, 0, 0)->GetComponent(cell, 0);
      EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetComponent(cell, 0), std::ldexp(value, k))
        << "k " << k << ", cell " << cell;
    }
  }
  // A light below the normal doubles counts as none.
  SetCellValues(scene.Fixed[1], "RadiantExitance", { std::ldexp(100.0, -1060) });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  EXPECT_EQ(Update(filter).Warnings.size(), 1u);
  EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetComponent(0, 0), 0.0);
}
