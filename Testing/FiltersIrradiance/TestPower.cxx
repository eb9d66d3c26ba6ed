// SPDX-License-Identifier: BSD-3-Clause
// Law 4 and law 7 in the field data: no photon is lost, and a scene pays only for what it has.

#include "TestScenes.h"

#include "vtkDataArray.h"
#include "vtkMath.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// W, of all cells of a block: irradiance times area, for cells of equal area.
double ReceivedPower(vtkIrradianceFilter* filter, unsigned int port, unsigned int i, double area)
{
  vtkDataArray* irradiance = IrradianceOf(filter, port, i);
  double sum = 0;
  for (vtkIdType cell = 0; cell < irradiance->GetNumberOfTuples(); ++cell)
  {
    sum += irradiance->GetComponent(cell, 0) * area;
  }
  return sum;
}

}

TEST(Power, EmittedIsAbsorbedPlusEscapedAfterEveryUpdate)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 5000);
  const double emitted = 0.75 * 0.75 * 100; // m2 W/m2
  for (int frame = 0; frame < 5; ++frame)
  {
    filter->Update();
    EXPECT_NEAR(Field(filter, "EmittedPower"), emitted, 1e-9 * emitted) << frame;
    EXPECT_EQ(
      Field(filter, "EmittedPower"), Field(filter, "AbsorbedPower") + Field(filter, "EscapedPower"))
      << frame;
    EXPECT_EQ(Field(filter, "EscapedPower"), 0) << frame; // the room is closed
    EXPECT_EQ(Field(filter, "StalePower"), 0) << frame;
    EXPECT_EQ(Field(filter, "NumberOfWalks"), 5000);
    EXPECT_GE(Field(filter, "NumberOfSegments"), 5000);
    scene.Moving[0].Pose->Translate(0.1, 0.2, 0.05);
  }
}

TEST(Power, NothingIsAbsorbedWhereThereIsOnlyALight)
{
  const Scene scene{ { MakePointLight({ 0, 0, 0 }, { 60 }) }, {} };
  const auto filter = MakeFilter(scene, 1000);
  filter->Update();
  EXPECT_EQ(Field(filter, "EmittedPower"), 60);
  EXPECT_EQ(Field(filter, "EscapedPower"), 60);
  EXPECT_EQ(Field(filter, "AbsorbedPower"), 0);
  EXPECT_EQ(Field(filter, "NumberOfSegments"), 1000);
}

// The faces of a black cube receive the whole flux of a point light at its centre, a sixth each.
// The walks stratify the sphere, so the error is much smaller than 1 / sqrt(walks).
TEST(Power, BlackCubeAroundAPointLight)
{
  const Scene scene{ { MakeRoom(2, 1), MakePointLight({ 1, 1, 1 }, { 60 }) }, {} };
  const auto filter = MakeFilter(scene, 60000);
  filter->SetDefaultDiffuseReflectance(0);
  filter->Update();
  EXPECT_NEAR(ReceivedPower(filter, 0, 0, 4), 60, 1e-9 * 60);
  for (vtkIdType face = 0; face < 6; ++face)
  {
    EXPECT_NEAR(IrradianceOf(filter, 0, 0)->GetComponent(face, 0), 60.0 / 6 / 4, 0.01 * 2.5)
      << "face " << face;
  }
}

// All walls shine with M and reflect r: E = M + r E on each of them.
TEST(Power, ShiningWalls)
{
  const double exitance = 50, reflectance = 0.6;
  Mesh room = MakeRoom(2, 1);
  SetCellValues(room, "RadiantExitance", { exitance });
  SetCellValues(room, "DiffuseReflectance", { reflectance });
  const Scene scene{ { room }, {} };
  const auto filter = MakeFilter(scene, 100000);
  filter->Update();
  for (vtkIdType face = 0; face < 6; ++face)
  {
    const double expected = exitance / (1 - reflectance);
    EXPECT_NEAR(IrradianceOf(filter, 0, 0)->GetComponent(face, 0), expected, 0.03 * expected)
      << "face " << face;
  }
}

