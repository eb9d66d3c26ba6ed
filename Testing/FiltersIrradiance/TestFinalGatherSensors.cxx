// SPDX-License-Identifier: BSD-3-Clause
// vtkIrradianceProbeFilter with Estimate Gathered: sensors and volumes in the air, what the source
// has to keep, error bars, updates, messages.

#include "EventObserver.h"
#include "SensorPipeline.h"

#include "vtkImageData.h"
#include "vtkRTAnalyticSource.h"

#include <cstring>
#include <limits>
#include <sstream>

using namespace TestScenes;

namespace
{

/// A grid that fills a box, its outermost points on the walls.
vtkSmartPointer<vtkImageData> MakeVolume(double side, int pointsOfSide)
{
  auto volume = vtkSmartPointer<vtkImageData>::New();
  volume->SetDimensions(pointsOfSide, pointsOfSide, pointsOfSide);
  const double spacing = side / (pointsOfSide - 1);
  volume->SetSpacing(spacing, spacing, spacing);
  return volume;
}

/// On the floor and in the air, with normals.
Mesh MakePlanes()
{
  return Join({ MakeRectangle({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, 6),
    MakeRectangle({ 0.1, 0.1, 0.85 }, { 2.8, 0, 0 }, { 0, 2.8, 0 }, 6) });
}

Mesh WithNormals(const Mesh& mesh, const Vector& normal)
{
  Mesh with = Copy(mesh);
  SetNormals(with, { normal });
  return with;
}

bool HaveSameBits(const std::vector<double>& a, const std::vector<double>& b)
{
  return !a.empty() && a.size() == b.size() &&
    std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// E = 1 on every plane in it, 4 from all directions.
Scene MakeFurnace()
{
  Scene scene;
  scene.Fixed = { MakeRoom(3, 6) };
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.6 });
  SetCellValues(scene.Fixed[0], "RadiantExitance", { 0.4 });
  return scene;
}

}

// 125 points, of which 98 are on walls. Each is off by some 5 %, so the mean, of which part is in
// common, by much less than 2 %.
TEST(FinalGatherSensors, AVolumeGetsItsFluenceRate)
{
  const auto volume = MakeVolume(3, 5);
  SensorPipeline pipeline(MakeFurnace(), 50000, volume);
  pipeline.Probe->SetNumberOfRays(64);
  const std::vector<double> fluence = pipeline.Update("FluenceRate");
  EXPECT_TRUE(pipeline.Reports->Errors.empty() && pipeline.Reports->Warnings.empty());
  auto* output = vtkImageData::SafeDownCast(pipeline.Probe->GetOutput());
  ASSERT_TRUE(output) << "of the same type";
  EXPECT_EQ(output->GetDimensions()[1], 5);
  EXPECT_EQ(output->GetSpacing()[2], 0.75);
  EXPECT_STREQ(output->GetPointData()->GetScalars()->GetName(), "FluenceRate");
  EXPECT_EQ(pipeline.Array("Irradiance"), nullptr);
  EXPECT_EQ(pipeline.Array("NumberOfPhotons"), nullptr);
  ASSERT_EQ(fluence.size(), 125u);
  double mean = 0;
  for (const double value : fluence)
  {
    EXPECT_NEAR(value, 4, 1.2);
    mean += value / 125;
  }
  EXPECT_NEAR(mean, 4, 0.08);
}

// Sensors are numbered in the whole volume, whatever part of it is asked for.
TEST(FinalGatherSensors, AVolumeComesWhole)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-2, 2, -2, 2, 0, 3);
  SensorPipeline pipeline(MakeFurnace(), 1000, nullptr);
  pipeline.Probe->SetInputConnection(source->GetOutputPort());
  const int part[6] = { -2, 0, -1, 1, 1, 2 };
  pipeline.Probe->UpdateExtent(part);
  EXPECT_EQ(pipeline.Probe->GetOutput()->GetNumberOfPoints(), 100);
  pipeline.Probe->UpdatePiece(0, 3, 0);
  EXPECT_EQ(pipeline.Probe->GetOutput()->GetNumberOfPoints(), 100);
  ASSERT_TRUE(pipeline.Array("FluenceRate"));
  pipeline.Probe->UpdatePiece(1, 3, 0);
  EXPECT_EQ(pipeline.Probe->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(pipeline.Array("FluenceRate"));
  EXPECT_TRUE(pipeline.Reports->Errors.empty());
}

