// SPDX-License-Identifier: BSD-3-Clause
// Views of a scene: what travels through the pipeline, and when what executes.

#include "ErrorObserver.h"
#include "TestScenes.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkMath.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkTrivialProducer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace TestScenes;

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

/// Counts how often an algorithm executes.
class ExecutionCounter : public vtkCommand
{
public:
  static vtkSmartPointer<ExecutionCounter> Watch(vtkAlgorithm* algorithm)
  {
    auto counter = vtkSmartPointer<ExecutionCounter>::Take(new ExecutionCounter);
    algorithm->AddObserver(vtkCommand::EndEvent, counter);
    return counter;
  }
  void Execute(vtkObject*, unsigned long, void*) override { ++this->Count; }
  int Count = 0;
};

std::vector<vtkPolyData*> Leaves(vtkMultiBlockDataSet* data)
{
  std::vector<vtkPolyData*> leaves;
  const auto it = vtk::TakeSmartPointer(data->NewTreeIterator());
  it->VisitOnlyLeavesOn();
  for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
  {
    leaves.push_back(vtkPolyData::SafeDownCast(it->GetCurrentDataObject()));
  }
  return leaves;
}

std::vector<double> AllValues(vtkMultiBlockDataSet* data, const char* name)
{
  std::vector<double> values;
  for (vtkPolyData* leaf : Leaves(data))
  {
    vtkDataArray* array = leaf->GetCellData()->GetArray(name);
    for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
    {
      for (int band = 0; band < array->GetNumberOfComponents(); ++band)
      {
        values.push_back(array->GetComponent(i, band));
      }
    }
  }
  return values;
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
    ASSERT_EQ(this->Errors->Errors.size(), 1u);
    EXPECT_NE(this->Errors->Errors[0].find(words), std::string::npos) << this->Errors->Errors[0];
    EXPECT_EQ(this->Radiance->GetOutput()->GetNumberOfBlocks(), 0u);
  }
};

}

TEST(OutgoingRadianceFilter, DiffuseCellsHaveReflectedAndEmittedLight)
{
  Pipeline pipeline(MakeSmallScene());
  pipeline.Radiance->Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  for (vtkPolyData* leaf : Leaves(pipeline.Radiance->GetOutput()))
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
  EXPECT_TRUE(AllValues(pipeline.Radiance->GetOutput(), "RadianceStandardError").empty());
  pipeline.Irradiance->ComputeStandardErrorOn();
  pipeline.Radiance->Update();
  ASSERT_TRUE(pipeline.Errors->Errors.empty());
  int known = 0, glossy = 0;
  for (vtkPolyData* leaf : Leaves(pipeline.Radiance->GetOutput()))
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
  const auto irradiance = ExecutionCounter::Watch(pipeline.Irradiance);
  const auto radiance = ExecutionCounter::Watch(pipeline.Radiance);
  pipeline.Radiance->Update();
  const auto first = AllValues(pipeline.Radiance->GetOutput(), "Radiance");
  EXPECT_FALSE(first.empty());
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0.3, 1.2, 0.5);
  pipeline.Radiance->SetCamera(camera);
  pipeline.Radiance->Update();
  const auto second = AllValues(pipeline.Radiance->GetOutput(), "Radiance");
  EXPECT_NE(first, second);
  camera->SetPosition(1, 0.4, 0.7);
  pipeline.Radiance->Update();
  EXPECT_EQ(AllValues(pipeline.Radiance->GetOutput(), "Radiance"), first);
  pipeline.Radiance->Update();
  EXPECT_EQ(irradiance->Count, 1);
  EXPECT_EQ(radiance->Count, 3);
}

TEST(OutgoingRadianceFilter, AParallelCameraIsInfinitelyFarAway)
{
  Pipeline pipeline(MakeGlossyScene());
  pipeline.Radiance->SetEyePosition(1e9, 2e9, 2e9);
  pipeline.Radiance->Update();
  const auto far = AllValues(pipeline.Radiance->GetOutput(), "Radiance");
  vtkNew<vtkCamera> camera;
  camera->SetPosition(1, 2, 2);
  camera->SetFocalPoint(0, 0, 0);
  camera->ParallelProjectionOn();
  pipeline.Radiance->SetCamera(camera);
  pipeline.Radiance->Update();
  const auto parallel = AllValues(pipeline.Radiance->GetOutput(), "Radiance");
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
  const auto irradiance = ExecutionCounter::Watch(pipeline.Irradiance);
  pipeline.Irradiance->Update();
  pipeline.Radiance->Update();
  pipeline.Radiance->SetEyePosition(0.1, 0.1, 0.2);
  pipeline.Radiance->Update();
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
  EXPECT_EQ(Field(pipeline.Irradiance, "HistoryBytes"), 0);
  EXPECT_EQ(irradiance->Count, 1);
}

