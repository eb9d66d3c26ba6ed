// SPDX-License-Identifier: BSD-3-Clause
// The tracer against vtkIrradianceFilter, and what stands around it.
#include "../../Testing/FiltersIrradiance/TestScenes.h"
#include "BidirectionalTracer.h"
#include "Film.h"
#include "Options.h"
#include "ReadScene.h"
#include "RoomScene.h"
#include "TeapotScene.h"

#include "SmpExecution.h"

#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkTessellatedBoxSource.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

using namespace irradiance;
using namespace pathtracedroom;
using namespace TestScenes;

namespace
{

/// The cells with an area; the others have no irradiance.
std::vector<CellId> CellsOf(const SceneObjects& objects, std::vector<double>& areasOfThem)
{
  std::vector<CellId> cells;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      if (areas[cell] > 0)
      {
        cells.push_back({ object, cell });
        areasOfThem.push_back(areas[cell]);
      }
    }
  }
  return cells;
}

/// The irradiance of all cells as the engine numbers them: one after the other in the static block, and
/// by object in the dynamic one.
std::vector<std::vector<Spectrum>> FilteredLight(vtkIrradianceFilter* filter)
{
  filter->Update();
  std::vector<std::vector<Spectrum>> light(1);
  for (unsigned int port = 0; port < 2; ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(int(port)); ++i)
    {
      vtkDataArray* values = IrradianceOf(filter, port, unsigned(i));
      if (port == 1)
      {
        light.emplace_back();
      }
      for (vtkIdType cell = 0; cell < values->GetNumberOfTuples(); ++cell)
      {
        Spectrum value = Spectrum::Zero();
        values->GetTuple(cell, value.data());
        light.back().push_back(value);
      }
    }
  }
  return light;
}

constexpr int kSeeds = 32;

/// The filter's mean over the seeds.
Estimates FilteredEstimates(vtkIrradianceFilter* filter, const std::vector<CellId>& cells)
{
  Estimates estimates(cells.size());
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    filter->SetSeed(seed);
    const auto light = FilteredLight(filter);
    std::vector<Spectrum> values;
    for (const CellId& cell : cells)
    {
      values.push_back(light[cell.object][cell.cell]);
    }
    estimates.add(values);
  }
  return estimates;
}

/// W in all bands, that one walk carries through all seeds.
double PowerOfOneWalk(vtkIrradianceFilter* filter)
{
  vtkDataArray* emitted = filter->GetOutput()->GetFieldData()->GetArray("EmittedPower");
  double power = 0;
  for (int band = 0; band < emitted->GetNumberOfComponents(); ++band)
  {
    power += emitted->GetComponent(0, band);
  }
  return power / double(filter->GetNumberOfWalks()) / kSeeds;
}

/**
 * Cells agree. |t| > 6 of 31 to 62 degrees of freedom happens by chance once in 800,000 cells; those
 * that receive less than 100 photons from the filter, by the tracer's light, are not compared one by
 * one. And all cells together receive the same power within 1 %, so that no error hides in the noise.
 */
