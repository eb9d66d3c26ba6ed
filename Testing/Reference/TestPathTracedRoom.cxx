// SPDX-License-Identifier: BSD-3-Clause
// The tracer against vtkIrradianceFilter, and what stands around it.
#include "../FiltersIrradiance/TestScenes.h"
#include "BidirectionalTracer.h"
#include "CellSensors.h"
#include "Film.h"
#include "Options.h"
#include "ReadScene.h"
#include "RoomScene.h"
#include "TeapotScene.h"

#include "Pipeline/FilterRun.h"

#include <vtkImageData.h>
#include <vtkOutgoingRadianceFilter.h>
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

/// The cells of at least this area, m2.
std::vector<CellId> CellsFrom(double leastArea, const SceneObjects& objects)
{
  std::vector<CellId> cells;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      if (areas[cell] >= leastArea)
      {
        cells.push_back({ object, cell });
      }
    }
  }
  return cells;
}

std::vector<double> AreasOf(const SceneObjects& objects, const std::vector<CellId>& cells)
{
  const CellPoints points(objects, cells);
  std::vector<double> areas;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    areas.push_back(points.area(i));
  }
  return areas;
}

/// A cell array of all cells as the engine numbers them: one after the other in the static block,
/// and by object in the dynamic one.
std::vector<std::vector<Spectrum>> ValuesOf(vtkMultiBlockDataSet* output, const char* name)
{
  std::vector<std::vector<Spectrum>> values(1);
  for (unsigned int port = 0; port < 2; ++port)
  {
    auto* block = vtkMultiBlockDataSet::SafeDownCast(output->GetBlock(port));
    for (unsigned int i = 0; i < block->GetNumberOfBlocks(); ++i)
    {
      vtkDataArray* array = OutputOf(output, port, i)->GetCellData()->GetArray(name);
      if (port == 1)
      {
        values.emplace_back();
      }
      for (vtkIdType cell = 0; cell < array->GetNumberOfTuples(); ++cell)
      {
        Spectrum value = Spectrum::Zero();
        array->GetTuple(cell, value.data());
        values.back().push_back(value);
      }
    }
  }
  return values;
}

constexpr int kSeeds = 32;

/// The mean over the seeds of what the last filter of a pipeline says.
Estimates FilteredEstimates(vtkIrradianceFilter* light, vtkMultiBlockDataSetAlgorithm* last,
  const char* name, const std::vector<CellId>& cells)
{
  Estimates estimates(cells.size());
  for (int seed = 1; seed <= kSeeds; ++seed)
  {
    light->SetSeed(seed);
    last->Update();
    const auto all = ValuesOf(last->GetOutput(), name);
    std::vector<Spectrum> values;
    for (const CellId& cell : cells)
    {
      values.push_back(all[cell.object][cell.cell]);
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
 * Cells agree. |t| > 6 of 31 to 62 degrees of freedom happens by chance once in 800,000 cells; a
 * cell of which both say that it is darker than its `least` is not compared alone, as it has few
 * photons. The sums over all cells, weighted by area, agree within 1 %, so that no error hides in
 * the noise.
 */
void ExpectAgreement(const Estimates& traced, const Estimates& filtered, int bands,
  const std::vector<double>& areas, const std::vector<double>& least)
{
  Spectrum sum = Spectrum::Zero(), filteredSum = Spectrum::Zero();
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    sum += traced.mean(i) * areas[i];
    filteredSum += filtered.mean(i) * areas[i];
    if (std::max(traced.mean(i).sum(), filtered.mean(i).sum()) < least[i])
    {
      continue;
    }
    const Spectrum error =
      (traced.standardError(i).square() + filtered.standardError(i).square()).sqrt();
    const Spectrum t = (traced.mean(i) - filtered.mean(i)).abs() / (error + 1e-300);
    EXPECT_LT(t.maxCoeff(), 6) << "cell " << i << ": " << traced.mean(i).transpose() << ", "
                               << filtered.mean(i).transpose() << " +- " << error.transpose();
  }
  for (int band = 0; band < bands; ++band)
  {
    EXPECT_NEAR(sum[band] / filteredSum[band], 1, 0.01);
  }
}

/// How the filter may find the light without bias.
struct Way
{
  const char* Name;
  std::function<void(vtkIrradianceFilter*)> Set;
};

const std::vector<Way>& UnbiasedWays()
{
  static const std::vector<Way> ways{
    { "shot", [](vtkIrradianceFilter* filter) { filter->SetMethodToWalks(); } },
    { "direct light gathered",
      [](vtkIrradianceFilter* filter) {
        filter->SetDirectLightToGathered();
        filter->SetCellEstimateToSums();
      } },
    { "all gathered, nothing read",
      [](vtkIrradianceFilter* filter) {
        filter->SetMethodToGatheredEverywhere();
        filter->SetNumberOfRays(4);
        filter->UnbiasedGatherOn();
      } },
  };
  return ways;
}

/// All that the final gather finds on all cells is what the tracer finds, within 2 %: rays take
/// cells for evenly lit.
void ExpectSmallBias(vtkIrradianceFilter* filter, const Estimates& traced,
  const std::vector<CellId>& cells, const std::vector<double>& areas)
{
  filter->UnbiasedGatherOff();
  filter->SetNumberOfRays(16);
  double found = 0, sum = 0;
  constexpr int seeds = 4;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    filter->SetSeed(seed);
    filter->Update();
    const auto all = ValuesOf(filter->GetOutput(), "Irradiance");
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      found += all[cells[i].object][cells[i].cell].sum() * areas[i] / seeds;
    }
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    sum += traced.mean(i).sum() * areas[i];
  }
  EXPECT_NEAR(found / sum, 1, 0.02);
}