// Law 1 through the pipeline: a filter that updates gives the same views as a new one.
TEST(OutgoingRadianceFilter, ViewsOfAnUpdateEqualThoseOfANewFilter)
{
  Scene scene = MakeGlossyScene();
  Pipeline pipeline(scene);
  for (int frame = 0; frame < 6; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.02 * frame, 0.01, 0);
    pipeline.Radiance->Update();
    Pipeline fresh(scene);
    fresh.Radiance->Update();
    EXPECT_EQ(AllValues(pipeline.Radiance->GetOutput(), "Radiance"),
      AllValues(fresh.Radiance->GetOutput(), "Radiance"));
  }
}

TEST(OutgoingRadianceFilter, CopiesOutliveTheirFilter)
{
  vtkNew<vtkMultiBlockDataSet> shallow, deep;
  std::vector<double> expected;
  {
    Pipeline pipeline(MakeGlossyScene());
    pipeline.Radiance->Update();
    expected = AllValues(pipeline.Radiance->GetOutput(), "Radiance");
    shallow->ShallowCopy(pipeline.Irradiance->GetOutput());
    deep->DeepCopy(pipeline.Irradiance->GetOutput());
  }
  for (vtkMultiBlockDataSet* copy : { shallow.Get(), deep.Get() })
  {
    vtkNew<vtkOutgoingRadianceFilter> radiance;
    radiance->SetEyePosition(1, 0.4, 0.7);
    radiance->SetInputData(copy);
    radiance->Update();
    EXPECT_EQ(AllValues(radiance->GetOutput(), "Radiance"), expected);
  }
}

TEST(OutgoingRadianceFilter, BadInputIsNamed)
{
  {
    Pipeline pipeline(MakeGlossyScene());
    pipeline.Radiance->SetEyePosition(0, std::numeric_limits<double>::quiet_NaN(), 0);
    pipeline.ExpectError("eye is at (0, nan, 0)");
    pipeline.Radiance->SetEyePosition(0, 0, 0);
    pipeline.Errors->Clear();
    pipeline.Radiance->Update();
    EXPECT_TRUE(pipeline.Errors->Errors.empty());
  }
  {
    Pipeline pipeline(MakeGlossyScene());
    vtkNew<vtkMultiBlockDataSet> foreign;
    pipeline.Radiance->SetInputData(foreign);
    pipeline.ExpectError("no output of vtkIrradianceFilter");
  }
  {
    Scene scene = MakeGlossyScene();
    Pipeline pipeline(scene);
    pipeline.Irradiance->Update();
    vtkNew<vtkMultiBlockDataSet> old;
    old->ShallowCopy(pipeline.Irradiance->GetOutput());
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
    pipeline.Irradiance->Update();
    pipeline.Radiance->SetInputData(old);
    pipeline.ExpectError("out of date");
  }
  {
    Pipeline pipeline(MakeGlossyScene());
    pipeline.Irradiance->Update();
    vtkNew<vtkMultiBlockDataSet> part;
    part->ShallowCopy(pipeline.Irradiance->GetOutput());
    vtkMultiBlockDataSet::SafeDownCast(part->GetBlock(1))->RemoveBlock(0);
    pipeline.Radiance->SetInputData(part);
    pipeline.ExpectError("a part of an output");
  }
}

TEST(OutgoingRadianceFilter, AnAbortLeavesAnEmptyOutput)
{
  Pipeline pipeline(MakeGlossyScene());
  pipeline.Irradiance->Update();
  class Aborter : public vtkCommand // at the first progress
  {
  public:
    void Execute(vtkObject* caller, unsigned long, void*) override
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  };
  const auto aborter = vtkSmartPointer<Aborter>::Take(new Aborter);
  const auto tag = pipeline.Radiance->AddObserver(vtkCommand::ProgressEvent, aborter);
  pipeline.Radiance->Update();
  EXPECT_EQ(pipeline.Radiance->GetOutput()->GetNumberOfBlocks(), 0u);
  pipeline.Radiance->RemoveObserver(tag);
  pipeline.Radiance->SetAbortExecute(0);
  pipeline.Radiance->Modified();
  pipeline.Radiance->Update();
  EXPECT_EQ(pipeline.Radiance->GetOutput()->GetNumberOfBlocks(), 2u);
  EXPECT_TRUE(pipeline.Errors->Errors.empty());
}
