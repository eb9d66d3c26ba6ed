// SPDX-License-Identifier: BSD-3-Clause
// Law 4 and law 7 in the field data: no photon is lost, and a scene pays only for what it has.

#include "TestScenes.h"

#include "vtkMath.h"

#include <gtest/gtest.h>

using namespace TestScenes;

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
    EXPECT_STREQ(IrradianceOf(filter, 0, 0)->GetClassName(), "vtkDoubleArray");
    EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetNumberOfComponents(), 1) << "grey";
    EXPECT_EQ(
      filter->GetOutput()->GetFieldData()->GetArray("EmittedPower")->GetNumberOfComponents(), 1);
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
  for (const unsigned int port : { 0u, 1u })
  {
    const auto expected = ValuesOf(IrradianceOf(grey, port, 0)),
               found = ValuesOf(IrradianceOf(bands, port, 0));
    ASSERT_EQ(found.size(), 3 * expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      EXPECT_NEAR(found[i], expected[i / 3], 1e-6 * expected[i / 3])
        << "port " << port << ", cell " << i / 3 << ", band " << i % 3;
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
