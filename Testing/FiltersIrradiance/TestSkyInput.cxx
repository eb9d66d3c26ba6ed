// SPDX-License-Identifier: BSD-3-Clause
// Sun and sky as inputs of the filters.

#include "../WriteFile.h"
#include "ExposureScenes.h"
#include "SensorPipeline.h"

#include "vtkOutgoingRadianceFilter.h"
#include "vtkSunSkySource.h"

#include <functional>
#include <limits>

using namespace ExposureScenes;

namespace
{

using Sky = vtkSmartPointer<vtkSunSkySource>;

/// 100 W/m2 of a uniform sky, and no ground.
Sky MakeUniformSky()
{
  auto sky = Sky::New();
  sky->SetSkyModelToUniform();
  sky->GroundOff();
  return sky;
}

/// 4 x 4 m.
Mesh MakeYard(double reflectance)
{
  Mesh yard = MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4);
  SetCellValues(yard, "DiffuseReflectance", { reflectance });
  return yard;
}

Scene MakeYardWithBox(double reflectance, const Vector& place)
{
  Mesh box = MakeBox(0.5, 0.5, 0.5);
  SetCellValues(box, "DiffuseReflectance", { reflectance });
  return { { MakeYard(reflectance) }, { MakeMoving(box, place) } };
}

Mesh DataOf(vtkSunSkySource* sky)
{
  sky->Update();
  return Copy(sky->GetOutput());
}

void SetTuple(vtkPolyData* data, const char* name, const std::vector<double>& tuple)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(tuple.size()));
  array->InsertNextTuple(tuple.data());
  data->GetFieldData()->AddArray(array);
}

}

TEST(SkyInput, LightsWhatStaysAndWhatMoves)
{
  const Scene scene = MakeYardWithBox(0, { 0, 0, 0.3 });
  auto filter = MakeDefaultFilter(scene, 20000);
  auto sky = MakeUniformSky();
  sky->SetDirectNormalIrradiance(500);
  sky->SetSunAltitude(30); // in the south: below y
  filter->AddInputConnection(0, sky->GetOutputPort());
  ExpectNothing(Update(filter));
  const auto yard = ValuesOf(IrradianceOf(filter, 0, 0));
  const auto box = ValuesOf(IrradianceOf(filter, 1, 0));
  ASSERT_EQ(yard.size(), 16u);
  ASSERT_EQ(box.size(), 6u);
  const double open = 100 + 250, south = 50 + 500 * std::sqrt(0.75);
  EXPECT_NEAR(yard[0], open, 0.02 * open) << "far from the box";
  EXPECT_NEAR(box[2], south, 0.02 * south) << "to the sun";
  EXPECT_NEAR(box[3], 50, 2) << "away from it";
  EXPECT_NEAR(box[4] + box[5], open, 0.02 * open) << "above, and nothing from below";
  EXPECT_EQ(OutputOf(filter->GetOutput(), 0, 1)->GetNumberOfCells(), 0) << "the sky has no cells";

  scene.Moving[0].Pose->Translate(0.5, 0, 0); // the shadow goes with it
  filter->Update();
  const auto moved = ValuesOf(IrradianceOf(filter, 0, 0));
  EXPECT_NE(moved, yard);
  auto fresh = MakeDefaultFilter(scene, 20000);
  fresh->AddInputConnection(0, sky->GetOutputPort());
  fresh->Update();
  EXPECT_EQ(ValuesOf(IrradianceOf(fresh, 0, 0)), moved);
  sky->SetDirectNormalIrradiance(0);
  filter->Update();
  EXPECT_NEAR(IrradianceOf(filter, 0, 0)->GetComponent(0, 0), 100, 2) << "at once without a sun";
  sky->SetDiffuseHorizontalIrradiance(0);
  ExpectNothing(Update(filter)); // a night is no mistake
  EXPECT_EQ(IrradianceOf(filter, 0, 0)->GetComponent(0, 0), 0);
}