void ExpectSameIrradiance(vtkIrradianceFilter* filter, std::uint32_t samples)
{
  const SceneObjects objects = ReadScene(filter);
  const std::vector<CellId> cells =
    CellsFrom(1e-12, objects); // without area there is no irradiance
  const std::vector<double> areas = AreasOf(objects, cells);
  SmpExecution execution([](double) { return true; });
  const Estimates traced = irradianceAt(objects, cells, {}, kSeeds, samples, execution);
  for (const Way& way : UnbiasedWays())
  {
    SCOPED_TRACE(way.Name);
    way.Set(filter);
    const Estimates filtered = FilteredEstimates(filter, filter, "Irradiance", cells);
    std::vector<double> least;
    for (const double area : areas)
    {
      least.push_back(100 * PowerOfOneWalk(filter) / area); // 100 photons
    }
    ExpectAgreement(traced, filtered, objects.staticObject.material->bands, areas, least);
  }
  ExpectSmallBias(filter, traced, cells, areas);
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
  ExpectSameIrradiance(filter, 16);
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
  ExpectSameIrradiance(filter, 8);
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
  ExpectSameIrradiance(filter, 128);
}

// Gloss and mirror, three bands: the room of the picture with a coarse teapot.
TEST(LightOnCells, OfTheGlossyRoomIsTheFilters)
{
  RoomScene scene;
  MakeRoomScene("room", 2, scene);
  scene.Light->SetNumberOfWalks(20000);
  ExpectSameIrradiance(scene.Light, 2);
}

// The room of the picture without its lamp and its mirror, in which vtkOutgoingRadianceFilter shows
// whole cells.
TEST(Radiance, OfTheGlossyRoomIsTheFilters)
{
  RoomScene scene;
  MakeRoomScene("room", 2, scene);
  scene.Light->SetNumberOfWalks(30000);
  scene.Light->SetCellEstimateToSums(); // those of rays have a bias of about a percent
  scene.Light->SeparateSidesOn();
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(scene.Light->GetOutputPort());
  radiance->SetCamera(scene.Camera);
  const SceneObjects objects = ReadScene(scene.Light);
  std::vector<CellId> cells = CellsFrom(0.02, objects);
  const auto isLampOrMirror = [&](const CellId& id) {
    const Material& material = *objects[id.object].material;
    return (material.isSpecular(id.cell) && material.lobeOf(id.cell).isMirror()) ||
      objects[id.object].hasExitance(id.cell);
  };
  cells.erase(std::remove_if(cells.begin(), cells.end(), isLampOrMirror), cells.end());
  SmpExecution execution([](double) { return true; });
  const Estimates traced = measure(objects,
    CellRadiance(objects, cells, Vector3(scene.Camera->GetPosition())), {}, kSeeds, 8, execution);
  // On a dark glossy cell few photons shine into the eye, and the error of few is not known.
  const std::vector<double> least(cells.size(), 0.2); // W/m2/sr; the mean of all is 0.23
  ExpectAgreement(traced, FilteredEstimates(scene.Light, radiance, "Radiance", cells), 3,
    AreasOf(objects, cells), least);
}

TEST(ReadScene, SaysWhatIsWrong)
{
  Mesh bad = MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1);
  SetCellValues(bad, "DiffuseReflectance", { 1.5 });
  vtkNew<vtkIrradianceFilter> filter;
  filter->AddInputDataObject(0, bad);
  EXPECT_THROW(ReadScene(filter), std::runtime_error);
}

