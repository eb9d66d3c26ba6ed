// SPDX-License-Identifier: BSD-3-Clause
// The estimates of the irradiance of cells, as the user of the filter sees them.

#include "OutputBits.h"
#include "OutputChecks.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace TestScenes;
using OutputChecks::AreaOf;

namespace
{

constexpr vtkIdType NumberOfWalks = 20000;

/// A room whose walls receive hundreds of photons a cell, a fine ball, and a box.
Scene MakeFineScene()
{
  Scene scene = MakeSmallScene();
  scene.Moving[0].Model = MakeBall(0.4, 30);
  return scene;
}

double PowerOn(vtkIrradianceFilter* filter, unsigned int port, unsigned int i)
{
  vtkPolyData* output = OutputOf(filter->GetOutput(), port, i);
  vtkDataArray* irradiance = IrradianceOf(filter, port, i);
  double power = 0;
  for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
  {
    power += irradiance->GetTuple1(cell) * AreaOf(output, cell);
  }
  return power;
}

/// Root of the mean square difference of neighbouring cells on the ball, over their mean.
double Roughness(vtkIrradianceFilter* filter)
{
  vtkDataArray* values = IrradianceOf(filter, 1, 0);
  double squares = 0, sum = 0;
  for (vtkIdType i = 1; i < values->GetNumberOfTuples(); ++i)
  {
    squares += std::pow(values->GetTuple1(i) - values->GetTuple1(i - 1), 2);
    sum += values->GetTuple1(i);
  }
  return std::sqrt(squares * static_cast<double>(values->GetNumberOfTuples())) / sum;
}

}

TEST(CellEstimate, DefaultsAndRange)
{
  vtkNew<vtkIrradianceFilter> filter;
  EXPECT_EQ(filter->GetCellEstimate(), vtkIrradianceFilter::Sums);
  EXPECT_EQ(filter->GetNumberOfSpreadPhotons(), 250);
  filter->SetCellEstimateToSpread();
  EXPECT_EQ(filter->GetCellEstimate(), vtkIrradianceFilter::Spread);
  filter->SetCellEstimateToSums();
  EXPECT_EQ(filter->GetCellEstimate(), vtkIrradianceFilter::Sums);
  filter->SetCellEstimate(99);
  EXPECT_EQ(filter->GetCellEstimate(), vtkIrradianceFilter::Nearest) << "clamped";
  filter->SetCellEstimateToSpread();
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("CellEstimate: 1\n"), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfSpreadPhotons: 250\n"), std::string::npos);
}

// Nothing is shot, walls keep their bits, and the fine ball keeps its power but not its noise.
TEST(CellEstimate, SpreadSmoothsSmallCellsOfTheSameWalks)
{
  const auto filter = MakeFilter(MakeFineScene(), NumberOfWalks);
  filter->Update();
  const OutputBits sums(filter);
  vtkNew<vtkDoubleArray> walls;
  walls->DeepCopy(IrradianceOf(filter, 0, 0));
  const double power = PowerOn(filter, 1, 0), roughness = Roughness(filter);

  filter->SetCellEstimateToSpread();
  filter->Update();
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  for (vtkIdType i = 0; i < walls->GetNumberOfTuples(); ++i)
  {
    ASSERT_EQ(IrradianceOf(filter, 0, 0)->GetTuple1(i), walls->GetTuple1(i));
  }
  EXPECT_NEAR(PowerOn(filter, 1, 0) / power, 1, 1e-6) << "areas come from float points";
  EXPECT_LT(Roughness(filter), 0.2 * roughness) << "was " << roughness;

  filter->SetCellEstimateToSums();
  filter->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), sums));
}

TEST(CellEstimate, MorePhotonsAreSmoother)
{
  const auto filter = MakeFilter(MakeFineScene(), NumberOfWalks);
  filter->SetCellEstimateToSpread();
  double before = 1e9;
  for (const int photons : { 10, 50, 250, 1000 })
  {
    filter->SetNumberOfSpreadPhotons(photons);
    filter->Update();
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, photons == 10);
    EXPECT_LT(Roughness(filter), before);
    before = Roughness(filter);
  }
}

// Error bars, sides and motion at once; each frame equals a new filter, bit for bit.
TEST(CellEstimate, UpdateEqualsRebuild)
{
  Scene scene = MakeFineScene();
  const auto make = [&] {
    auto filter = MakeFilter(scene, NumberOfWalks);
    filter->SetCellEstimateToSpread();
    filter->ComputeStandardErrorOn();
    filter->SetNumberOfReplicates(4);
    filter->SeparateSidesOn();
    return filter;
  };
  const auto updated = make();
  for (int frame = 0; frame < 6; ++frame)
  {
    updated->Update();
    const auto fresh = make();
    fresh->Update();
    ASSERT_TRUE(IsSame(OutputBits(updated), OutputBits(fresh))) << "frame " << frame;
    scene.Moving[0].Pose->Translate(0.07, 0.03, 0);
    scene.Moving[0].Pose->RotateY(20);
    if (frame % 2 == 0)
    {
      scene.Moving[1].Pose->Scale(1, 1.1, 0.8);
    }
  }
}

// Parts of a static surface that come through several connections are one surface.
TEST(CellEstimate, SpreadsAcrossStaticConnections)
{
  const auto roomOf = [](bool isGap) {
    const double start = isGap ? 1.001 : 1;
    return Scene{ { MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10),
                    MakeRectangle({ start, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10),
                    // A wall between the lamp and the second part.
                    MakeRectangle({ 1, -9, 0 }, { 0, 20, 0 }, { 0, 0, 9 }, 1),
                    MakePointLight({ 0.5, 0.5, 0.1 }, { 1 }) },
      {} };
  };
  for (const bool isGap : { false, true })
  {
    const auto filter = MakeFilter(roomOf(isGap), 1000);
    filter->SetDefaultDiffuseReflectance(0);
    filter->SetCellEstimateToSpread();
    filter->Update();
    double beyond = 0;
    for (vtkIdType i = 0; i < 100; ++i)
    {
      beyond += IrradianceOf(filter, 0, 1)->GetTuple1(i);
    }
    EXPECT_EQ(beyond > 0, !isGap);
  }
}
