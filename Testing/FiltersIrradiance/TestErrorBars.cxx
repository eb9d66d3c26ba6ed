// SPDX-License-Identifier: BSD-3-Clause
// Standard errors and the target error, as the user of the filter sees them.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace TestScenes;

namespace
{

/// A closed room; with three bands, no light in the third.
Scene MakeLitScene(int bands)
{
  const std::vector<double> flux =
    bands == 1 ? std::vector<double>{ 100 } : std::vector<double>{ 100, 50, 0 };
  Scene scene = MakeSmallScene();
  scene.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, flux);
  return scene;
}

vtkDataArray* CellArray(vtkIrradianceFilter* filter, unsigned int port, const char* name)
{
  return OutputOf(filter->GetOutput(), port, 0)->GetCellData()->GetArray(name);
}

bool HasField(vtkIrradianceFilter* filter, const char* name)
{
  return filter->GetOutput()->GetFieldData()->HasArray(name) != 0;
}

}

TEST(StandardError, ArraysAreThoseAskedFor)
{
  const auto filter = MakeFilter(MakeLitScene(3), 2000);
  filter->Update();
  EXPECT_FALSE(CellArray(filter, 0, "IrradianceStandardError"));
  EXPECT_FALSE(HasField(filter, "ConfidenceFactor"));
  EXPECT_FALSE(HasField(filter, "ReachedRelativeError"));

  filter->ComputeStandardErrorOn();
  filter->Update();
  vtkDataArray* errors = CellArray(filter, 1, "IrradianceStandardError");
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->GetNumberOfComponents(), 3);
  EXPECT_EQ(errors->GetDataType(), VTK_DOUBLE);
  EXPECT_EQ(errors->GetNumberOfTuples(), IrradianceOf(filter, 1, 0)->GetNumberOfTuples());
  EXPECT_NEAR(Field(filter, "ConfidenceFactor"), 2.1314, 1e-4); // 15 degrees of freedom

  filter->SeparateSidesOn();
  filter->SetNumberOfReplicates(2);
  filter->Update();
  EXPECT_FALSE(CellArray(filter, 0, "IrradianceStandardError"));
  EXPECT_TRUE(CellArray(filter, 0, "IrradianceFrontStandardError"));
  EXPECT_TRUE(CellArray(filter, 0, "IrradianceBackStandardError"));
  EXPECT_NEAR(Field(filter, "ConfidenceFactor"), 12.706, 1e-3);
}

// The third band has no light, so no photon shows that its zeros are right. The outsides of the
// walls, points and cells without area receive nothing either.
TEST(StandardError, IsNaNWhereNothingIsKnown)
{
  Scene scene = MakeLitScene(3);
  Mesh degenerate = MakeRectangle({ 0.5, 0.5, 0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 1);
  for (vtkIdType i = 0; i < 4; ++i)
  {
    degenerate->GetPoints()->SetPoint(i, 0.5 + 0.1 * static_cast<double>(i), 0.5, 0.5);
  }
  scene.Fixed.push_back(degenerate);
  scene.Fixed.push_back(MakePointLight({ 1, 1, 2 }, { 1, 1, 0 }));
  const auto filter = MakeFilter(scene, 20000);
  filter->ComputeStandardErrorOn();
  filter->SeparateSidesOn();
  filter->Update();
  vtkDataArray* front = CellArray(filter, 0, "IrradianceFrontStandardError");
  vtkDataArray* back = CellArray(filter, 0, "IrradianceBackStandardError");
  for (vtkIdType i = 0; i < front->GetNumberOfTuples(); ++i)
  {
    EXPECT_GT(front->GetComponent(i, 0), 0);
    EXPECT_GT(front->GetComponent(i, 1), 0);
    EXPECT_TRUE(std::isnan(front->GetComponent(i, 2)));
    EXPECT_TRUE(std::isnan(back->GetComponent(i, 0)));
  }
  for (const unsigned int connection : { 2u, 3u })
  {
    vtkCellData* cells = OutputOf(filter->GetOutput(), 0, connection)->GetCellData();
    ASSERT_EQ(cells->GetNumberOfTuples(), 1);
    EXPECT_EQ(cells->GetArray("IrradianceFront")->GetComponent(0, 0), 0);
    EXPECT_TRUE(std::isnan(cells->GetArray("IrradianceFrontStandardError")->GetComponent(0, 0)));
  }
}

TEST(Target, IsReachedQuietly)
{
  const auto filter = MakeFilter(MakeLitScene(1), 1000);
  const auto observer = ErrorObserver::Watch(filter);
  filter->SetTargetRelativeError(0.2);
  filter->Update();
  EXPECT_TRUE(observer->Warnings.empty());
  EXPECT_TRUE(observer->Errors.empty());
  const double reached = Field(filter, "ReachedRelativeError");
  EXPECT_GT(reached, 0);
  EXPECT_LE(reached, 0.2);
  EXPECT_GT(Field(filter, "NumberOfWalks"), 1000);
  EXPECT_FALSE(CellArray(filter, 0, "IrradianceStandardError")) << "not asked for";
  EXPECT_NEAR(Field(filter, "EmittedPower"), 56.25, 1e-9 * 56.25);
  EXPECT_EQ(
    Field(filter, "EmittedPower"), Field(filter, "AbsorbedPower") + Field(filter, "EscapedPower"));
}

TEST(Target, BeyondTheLimitWarnsOfWhatWasReached)
{
  const auto filter = MakeFilter(MakeLitScene(1), 4000);
  const auto observer = ErrorObserver::Watch(filter);
  filter->SetTargetRelativeError(0.001);
  filter->SetMaximumEffort(2.5);
  filter->Update();
  EXPECT_EQ(Field(filter, "NumberOfWalks"), 10000);
  std::ostringstream reached;
  reached << Field(filter, "ReachedRelativeError");
  ExpectOne(observer->Warnings, { "TargetRelativeError 0.001", "10000", reached.str() });

  observer->Clear();
  filter->SetNumberOfWalks(100);
  filter->SetMaximumEffort(1);
  filter->Update();
  EXPECT_TRUE(std::isinf(Field(filter, "ReachedRelativeError")));
  ExpectOne(observer->Warnings, { "too few photons" });
}

TEST(Target, BeyondTheLimitsOfBothLeversNamesBoth)
{
  const auto filter = MakeFilter(MakeLitScene(1), 4000);
  const auto observer = ErrorObserver::Watch(filter);
  filter->SetMethodToGatheredEverywhere();
  filter->SetNumberOfRays(16);
  filter->SetMaximumEffort(2.5);
  filter->SetTargetRelativeError(1e-6);
  filter->Update();
  EXPECT_EQ(Field(filter, "NumberOfGatherRays"), 32)
    << "the last number of 16, 32, ... below the limit";
  EXPECT_EQ(filter->GetFigure("NumberOfGatherRays"), 32);
  ExpectOne(observer->Warnings, { "MaximumEffort 2.5", "10000 walks", "32 rays a side" });
}