TEST(SkyInput, HasBoundsInWhichAllStays)
{
  const Scene scene = MakeYardWithBox(0.5, { 0, 0, 0.3 });
  auto filter = MakeDefaultFilter(scene, 1000);
  auto sky = MakeUniformSky();
  filter->AddInputConnection(0, sky->GetOutputPort());
  scene.Moving[0].Pose->Translate(100, 0, 0);
  ExpectOnlyError(filter,
    { "input port 1", "leaves the box that the sky lights", "set SkyBounds",
      "Bounds of vtkSunSkySource" });
  sky->SetBounds(-3, 110, -3, 3, -1, 3);
  ExpectNothing(Update(filter));
  SetField(scene.Fixed[0], "touched", { 0 });
  sky->SetBounds(-1, 110, -3, 3, -1, 3);
  ExpectOnlyError(filter, { "leaves the box that the sky lights" });
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& bad : std::vector<std::array<double, 6>>{ { 0, 1, 0, 1, 2, 2 },
         { 5, -1, 0, 1, 0, 1 }, { 0, 1, 0, infinite, 0, 1 }, { 1, -1, 1, -1, 1, std::nan("") } })
  {
    sky->SetBounds(bad.data());
    const Reports reports = Update(sky);
    ExpectOne(reports.Errors, { "Bounds is ", "xmin, xmax, ymin, ymax, zmin and zmax of a box" });
    EXPECT_EQ(sky->GetOutput()->GetFieldData()->GetNumberOfArrays(), 0);
  }
  sky->SetBounds(1, -1, 1, -1, 1, -1);
  ExpectNothing(Update(sky));
  EXPECT_FALSE(sky->GetOutput()->GetFieldData()->HasArray("SkyBounds"));
}

TEST(SkyInput, IsRefusedWithAReason)
{
  const Mesh good = DataOf(MakeUniformSky());
  const struct
  {
    std::function<void(vtkPolyData*)> Change;
    std::vector<std::string> Words;
  } cases[] = {
    { [](auto* sky) { sky->GetFieldData()->RemoveArray("SkyPolarAngles"); },
      { "not the field-data array SkyPolarAngles" } },
    { [](auto* sky) {
       SetField(sky, "SkyAzimuths", { 0, 90, 360 });
     },
      { "SkyRadiance", "values for 3 azimuths" } },
    { [](auto* sky) {
       SetField(sky, "SkyPolarAngles", { 0, 190 });
     },
      { "SkyRadiance", "polar angle number 1 is 190" } },
    { [](auto* sky) { sky->GetFieldData()->GetArray("SkyRadiance")->SetComponent(3, 0, -2); },
      { "SkyRadiance", "value number 3 is -2" } },
    { [](auto* sky) {
       SetTuple(sky, "SkyRadiance", { 1, 2 });
     },
      { "SkyRadiance has 2 components; 1 is possible" } },
    { [](auto* sky) { SetTuple(sky, "SunIrradiance", { -1 }); },
      { "SunIrradiance has the value -1" } },
    { [](auto* sky) {
       SetTuple(sky, "SunIrradiance", { 1, 2 });
     },
      { "SunIrradiance is not one tuple of" } },
    { [](auto* sky) {
       SetTuple(sky, "SunIrradiance", { 1 });
       SetTuple(sky, "SunDirection", { 0, 0, 0 });
     },
      { "SunDirection is 0 0 0, no direction" } },
    { [](auto* sky) {
       SetTuple(sky, "SunIrradiance", { 1 });
       SetTuple(sky, "SunAngularRadius", { 50 });
     },
      { "SunAngularRadius is 50 degrees" } },
    { [](auto* sky) {
       SetTuple(sky, "SkyBounds", { 0, 1, 0, 1, 2, 1 });
     },
      { "SkyBounds is not xmin xmax" } },
    { [](auto* sky) {
       SetTuple(sky, "SkyWeights", { 1, 2 });
     },
      { "SkyWeights is not one tuple of 1 components" } },
  };
  for (const auto& one : cases)
  {
    const Mesh sky = Copy(good);
    one.Change(sky);
    auto words = one.Words;
    words.emplace_back("input port 0");
    ExpectOnlyError(MakeDefaultFilter({ { MakeYard(0.5), sky }, {} }, 500), words);
  }
  ExpectOnlyError(MakeDefaultFilter({ { MakeYard(0.5), good, Copy(good) }, {} }, 500),
    { "input port 0", "has a sky, as ", "there can be one" });
  ExpectOnlyError(MakeDefaultFilter({ { MakeYard(0.5) }, { MakeMoving(good, { 0, 0, 0 }) } }, 500),
    { "input port 1", "has a sky, which belongs to input port 0" });
  ExpectOnlyError(
    MakeDefaultFilter({ { good }, { MakeMoving(MakeBall(0.3, 6), { 0, 0, 1 }) } }, 500),
    { "nothing static tells where its light is wanted", "set SkyBounds" });
}

