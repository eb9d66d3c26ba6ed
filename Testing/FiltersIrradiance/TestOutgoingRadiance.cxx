// SPDX-License-Identifier: BSD-3-Clause
// Views of a scene: what travels through the pipeline, and when what executes.

#include "ErrorObserver.h"
#include "EventObserver.h"
#include "OutputChecks.h"
#include "TestScenes.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkOutgoingRadianceFilter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace TestScenes;
using OutputChecks::LeavesOf;

namespace
{

constexpr vtkIdType NumberOfWalks = 2000;

Scene MakeGlossyScene()
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.4 });
  SetCellValues(scene.Fixed[0], "SpecularReflectance", { 0.3 });
  SetCellValues(scene.Fixed[0], "PhongExponent", { 10 });
  return scene;
}

std::vector<double> Radiances(vtkOutgoingRadianceFilter* filter, const char* name = "Radiance")
{
  std::vector<double> all;
  for (vtkPolyData* leaf : LeavesOf(filter->GetOutput()))
  {
    const std::vector<double> some = ValuesOf(leaf->GetCellData()->GetArray(name));
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

struct Pipeline
{
  vtkSmartPointer<vtkIrradianceFilter> Irradiance;
  vtkNew<vtkOutgoingRadianceFilter> Radiance;
  vtkSmartPointer<ErrorObserver> Errors = ErrorObserver::Watch(Radiance);

  explicit Pipeline(const Scene& scene)
    : Irradiance(MakeFilter(scene, NumberOfWalks))
  {
    this->Radiance->SetInputConnection(this->Irradiance->GetOutputPort());
    this->Radiance->SetEyePosition(1, 0.4, 0.7);
  }
  void ExpectError(const std::string& words)
  {
    this->Errors->Clear();
    this->Radiance->Update();
    ExpectOne(this->Errors->Errors, { words });
    EXPECT_EQ(this->Radiance->GetOutput()->GetNumberOfBlocks(), 0u);
  }
};

}

TEST(OutgoingRadianceFilter, DiffuseCellsHaveReflectedAndEmittedLight)
{
  Pipeline pipeline(MakeSmallScene());
  pipeline.Radiance->Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  for (vtkPolyData* leaf : LeavesOf(pipeline.Radiance->GetOutput()))
  {
    vtkCellData* cells = leaf->GetCellData();
    EXPECT_EQ(cells->GetScalars(), cells->GetArray("Radiance"));
    vtkDataArray* reflectance = cells->GetArray("DiffuseReflectance");
    vtkDataArray* exitance = cells->GetArray("RadiantExitance");
    for (vtkIdType i = 0; i < leaf->GetNumberOfCells(); ++i)
    {
      const double emitted = exitance ? exitance->GetComponent(i, 0) : 0;
      const double reflected = (reflectance ? reflectance->GetComponent(i, 0) : 0.5) *
        cells->GetArray("Irradiance")->GetComponent(i, 0);
      const double seen = cells->GetArray("Radiance")->GetComponent(i, 0) * vtkMath::Pi();
      // The eye sees lamps from the front or from behind.
      EXPECT_TRUE(std::abs(seen - emitted - reflected) <= 1e-12 * (1 + seen) ||
        std::abs(seen - reflected) <= 1e-12 * (1 + seen))
        << "cell " << i;
    }
  }
}

// Where nothing is specular, the radiance is a multiple of the irradiance, and so is its error.
TEST(OutgoingRadianceFilter, DiffuseCellsHaveTheErrorOfTheirIrradiance)
{
  Pipeline pipeline(MakeGlossyScene());
  pipeline.Radiance->Update();
  EXPECT_TRUE(Radiances(pipeline.Radiance, "RadianceStandardError").empty());
  pipeline.Irradiance->ComputeStandardErrorOn();
  pipeline.Radiance->Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  int known = 0, glossy = 0;
  for (vtkPolyData* leaf : LeavesOf(pipeline.Radiance->GetOutput()))
  {
    vtkCellData* cells = leaf->GetCellData();
    vtkDataArray* reflectance = cells->GetArray("DiffuseReflectance");
    for (vtkIdType i = 0; i < leaf->GetNumberOfCells(); ++i)
    {
      const double expected = (reflectance ? reflectance->GetComponent(i, 0) : 0.5) /
        vtkMath::Pi() * cells->GetArray("IrradianceStandardError")->GetComponent(i, 0);
      const double error = cells->GetArray("RadianceStandardError")->GetComponent(i, 0);
      if (cells->GetArray("SpecularReflectance"))
      {
        EXPECT_FALSE(error < expected) << "cell " << i;
        ++glossy;
      }
      else if (!std::isnan(expected))
      {
        EXPECT_NEAR(error, expected, 1e-12 * expected) << "cell " << i;
        ++known;
      }
    }
  }
  EXPECT_GT(known, 0);
  EXPECT_GT(glossy, 0);
}

TEST(OutgoingRadianceFilter, AMovedEyeExecutesThisFilterAlone)
{
  Pipeline pipeline(MakeGlossyScene());
  const auto irradiance = EventObserver::Watch(pipeline.Irradiance, vtkCommand::EndEvent);
  const auto radiance = EventObserver::Watch(pipeline.Radiance, vtkCommand::EndEvent);
  pipeline.Radiance->Update();
  const auto first = Radiances(pipeline.Radiance);
  EXPECT_FALSE(first.empty());
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.3, 1.2, 0.5);
  pipeline.Radiance->SetCamera(camera);
  pipeline.Radiance->Update();
  const auto second = Radiances(pipeline.Radiance);
  EXPECT_NE(first, second);
  camera->SetPosition(1, 0.4, 0.7);
  pipeline.Radiance->Update();
  EXPECT_EQ(Radiances(pipeline.Radiance), first);
  pipeline.Radiance->Update();
  EXPECT_EQ(irradiance->Count, 1);
  EXPECT_EQ(radiance->Count, 3);
}