TEST(CellPoints, RefusesACellWithoutArea)
{
  vtkNew<vtkIrradianceFilter> filter;
  filter->AddInputDataObject(0, MakePointLight({ 0, 0, 1 }, { 1 })); // a vertex is cell 0
  const SceneObjects objects = ReadScene(filter);
  EXPECT_THROW(CellPoints(objects, { { 0, 0 } }), std::invalid_argument);
}

namespace
{

/// A lamp of exitance pi, that is of radiance 1, which fills the upper right quarter of the
/// picture.
Estimates PictureOfALamp(int width, int height)
{
  vtkNew<vtkIrradianceFilter> filter;
  Mesh lamp = MakeRectangle({ 0, 1, 0 }, { 9, 0, 0 }, { 0, 0, 9 }, 1); // it shines to -y
  SetCellValues(lamp, "RadiantExitance", { M_PI, 0.5 * M_PI, 0 });
  SetCellValues(lamp, "DiffuseReflectance", { 0 });
  filter->AddInputDataObject(0, lamp);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 0);
  camera->SetFocalPoint(0, 1, 0);
  camera->SetViewUp(0, 0, 1);
  const CameraRays rays = MakeCameraRays(camera, width, height);
  BidirectionalTracer::Config config;
  config.isUsed = [](int s, int) { return s == 0; }; // what is seen directly has no noise
  const SceneObjects objects = ReadScene(filter);
  const BidirectionalTracer tracer(objects, rays, config);
  Execution serial;
  Estimates pixels(rays.numberOfBins());
  pixels.add(tracer.trace(1, 1, serial));
  pixels.add(tracer.trace(2, 1, serial));
  return pixels;
}

}

TEST(Film, ShowsWhatIsAboveAndToTheRightThere)
{
  const auto image = MakeImage(PictureOfALamp(6, 4), 6, 4, 3);
  const std::string file = testing::TempDir() + "PathTracedRoom.png";
  WritePicture(image, 2, file);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  for (int y = 0; y < 4; ++y)
  {
    for (int x = 0; x < 6; ++x)
    {
      const bool isLamp = x >= 3 && y >= 2;
      const double seen[3] = { isLamp ? 1.0 : 0.0, isLamp ? 0.5 : 0.0, 0 };
      const vtkIdType pixel = x + 6 * y;
      for (int band = 0; band < 3; ++band)
      {
        const auto of = [&](const char* array) {
          return image->GetPointData()->GetArray(array)->GetComponent(pixel, band);
        };
        EXPECT_NEAR(of("Radiance"), seen[band], 1e-12);
        EXPECT_NEAR(of("RadianceStandardError"), 0, 1e-12);
        const double tone = 1 - std::exp(-2 * seen[band]);
        const double expected = tone > 0 ? 255 * (1.055 * std::pow(tone, 1 / 2.4) - 0.055) : 0;
        EXPECT_NEAR(reader->GetOutput()->GetScalarComponentAsDouble(x, y, 0, band), expected, 0.5);
      }
    }
  }
}

TEST(Film, RefusesWhatItCannotDo)
{
  vtkNew<vtkCamera> camera;
  camera->ParallelProjectionOn();
  EXPECT_THROW(MakeCameraRays(camera, 4, 3), std::invalid_argument);
  const auto image = MakeImage(PictureOfALamp(1, 1), 1, 1, 1);
  EXPECT_THROW(WritePicture(image, 1, "/nowhere/picture.png"), std::runtime_error);
}

namespace
{

std::string ErrorOf(const std::vector<std::string>& words)
{
  try
  {
    ReadOptions(words);
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
  return "";
}

}

TEST(Options, TakesValuesAndSaysWhatIsWrong)
{
  const Options options = ReadOptions(
    { "--size", "320x200", "--samples", "7", "--traversal", "onetree", "--traversals" });
  EXPECT_EQ(options.Width, 320);
  EXPECT_EQ(options.Height, 200);
  EXPECT_EQ(options.Samples, 7);
  EXPECT_EQ(options.Traversal, TraversalMode::OneTree);
  EXPECT_TRUE(options.CompareTraversals);
  EXPECT_EQ(ErrorOf({}), "");
  EXPECT_EQ(ErrorOf({ "--wrong", "3" }), "--wrong: there is no such option");
  EXPECT_EQ(ErrorOf({ "--size", "320" }).substr(0, 7), "--size:");
  EXPECT_EQ(ErrorOf({ "--samples", "none" }).substr(0, 10), "--samples:");
  EXPECT_EQ(ErrorOf({ "--traversal", "both" }).substr(0, 12), "--traversal:");
  EXPECT_NE(ErrorOf({ "--samples" }), "");
}
