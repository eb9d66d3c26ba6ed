// SPDX-License-Identifier: BSD-3-Clause
// RepairTimeBudget: stale light is reported, bounded, and repaired by further executions.

#include "OutputBits.h"
#include "OutputChecks.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

using namespace TestScenes;
using OutputChecks::MostStale;

namespace
{

constexpr vtkIdType NumberOfWalks = 3000;
constexpr double NoTime = 1e-9; // s; over when it begins

}

TEST(TimeBudget, SaysWhatWaitsAndMakesItGood)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetRepairTimeBudget(NoTime);
  filter->Update();
  EXPECT_EQ(MostStale(filter), 0) << "the first shooting is no repair";
  const auto full = MakeFilter(scene, NumberOfWalks);
  for (int frame = 0; frame < 5; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.1, 0.2, 0.05);
    scene.Moving[1].Pose->RotateZ(20);
    filter->Update();
    full->Update();
    EXPECT_GT(MostStale(filter), 0);
    EXPECT_LE(Field(filter, "StalePower"), Field(filter, "EmittedPower"));
    EXPECT_LE(Field(filter, "StalePower"), Field(filter, "StaleGainBound"));
    EXPECT_EQ(Field(filter, "EmittedPower"),
      Field(filter, "AbsorbedPower") + Field(filter, "EscapedPower"));
    OutputChecks::ExpectBounds(filter, full, 1e-6); // the points of outputs are floats
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
  OutputChecks::ExpectBounds(filter, full, 1e-6); // the points of outputs are floats
  filter->SetRepairTimeBudget(0);
  EXPECT_TRUE(UpdatesLike(filter, full));
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
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
  EXPECT_EQ(MostStale(filter), 0);
  const auto fresh = MakeFilter(scene, NumberOfWalks);
  fresh->SetRepairTimeBudget(NoTime);
  EXPECT_TRUE(UpdatesLike(filter, fresh));
}