TEST(Power, NoHistoryWithoutDynamicInputOrWithoutVerification)
{
  Scene scene = MakeSmallScene();
  const auto filter = MakeFilter(scene, 1000);
  filter->Update();
  EXPECT_GT(Field(filter, "HistoryBytes"), 0);
  filter->SetUpdateModeToRebuild();
  filter->Update();
  EXPECT_EQ(Field(filter, "HistoryBytes"), 0);

  scene.Moving.clear();
  const auto still = MakeFilter(scene, 1000);
  still->Update();
  EXPECT_EQ(Field(still, "HistoryBytes"), 0);
  EXPECT_EQ(Field(still, "VerifySeconds"), 0);
  still->SetSeed(2);
  still->Update();
  EXPECT_EQ(Field(still, "HistoryBytes"), 0);
}

TEST(Power, GreyIsOneComponent)
{
  const auto filter = MakeFilter(MakeSmallScene(), 1000);
  filter->Update();
  EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetNumberOfComponents(), 1);
  EXPECT_STREQ(IrradianceOf(filter, 0, 0)->GetClassName(), "vtkDoubleArray");
  EXPECT_EQ(
    filter->GetOutput()->GetFieldData()->GetArray("EmittedPower")->GetNumberOfComponents(), 1);
}

// One array of three components makes three bands everywhere; grey arrays serve all of them. Equal
// bands are the grey result, up to rounding to quanta of 2^-45 of the power.
TEST(Power, ThreeEqualBandsAreTheGreyResult)
{
  Scene scene = MakeSmallScene();
  const auto grey = MakeFilter(scene, 2000);
  grey->Update();
  scene.Fixed[1] = MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100, 100, 100 });
  const auto bands = MakeFilter(scene, 2000);
  bands->Update();
  for (unsigned int port = 0; port < 2; ++port)
  {
    vtkDataArray* expected = IrradianceOf(grey, port, 0);
    vtkDataArray* found = IrradianceOf(bands, port, 0);
    ASSERT_EQ(found->GetNumberOfComponents(), 3);
    for (vtkIdType cell = 0; cell < expected->GetNumberOfTuples(); ++cell)
    {
      for (int band = 0; band < 3; ++band)
      {
        const double value = expected->GetComponent(cell, 0);
        EXPECT_NEAR(found->GetComponent(cell, band), value, 1e-6 * value)
          << "port " << port << ", cell " << cell << ", band " << band;
      }
    }
  }
  for (int band = 0; band < 3; ++band)
  {
    EXPECT_EQ(Field(bands, "EmittedPower", band),
      Field(bands, "AbsorbedPower", band) + Field(bands, "EscapedPower", band));
    EXPECT_NEAR(Field(bands, "EmittedPower", band), 56.25, 1e-6);
  }
}

// The front of a rectangle sees the light, the back sees nothing.
TEST(Power, SidesAreKeptApart)
{
  const Scene scene{ { MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1),
                       MakePointLight({ 0.5, 0.5, 1 }, { 60 }) },
    {} };
  const auto filter = MakeFilter(scene, 10000);
  filter->Update();
  const double both = IrradianceOf(filter, 0, 0)->GetComponent(0, 0);
  filter->SeparateSidesOn();
  filter->Update();
  vtkCellData* cells = OutputOf(filter->GetOutput(), 0, 0)->GetCellData();
  EXPECT_EQ(cells->GetArray("IrradianceFront")->GetComponent(0, 0), both);
  EXPECT_EQ(cells->GetArray("IrradianceBack")->GetComponent(0, 0), 0);
  EXPECT_FALSE(cells->HasArray("Irradiance"));
  // Solid angle of a unit square seen from 1 m above its centre: 4 asin(1 / 5), of 4 pi.
  const double expected = 60 * std::asin(0.2) / vtkMath::Pi();
  EXPECT_NEAR(both, expected, 0.02 * expected);
}
