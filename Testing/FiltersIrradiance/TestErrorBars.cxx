// SPDX-License-Identifier: BSD-3-Clause
// Standard errors and the target error, as the user of the filter sees them.

#include "ErrorObserver.h"
#include "OutputBits.h"
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

// Over the seeds, the irradiance scatters as its standard error says: the ratio of the two
// variances, averaged over the cells, is off by 5 of its standard errors once in 10^6.
TEST(StandardError, IsTheScatterOverSeeds)
{
  const Scene scene = MakeLitScene(1);
  const auto filter = MakeFilter(scene, 20000);
  filter->ComputeStandardErrorOn();
  constexpr int seeds = 40;
  std::vector<double> sum, squares, variances;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    filter->SetSeed(seed);
    filter->Update();
    vtkDataArray* values = IrradianceOf(filter, 0, 0);
    vtkDataArray* errors = CellArray(filter, 0, "IrradianceStandardError");
    ASSERT_TRUE(errors);
    const auto cells = static_cast<std::size_t>(values->GetNumberOfTuples());
    sum.resize(cells);
    squares.resize(cells);
    variances.resize(cells);
    for (std::size_t i = 0; i < cells; ++i)
    {
      const auto id = static_cast<vtkIdType>(i);
      sum[i] += values->GetComponent(id, 0);
      squares[i] += std::pow(values->GetComponent(id, 0), 2);
      variances[i] += std::pow(errors->GetComponent(id, 0), 2) / seeds;
    }
  }
  double ratio = 0;
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    const double scatter = (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    ratio += variances[i] / scatter / static_cast<double>(sum.size());
  }
  // 1 / scatter has the mean 1 + 2 / (seeds - 3) in units of 1 / variance.
  const double expected = (seeds - 1.0) / (seeds - 3.0);
  const double spread = std::sqrt((2.0 / seeds + 2.0 / seeds / 15) / double(sum.size()));
  std::cout << "ratio " << ratio << ", expected " << expected << " +- " << spread << "\n";
  EXPECT_NEAR(ratio, expected, 5 * spread);
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

TEST(StandardError, UpdateEqualsRebuild)
{
  const Scene scene = MakeLitScene(1);
  const auto make = [&] {
    auto filter = MakeFilter(scene, 3000);
    filter->ComputeStandardErrorOn();
    filter->SetTargetRelativeError(0.25);
    return filter;
  };
  const auto updated = make();
  RandomNumbers random(20260104);
  std::set<double> walks;
  for (int frame = 0; frame < 15; ++frame)
  {
    updated->Update();
    const auto fresh = make();
    fresh->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "frame " << frame;
    walks.insert(Field(updated, "NumberOfWalks"));
    scene.Moving[0].Pose->Identity();
    scene.Moving[0].Pose->Translate(
      1.5, 1.5, frame % 3 == 0 ? 2.43 : random.Between(0.5, 1.5)); // now and then under the lamp
  }
  EXPECT_GE(walks.size(), 2u) << "the number of walks rises and falls";
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
  ASSERT_EQ(observer->Warnings.size(), 1u);
  std::ostringstream reached;
  reached << Field(filter, "ReachedRelativeError");
  for (const std::string& word :
    { std::string("TargetRelativeError 0.001"), std::string("10000"), reached.str() })
  {
    EXPECT_NE(observer->Warnings[0].find(word), std::string::npos) << observer->Warnings[0];
  }

  observer->Clear();
  filter->SetNumberOfWalks(100);
  filter->SetMaximumEffort(1);
  filter->Update();
  EXPECT_TRUE(std::isinf(Field(filter, "ReachedRelativeError")));
  ASSERT_EQ(observer->Warnings.size(), 1u);
  EXPECT_NE(observer->Warnings[0].find("too few photons"), std::string::npos);
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
  ASSERT_EQ(observer->Warnings.size(), 1u);
  for (const char* word : { "MaximumEffort 2.5", "10000 walks", "32 rays a side" })
  {
    EXPECT_NE(observer->Warnings[0].find(word), std::string::npos) << observer->Warnings[0];
  }
}
