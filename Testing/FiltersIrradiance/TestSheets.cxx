// SPDX-License-Identifier: BSD-3-Clause
// Cell arrays of thin sheets.

#include "OutputChecks.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// A black room of 2 m with a lamp, and what is given below the lamp, from wall to wall.
double FloorBelow(const char* name, const std::vector<double>& values, bool isMoving = false,
  const char* readAs = nullptr)
{
  Scene scene = MakeEmptyRoom();
  scene.Fixed = { MakeRoom(2, 2), MakeLamp({ 1, 1, 1.9 }, 0.5, { 100 }) };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0 });
  SetCellValues(scene.Fixed[1], "DiffuseReflectance", { 0 });
  const auto sheet = MakeRectangle({ 0, 0, 1 }, { 2, 0, 0 }, { 0, 2, 0 }, 1);
  SetCellValues(sheet, "DiffuseReflectance", { 0 });
  name ? SetCellValues(sheet, name, values) : void();
  if (name && isMoving)
  {
    scene.Moving = { MakeMoving(sheet, { 0, 0, 0 }) };
  }
  else if (name)
  {
    scene.Fixed.push_back(sheet);
  }
  const auto filter = MakeFilter(scene, 200000);
  filter->SetDirectLightToGathered();
  readAs ? filter->SetCellArray(readAs, name) : void();
  filter->Update();
  double sum = 0;
  vtkPolyData* room = OutputOf(filter->GetOutput(), 0, 0);
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    room->GetCellBounds(cell, bounds);
    sum += bounds[5] < 1e-9 ? IrradianceOf(filter, 0, 0)->GetComponent(cell, 0) : 0;
  }
  return sum;
}

}

// The noise is some tenths of a percent of a floor of four cells that gather.
TEST(Sheets, LightGoesThroughAsArraysSay)
{
  const double open = FloorBelow(nullptr, {});
  ASSERT_GT(open, 0);
  EXPECT_EQ(FloorBelow("SpecularTransmittance", { 0 }), 0);
  for (const bool isMoving : { false, true })
  {
    EXPECT_NEAR(FloorBelow("SpecularTransmittance", { 0.5 }, isMoving) / open, 0.5, 0.02);
  }
  EXPECT_NEAR(FloorBelow("Openness", { 0.5 }, false, "SpecularTransmittance") / open, 0.5, 0.02);
  EXPECT_GT(FloorBelow("DiffuseTransmittance", { 0.5 }), 0);
  const double glazed = FloorBelow("RefractiveIndex", { 1.5 }) / open; // at some 20 to 50 degrees
  EXPECT_GT(glazed, 0.88);
  EXPECT_LT(glazed, 0.93);
}
