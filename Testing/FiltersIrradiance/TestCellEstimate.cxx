// SPDX-License-Identifier: BSD-3-Clause
// The estimates of the irradiance of cells, as the user of the filter sees them.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "OutputChecks.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

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

// Nothing is shot, walls keep their bits, and the fine ball keeps its power but not its noise.
TEST(CellEstimate, SpreadSmoothsSmallCellsOfTheSameWalks)
{
  const auto filter = MakeFilter(MakeFineScene(), NumberOfWalks);
  filter->Update();
  const OutputBits sums(filter);
  const std::vector<double> walls = ValuesOf(IrradianceOf(filter, 0, 0));
  const double power = PowerOn(filter, 1, 0), roughness = Roughness(filter);

  filter->SetMethodToSpreadWalks();
  filter->Update();
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
  EXPECT_EQ(ValuesOf(IrradianceOf(filter, 0, 0)), walls);
  EXPECT_NEAR(PowerOn(filter, 1, 0) / power, 1, 1e-6) << "areas come from float points";
  EXPECT_LT(Roughness(filter), 0.2 * roughness) << "was " << roughness;
  filter->SetMethodToGathered();
  filter->Update();
  EXPECT_LT(Roughness(filter), 0.5 * roughness) << "was " << roughness;

  filter->SetMethodToWalks();
  filter->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), sums));
}

TEST(CellEstimate, MorePhotonsAreSmoother)
{
  const auto filter = MakeFilter(MakeFineScene(), NumberOfWalks);
  filter->SetMethodToSpreadWalks();
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

TEST(CellEstimate, GatheredSaysWhatItNeeds)
{
  const auto filter = MakeFilter(MakeFineScene(), NumberOfWalks);
  filter->SetMethodToGathered();
  filter->SetDirectLightToShot();
  ExpectWords(OnlyErrorOf(filter), { "CellEstimate Gathered needs DirectLight Gathered" });
  filter->SetDirectLightToGathered();
  filter->SetNumberOfRays(0);
  ExpectWords(OnlyErrorOf(filter), { "NumberOfRays is 0; 1 to 4096" });
  filter->SetNumberOfRays(8);
  filter->Update();
  EXPECT_GT(PowerOn(filter, 1, 0), 0);
}

// Before anything is shot, which with so many walks would take minutes.
TEST(CellEstimate, GatheredNamesWhatItDoesNotKnow)
{
  Scene scene = MakeFineScene();
  scene.Fixed.push_back(MakePointLight({ 1, 1, 1 }, { 20 }));
  SetCellValues(scene.Moving[1].Model, "SpecularReflectance", { 0 });
  scene.Moving[1].Model->GetCellData()->GetArray("SpecularReflectance")->SetComponent(3, 0, 0.25);
  const auto filter = MakeFilter(scene, 2000000000);
  filter->SetMethodToGathered();
  const std::string light = "input port 0, connection " + std::to_string(scene.Fixed.size() - 1);
  ExpectWords(OnlyErrorOf(filter),
    { light +
      ", cell 0: a point light of 20 W, and input port 1, connection 1, cell 3 has the specular "
      "reflectance 0.25: Method Gathered does not know" });
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
    filter->SetMethodToSpreadWalks();
    filter->Update();
    EXPECT_EQ(IrradianceOf(filter, 0, 1)->GetRange()[1] > 0, !isGap);
  }
}