// Sums are enough, which a source has without keeping photons; Nearest reads these.
TEST(FinalGatherSensors, AskForNoMoreThanTheyNeed)
{
  const Scene scene{ MakeSmallScene().Fixed, {} };
  const Mesh planes = MakePlanes();
  SensorPipeline together(scene, 5000, planes), apart(scene, 5000, planes);
  apart.Irradiance->SeparateSidesOn();
  const std::vector<double> fluence = together.Update("FluenceRate");
  EXPECT_TRUE(HaveSameBits(apart.Update("FluenceRate"), fluence));
  EXPECT_EQ(together.Irradiance->GetFigure("HistoryBytes"), 0);
  vtkNew<vtkMultiBlockDataSet> copy;
  SensorPipeline given(scene, 5000, planes);
  given.Irradiance->Update();
  copy->ShallowCopy(given.Irradiance->GetOutput());
  given.Probe->SetSourceData(copy);
  EXPECT_TRUE(HaveSameBits(given.Update("FluenceRate"), fluence));
  given.Probe->SetEstimateToNearest();
  given.Probe->SetInputData(WithNormals(planes, { 0, 0, 1 }));
  given.ExpectError("without keeping the photons");
}

TEST(FinalGatherSensors, HaveStandardErrorsWhereTheSourceHas)
{
  SensorPipeline pipeline(MakeFurnace(), 10000, MakeVolume(3, 3));
  pipeline.Probe->Update();
  EXPECT_EQ(pipeline.Array("FluenceRateStandardError"), nullptr);
  pipeline.Irradiance->ComputeStandardErrorOn();
  const std::vector<double> errors = pipeline.Update("FluenceRateStandardError");
  ASSERT_EQ(errors.size(), 27u);
  double squares = 0;
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    ASSERT_GT(errors[i], 0);
    squares += std::pow(
      (pipeline.Array("FluenceRate")->GetComponent(static_cast<vtkIdType>(i), 0) - 4) / errors[i],
      2);
  }
  // The mean of squares of Student's t is 15 / 13, of which 27 scatter by .35 and what they have in
  // common; intervals may be up to twice too wide.
  EXPECT_LT(squares / 27, 4);
  EXPECT_GT(squares / 27, 0.1);
  pipeline.Probe->SetInputData(WithNormals(MakePlanes(), { 0, 0, 1 }));
  EXPECT_FALSE(pipeline.Update("IrradianceStandardError").empty());
}

// A ray leaves a sensor with no error if it finds no light: inside of a closed box none does.
TEST(FinalGatherSensors, SayHowManyErrorsAreUnknown)
{
  Scene scene = MakeFurnace();
  scene.Moving = { MakeMoving(MakeBox(1.1, 1.1, 1.1), { 1.5, 1.5, 1.5 }) };
  SensorPipeline pipeline(scene, 10000, MakeVolume(3, 4)); // 8 of 64 in the box
  const auto fields = [&] { return pipeline.Probe->GetOutput()->GetFieldData(); };
  pipeline.Probe->Update();
  EXPECT_EQ(fields()->GetArray("NumberOfUnknownErrors"), nullptr);
  pipeline.Irradiance->ComputeStandardErrorOn();
  const std::vector<double> errors = pipeline.Update("FluenceRateStandardError");
  EXPECT_EQ(std::count_if(errors.begin(), errors.end(), [](double e) { return std::isnan(e); }), 8);
  ASSERT_NE(fields()->GetArray("NumberOfUnknownErrors"), nullptr);
  EXPECT_EQ(fields()->GetArray("NumberOfUnknownErrors")->GetComponent(0, 0), 8);
}