// Three bands: the sky is blue, the sun is not.
TEST(SkyInput, HasBands)
{
  const Mesh sky = DataOf(MakeUniformSky());
  SetTuple(sky, "SkyWeights", { 0.5, 1, 2 });
  SetTuple(sky, "SunIrradiance", { 30, 20, 10 });
  SetTuple(sky, "SunDirection", { 0, 0, 9 });
  const Mesh yard = MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1);
  SetCellValues(yard, "DiffuseReflectance", { 0, 0, 0 });
  auto filter = MakeDefaultFilter({ { yard, sky }, {} }, 20000);
  ExpectNothing(Update(filter));
  const auto bands = ValuesOf(IrradianceOf(filter, 0, 0));
  ASSERT_EQ(bands.size(), 3u);
  EXPECT_NEAR(bands[0], 80, 0.8);
  EXPECT_NEAR(bands[1], 120, 1.2);
  EXPECT_NEAR(bands[2], 210, 2.1);
}

// Two rows of weather, an hour apart: the dose is the mean of both times an hour.
TEST(SkyInput, GivesADoseOfTheWeather)
{
  auto sky = MakeUniformSky();
  sky->SetLatitude(48);
  sky->SetTimeZone(1);
  sky->SetLongitude(15);
  sky->SetWeatherFileName(
    WriteFile("Dose.csv", "time,DNI,DHI\n2024-06-21 11:00,0,100\n2024-06-21 12:00,0,200\n")
      .c_str());
  auto filter = MakeDefaultFilter({ { MakeYard(0) }, {} }, 50000);
  filter->AddInputConnection(0, sky->GetOutputPort());
  filter->UpdateInformation();
  EXPECT_EQ(StepsOf(filter), (std::vector<double>{ 0, 3600 }));
  filter->UpdateTimeStep(3600);
  EXPECT_NEAR(IrradianceOf(filter, 0, 0)->GetComponent(5, 0), 200, 4);
  const auto exposure = MakeExposure(filter);
  ExpectNothing(Update(exposure));
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(exposure->GetOutputDataObject(0));
  const auto dose = ValuesOf(OutputOf(blocks, 0, 0)->GetCellData()->GetArray("RadiantExposure"));
  ASSERT_EQ(dose.size(), 16u);
  for (const double joules : dose)
  {
    EXPECT_NEAR(joules, 150 * 3600, 0.02 * 150 * 3600);
  }
}

TEST(SkyInput, IsSeenBySensorsAndEyes)
{
  SensorPipeline pipeline({ { MakeYard(0.5), DataOf(MakeUniformSky()) }, {} }, 20000,
    MakeSensors(
      { { 0, 0, 0.1 }, { 0, 0, 0.1 }, { 5, 0, 3 } }, { { 0, 0, 1 }, { 1, 0, 0 }, { 0, 0, 1 } }));
  pipeline.Irradiance->SetMethodToAutomatic();
  pipeline.Probe->SetNumberOfRays(256);
  const auto measured = pipeline.Update("Irradiance");
  ASSERT_EQ(measured.size(), 3u);
  EXPECT_NEAR(measured[0], 100, 2);
  EXPECT_NEAR(measured[1], 50 + 25, 4) << "half of the sky, and the yard";
  EXPECT_NEAR(measured[2], 100, 2) << "beside the yard";
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(pipeline.Irradiance->GetOutputPort());
  radiance->SetEyePosition(0, 0, 3);
  ExpectNothing(Update(radiance));
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(radiance->GetOutputDataObject(0));
  const auto seen = ValuesOf(OutputOf(blocks, 0, 0)->GetCellData()->GetArray("Radiance"));
  ASSERT_EQ(seen.size(), 16u);
  EXPECT_NEAR(seen[5], 0.5 * 100 / vtkMath::Pi(), 0.5);
}
