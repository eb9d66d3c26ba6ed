// SPDX-License-Identifier: BSD-3-Clause
// RepairTimeBudget: stale light is reported, bounded, and repaired by further executions.

#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkPolygon.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

constexpr vtkIdType NumberOfWalks = 3000;
constexpr double NoTime = 1e-9; // s; over when it begins

double AreaOf(vtkPolyData* polyData, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  polyData->GetCellPoints(cell, ids);
  double normal[3];
  return vtkPolygon::ComputeArea(
    polyData->GetPoints(), ids->GetNumberOfIds(), ids->GetPointer(0), normal);
}

bool IsAnythingStale(vtkIrradianceFilter* filter)
{
  return filter->GetOutput()->GetFieldData()->GetArray("StalePower")->GetRange(-1)[1] > 0;
}

/// Checks both bounds for all cells of both filters' outputs.
void ExpectBounds(vtkIrradianceFilter* now, vtkIrradianceFilter* full, const Scene& scene,
  const std::vector<std::string>& sides)
{
  const int bands =
    now->GetOutput()->GetFieldData()->GetArray("StalePower")->GetNumberOfComponents();
  for (int band = 0; band < bands; ++band)
  {
    double brought = 0, received = 0;
    const auto add = [&](unsigned int port, unsigned int i) {
      vtkPolyData* before = OutputOf(now->GetOutput(), port, i);
      vtkPolyData* after = OutputOf(full->GetOutput(), port, i);
      for (vtkIdType cell = 0; cell < before->GetNumberOfCells(); ++cell)
      {
        for (const std::string& side : sides)
        {
          const auto value = [&](vtkPolyData* block, const std::string& name) {
            return block->GetCellData()->GetArray((name + side).c_str())->GetComponent(cell, band);
          };
          const double e = value(before, "Irradiance"), stale = value(before, "StaleIrradiance"),
                       exact = value(after, "Irradiance");
          EXPECT_GE(stale, 0);
          EXPECT_LE(stale, e * (1 + 1e-12));
          EXPECT_GE(exact, (e - stale) - 1e-12 * e);
          brought += (exact - (e - stale)) * AreaOf(before, cell);
          received += exact * AreaOf(before, cell);
        }
      }
    };
    for (unsigned int i = 0; i < scene.Fixed.size(); ++i)
    {
      add(0, i);
    }
    for (unsigned int i = 0; i < scene.Moving.size(); ++i)
    {
      add(1, i);
    }
    EXPECT_GT(brought, 0.05 * received) << "nothing was stale";
    // The output's points are floats, and so are their areas.
    EXPECT_LE(brought, Field(now, "StaleGainBound", band) + 1e-6 * received);
  }
}

}

TEST(TimeBudget, SaysWhatWaitsAndMakesItGood)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetRepairTimeBudget(NoTime);
  filter->Update();
  EXPECT_FALSE(IsAnythingStale(filter)) << "the first shooting is no repair";
  const auto full = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 5; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.1, 0.2, 0.05);
    scene.Moving[1].Pose->RotateZ(20);
    filter->Update();
    full->Update();
    EXPECT_TRUE(IsAnythingStale(filter));
    EXPECT_LE(Field(filter, "StalePower"), Field(filter, "EmittedPower"));
    EXPECT_LE(Field(filter, "StalePower"), Field(filter, "StaleGainBound"));
    EXPECT_EQ(Field(filter, "EmittedPower"),
      Field(filter, "AbsorbedPower") + Field(filter, "EscapedPower"));
    ExpectBounds(filter, full, scene, { "" });
  }
  filter->SetRepairTimeBudget(2e-4);
  int calls = 0;
  for (double left = Field(filter, "StalePower"); left > 0; ++calls)
  {
    filter->Modified();
    filter->Update();
    ASSERT_LT(Field(filter, "StalePower"), left) << "call " << calls;
    left = Field(filter, "StalePower");
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
    EXPECT_EQ(Field(filter, "VerifySeconds"), 0) << "nothing has moved";
  }
  EXPECT_GT(calls, 0);
  full->SetRepairTimeBudget(1); // for the same arrays
  full->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(full)));
}

TEST(TimeBudget, InColourWithSidesAndLifted)
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[1], "RadiantExitance", { 50, 100, 25 });
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.8, 0.6, 0.2 });
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SeparateSidesOn();
  filter->SetRepairTimeBudget(NoTime);
  filter->Update();
  scene.Moving[0].Pose->Translate(0.1, 0.2, 0.05);
  filter->Update();
  const auto full = MakeFilter(scene, NumberOfWalks);
  full->SeparateSidesOn();
  full->Update();
  ExpectBounds(filter, full, scene, { "Front", "Back" });
  filter->SetRepairTimeBudget(0);
  filter->Update();
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(full)));
}

TEST(TimeBudget, ArraysOnlyWhereThereIsOne)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  for (const double budget : { 0.0, 1.0, 0.0 })
  {
    filter->SetRepairTimeBudget(budget);
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
    filter->Update();
    for (const unsigned int port : { 0u, 1u })
    {
      vtkCellData* cells = OutputOf(filter->GetOutput(), port, 0)->GetCellData();
      EXPECT_EQ(cells->HasArray("StaleIrradiance"), budget > 0);
      EXPECT_STREQ(cells->GetScalars()->GetName(), "Irradiance");
    }
    EXPECT_EQ(filter->GetOutput()->GetFieldData()->HasArray("StaleGainBound"), budget > 0);
    EXPECT_EQ(Field(filter, "StalePower"), 0);
  }
}

TEST(TimeBudget, HasNoMeaningForARebuild)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetUpdateModeToRebuild();
  filter->SetRepairTimeBudget(NoTime);
  filter->Update();
  scene.Moving[0].Pose->Translate(0.1, 0.2, 0.05);
  filter->Update();
  EXPECT_FALSE(IsAnythingStale(filter));
  const auto fresh = MakeFilter(scene, NumberOfWalks);
  fresh->SetRepairTimeBudget(NoTime);
  fresh->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
}