TEST(OutgoingRadianceFilter, AParallelCameraIsInfinitelyFarAway)
{
  Pipeline pipeline(MakeGlossyScene());
  pipeline.Radiance->SetEyePosition(1e9, 2e9, 2e9);
  pipeline.Radiance->Update();
  const auto far = Radiances(pipeline.Radiance);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(1, 2, 2);
  camera->SetFocalPoint(0, 0, 0);
  camera->ParallelProjectionOn();
  pipeline.Radiance->SetCamera(camera);
  pipeline.Radiance->Update();
  const auto parallel = Radiances(pipeline.Radiance);
  ASSERT_EQ(far.size(), parallel.size());
  for (std::size_t i = 0; i < far.size(); ++i)
  {
    EXPECT_NEAR(far[i], parallel[i], 1e-6 * (1 + far[i]));
  }
}

// Nothing can move, so the walks were not stored, and no view needs them.
TEST(OutgoingRadianceFilter, AsksForNoPhotons)
{
  Scene scene = MakeGlossyScene();
  scene.Moving.clear();
  Pipeline pipeline(scene);
  const auto irradiance = EventObserver::Watch(pipeline.Irradiance, vtkCommand::EndEvent);
  pipeline.Irradiance->Update();
  pipeline.Radiance->Update();
  pipeline.Radiance->SetEyePosition(0.1, 0.1, 0.2);
  pipeline.Radiance->Update();
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
  EXPECT_EQ(Field(pipeline.Irradiance, "HistoryBytes"), 0);
  EXPECT_EQ(irradiance->Count, 1);
}

TEST(OutgoingRadianceFilter, CopiesOutliveTheirFilter)
{
  vtkNew<vtkMultiBlockDataSet> shallow, deep;
  std::vector<double> expected;
  {
    Pipeline pipeline(MakeGlossyScene());
    pipeline.Radiance->Update();
    expected = Radiances(pipeline.Radiance);
    shallow->ShallowCopy(pipeline.Irradiance->GetOutput());
    deep->DeepCopy(pipeline.Irradiance->GetOutput());
  }
  for (vtkMultiBlockDataSet* copy : { shallow.Get(), deep.Get() })
  {
    vtkNew<vtkOutgoingRadianceFilter> radiance;
    radiance->SetEyePosition(1, 0.4, 0.7);
    radiance->SetInputData(copy);
    radiance->Update();
    EXPECT_EQ(Radiances(radiance), expected);
  }
}

TEST(OutgoingRadianceFilter, BadInputIsNamed)
{
  const Scene scene = MakeGlossyScene();
  Pipeline pipeline(scene);
  pipeline.Radiance->SetEyePosition(0, std::numeric_limits<double>::quiet_NaN(), 0);
  pipeline.ExpectError("eye is at (0, nan, 0)");
  pipeline.Radiance->SetEyePosition(0, 0, 0);
  pipeline.Errors->Clear();
  pipeline.Radiance->Update();
  EXPECT_TRUE(pipeline.Errors->Errors.empty());

  vtkNew<vtkMultiBlockDataSet> foreign, old, part;
  pipeline.Radiance->SetInputData(foreign);
  pipeline.ExpectError("no output of vtkIrradianceFilter");
  old->ShallowCopy(pipeline.Irradiance->GetOutput());
  scene.Moving[0].Pose->Translate(0.1, 0, 0);
  pipeline.Irradiance->Update();
  pipeline.Radiance->SetInputData(old);
  pipeline.ExpectError("out of date");
  part->ShallowCopy(pipeline.Irradiance->GetOutput());
  vtkMultiBlockDataSet::SafeDownCast(part->GetBlock(1))->RemoveBlock(0);
  pipeline.Radiance->SetInputData(part);
  pipeline.ExpectError("a part of an output");
}

TEST(OutgoingRadianceFilter, AnAbortLeavesAnEmptyOutput)
{
  Pipeline pipeline(MakeGlossyScene());
  pipeline.Irradiance->Update();
  EventObserver::Watch(pipeline.Radiance)->AbortIn = 1;
  pipeline.Radiance->Update();
  EXPECT_EQ(pipeline.Radiance->GetOutput()->GetNumberOfBlocks(), 0u);
  pipeline.Radiance->SetAbortExecute(0);
  pipeline.Radiance->Modified();
  pipeline.Radiance->Update();
  EXPECT_EQ(pipeline.Radiance->GetOutput()->GetNumberOfBlocks(), 2u);
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
}