void ExpectAgreement(vtkIrradianceFilter* filter, std::uint32_t samples)
{
  const SceneObjects objects = ReadScene(filter);
  std::vector<double> areas;
  const std::vector<CellId> cells = CellsOf(objects, areas);
  SmpExecution execution([](double) { return true; });
  const Estimates traced = irradianceAt(objects, cells, {}, kSeeds, samples, execution);
  const Estimates filtered = FilteredEstimates(filter, cells);
  Spectrum power = Spectrum::Zero(), filteredPower = Spectrum::Zero(), worst = Spectrum::Zero();
  int compared = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    power += traced.mean(i) * areas[i];
    filteredPower += filtered.mean(i) * areas[i];
    if (traced.mean(i).sum() * areas[i] < 100 * PowerOfOneWalk(filter))
    {
      continue;
    }
    ++compared;
    const Spectrum error =
      (traced.standardError(i).square() + filtered.standardError(i).square()).sqrt();
    const Spectrum t = (traced.mean(i) - filtered.mean(i)).abs() / (error + 1e-300);
    EXPECT_LT(t.maxCoeff(), 6) << "object " << cells[i].object << ", cell " << cells[i].cell << ": "
                               << traced.mean(i).transpose() << ", " << filtered.mean(i).transpose()
                               << " +- " << error.transpose();
    worst = worst.max(t);
  }
  for (int band = 0; band < objects.staticObject.material->bands; ++band)
  {
    EXPECT_NEAR(power[band] / filteredPower[band], 1, 0.01);
  }
  std::cout << compared << " of " << cells.size() << " cells compared, largest |t| "
            << worst.transpose() << "; power " << power.transpose() << " W, the filter's "
            << filteredPower.transpose() << " W\n";
}

}

TEST(LightOnCells, OfLitRoomIsTheFilters)
{
  vtkNew<vtkTessellatedBoxSource> room;
  room->SetBounds(-2, 2, -2, 2, 0, 3);
  room->SetLevel(3);
  room->QuadsOn();
  vtkNew<vtkSphereSource> ball;
  vtkNew<vtkTransform> worldFromBall;
  worldFromBall->Translate(-0.2, 0, 0.8);
  vtkNew<vtkIrradianceFilter> filter;
  filter->AddInputConnection(0, room->GetOutputPort());
  filter->AddInputDataObject(0, MakeLamp({ 0, 0, 2.9 }, 1, { 100 }));
  filter->AddInputConnection(1, ball->GetOutputPort());
  filter->SetDynamicTransform(0, worldFromBall);
  filter->SetNumberOfWalks(20000);
  ExpectAgreement(filter, 16);
}

TEST(LightOnCells, OfMovingTeapotIsTheFilters)
{
  movingteapot::SceneConfig config;
  config.CellSize = 0.8;
  config.TeapotSegments = 2;
  const movingteapot::TeapotScene scene = movingteapot::MakeTeapotScene(config);
  vtkNew<vtkTransform> pose;
  movingteapot::TeapotPath().SetPose(0.4, pose);
  vtkNew<vtkIrradianceFilter> filter;
  for (vtkPolyData* still : { scene.Room.Get(), scene.Lamp.Get(), scene.Plinth.Get() })
  {
    filter->AddInputDataObject(0, still);
  }
  filter->AddInputDataObject(1, scene.Teapot);
  filter->SetDynamicTransform(0, pose);
  filter->SetNumberOfWalks(20000);
  ExpectAgreement(filter, 8);
}

TEST(LightOnCells, OfASheetSeenFromBothSidesIsTheFilters)
{
  Mesh sheet = MakeRectangle({ -1, -1, 1 }, { 2, 0, 0 }, { 0, 2, 0 }, 3);
  SetCellValues(sheet, "DiffuseReflectance", { 0.8, 0.5, 0.2 });
  vtkNew<vtkIrradianceFilter> filter;
  filter->AddInputDataObject(0, MakeRectangle({ -2, -2, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4));
  filter->AddInputDataObject(0, sheet);
  filter->AddInputDataObject(0, MakeLamp({ 0.5, 0, 3 }, 1, { 10, 20, 30 }));
  filter->AddInputDataObject(0, MakePointLight({ -0.3, 0.2, 0.4 }, { 5, 2, 1 }));
  filter->SetNumberOfWalks(20000);
  ExpectAgreement(filter, 128);
}

// Gloss and mirror, three bands: the room of the picture with a coarse teapot.
TEST(LightOnCells, OfTheGlossyRoomIsTheFilters)
{
  RoomScene scene;
  MakeRoomScene("room", 2, scene);
  scene.Light->SetNumberOfWalks(20000);
  ExpectAgreement(scene.Light, 2);
}