// Irradiance in a beam from a point light is that of the formula, and where it goes the other way
// nothing.
TEST(FinalGatherSensors, SayWhatCannotBeMeasured)
{
  Scene scene;
  scene.Fixed = { MakeRoom(1, 1), MakePointLight({ 0.5, 0.5, 0.5 }, { 10 }) };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh sensors = MakeRectangle({ 0.2, 0.2, 0.2 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, 1);
  SensorPipeline pipeline(scene, 1000, sensors);
  pipeline.Probe->Update();
  EXPECT_TRUE(pipeline.Reports->Errors.empty());
  sensors = Copy(sensors);
  sensors->GetPoints()->SetPoint(1, 3e6, 0, 0);
  pipeline.Probe->SetInputData(sensors);
  EXPECT_TRUE(std::isnan(pipeline.Update("FluenceRate")[1]));
  ExpectOne(pipeline.Reports->Warnings,
    { "1 of 4 sensors lie farther than a million sizes of the scene from it" });
  sensors = Copy(sensors);
  sensors->GetPoints()->SetPoint(2, 0, nan, 0);
  pipeline.Probe->SetInputData(sensors);
  pipeline.ExpectError("point 2: the position (0, nan, 0) is not finite");
  pipeline.Probe->SetEstimateToNearest();
  pipeline.Probe->SetInputData(MakeVolume(1, 2));
  pipeline.ExpectError("no point normals");
  std::ostringstream text;
  pipeline.Probe->Print(text);
  EXPECT_NE(text.str().find("Estimate: 0\n"), std::string::npos);
  EXPECT_NE(text.str().find("NumberOfRays: 16\n"), std::string::npos);
}

// Of sensors that move some gather anew, and find what a new filter finds; those that stay keep
// their bits. Progress tells: where all stay there is nothing to do.
TEST(FinalGatherSensors, ThoseThatStayKeepWhatTheyFound)
{
  const Scene scene = MakeSmallScene();
  Mesh sensors = WithNormals(MakePlanes(), { 0, 0, 1 });
  SensorPipeline pipeline(scene, 3000, sensors);
  const std::vector<double> first = pipeline.Update("Irradiance");
  const auto reports = EventObserver::Watch(pipeline.Probe);
  pipeline.Probe->Modified();
  EXPECT_TRUE(HaveSameBits(pipeline.Update("Irradiance"), first));
  EXPECT_EQ(std::exchange(reports->Count, 0), 2) << "the executive's own, at the begin and the end";
  for (int frame = 0; frame < 4; ++frame)
  {
    sensors = Copy(sensors);
    for (const vtkIdType moved : { 3, 40, 41 })
    {
      double place[3];
      sensors->GetPoint(moved, place);
      sensors->GetPoints()->SetPoint(moved, place[0] + 0.1, place[1], place[2] + 0.01);
    }
    sensors = frame == 1 ? Join({ sensors, sensors }) : sensors;
    frame == 2 ? pipeline.Probe->SetNumberOfRays(17) : void();
    frame == 3 ? scene.Moving[0].Pose->Translate(0.1, 0, 0) : void();
    pipeline.Probe->SetInputData(sensors);
    SensorPipeline fresh(scene, 3000, sensors);
    fresh.Probe->SetNumberOfRays(pipeline.Probe->GetNumberOfRays());
    EXPECT_TRUE(HaveSameBits(pipeline.Update("Irradiance"), fresh.Update("Irradiance"))) << frame;
    EXPECT_GT(std::exchange(reports->Count, 0), 2);
  }
}

// What is half done is not left behind, and the next update is whole.
TEST(FinalGatherSensors, CanBeAborted)
{
  SensorPipeline pipeline(MakeFurnace(), 1000, MakeVolume(3, 7));
  const auto aborter = EventObserver::Watch(pipeline.Probe);
  aborter->AbortFrom = 0.25;
  pipeline.Probe->Update();
  EXPECT_EQ(pipeline.Probe->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_TRUE(pipeline.Reports->Errors.empty());
  aborter->AbortFrom = 2;
  pipeline.Probe->SetAbortExecute(0);
  EXPECT_EQ(pipeline.Update("FluenceRate").size(), 7u * 7 * 7);
}
