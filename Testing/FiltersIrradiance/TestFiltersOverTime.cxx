// SPDX-License-Identifier: BSD-3-Clause
// Each filter behind a part that moves: it has the part's times, and at any time, in any order, the
// values of a new pipeline.

#include "OutputBits.h"
#include "PartOverTime.h"
#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkRadiantExposureFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

constexpr vtkIdType Walks = 2000;
const std::vector<double> WalkerTimes{ 0, 0.5, 1.5, 2 };

Scene Room()
{
  return { { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
}

Vector PlaceAt(double time)
{
  return { 0.5 + time, 1.5, 1.5 };
}

vtkSmartPointer<PartOverTime> MakeWalker()
{
  return PartOverTime::Make(MakeBall(0.4, 8), WalkerTimes,
    [](vtkPolyData* part, double time) { MoveTo(part, PlaceAt(time)); });
}

vtkSmartPointer<vtkIrradianceFilter> MakeMovingScene(vtkAlgorithm* walker)
{
  auto filter = MakeFilter(Room(), Walks);
  filter->AddInputConnection(1, walker->GetOutputPort());
  return filter;
}

vtkSmartPointer<vtkIrradianceFilter> MakeSceneAt(double time)
{
  Scene scene = Room();
  scene.Moving.push_back(MakeMoving(MakeBall(0.4, 8), PlaceAt(time)));
  return MakeFilter(scene, Walks);
}

/// Two sensors on the floor, facing up, moved by `shift` along y.
Mesh MakeSensors(double shift)
{
  Mesh sensors = MakeRectangle({ 0.6, 1.2 + shift, 0 }, { 1.8, 0, 0 }, { 0, 0.5, 0 }, 1);
  vtkNew<vtkDoubleArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < sensors->GetNumberOfPoints(); ++i)
  {
    normals->InsertNextTuple3(0, 0, 1);
  }
  sensors->GetPointData()->SetNormals(normals);
  return sensors;
}

std::vector<double> StepsOf(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(port);
  auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  return info->Has(key) ? std::vector<double>(info->Get(key), info->Get(key) + info->Length(key))
                        : std::vector<double>();
}

std::vector<double> RangeOf(vtkAlgorithm* filter, int port = 0)
{
  filter->UpdateInformation();
  const double* range =
    filter->GetOutputInformation(port)->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  return range ? std::vector<double>{ range[0], range[1] } : std::vector<double>();
}

/// Visits times forwards, backwards and at random. `expected`: the bits of a new pipeline at a
/// time.
void ExpectFollowing(vtkAlgorithm* filter, const std::function<OutputBits()>& bits,
  const std::function<OutputBits(double)>& expected)
{
  std::vector<double> times{ 0, 0.5, 1, 2, 1.5, 0.25, 0.25, 2 };
  RandomNumbers random(5);
  for (int i = 0; i < 4; ++i)
  {
    times.push_back(random.Between(0, 2));
  }
  std::map<double, OutputBits> seen;
  for (const double time : times)
  {
    filter->UpdateTimeStep(time);
    ASSERT_TRUE(IsSame(bits(), expected(time))) << "time " << time;
    vtkInformation* info = filter->GetOutputDataObject(0)->GetInformation();
    EXPECT_TRUE(info->Has(vtkDataObject::DATA_TIME_STEP()));
    EXPECT_EQ(info->Get(vtkDataObject::DATA_TIME_STEP()), time);
    seen.emplace(time, bits());
  }
  EXPECT_FALSE(IsSame(seen.at(0), seen.at(1))) << "nothing moves";
}

OutputBits BitsOf(vtkIrradianceProbeFilter* probe)
{
  return OutputBits(vtkPolyData::SafeDownCast(probe->GetOutput()));
}

}

TEST(FiltersOverTime, ProbeFollowsItsSource)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  const Mesh sensors = MakeSensors(0);
  sensors->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), 7); // as if cut out of other data
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputData(sensors);
  probe->SetSourceConnection(filter->GetOutputPort());
  EXPECT_EQ(StepsOf(probe), WalkerTimes);
  EXPECT_EQ(RangeOf(probe), (std::vector<double>{ 0, 2 }));
  ExpectFollowing(
    probe, [&] { return BitsOf(probe); },
    [&](double time) {
      vtkNew<vtkIrradianceProbeFilter> fresh;
      fresh->SetInputData(sensors);
      fresh->SetSourceConnection(MakeSceneAt(time)->GetOutputPort());
      fresh->Update();
      return BitsOf(fresh);
    });
}

TEST(FiltersOverTime, ProbeFollowsItsSensorsToo)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  const auto sensors = PartOverTime::Make(MakeSensors(0), { -1, 0.5, 1 },
    [](vtkPolyData* part, double time) { part->ShallowCopy(MakeSensors(0.5 * time)); });
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputConnection(sensors->GetOutputPort());
  probe->SetSourceConnection(filter->GetOutputPort());
  EXPECT_EQ(StepsOf(probe), (std::vector<double>{ -1, 0, 0.5, 1, 1.5, 2 }));
  EXPECT_EQ(RangeOf(probe), (std::vector<double>{ -1, 2 }));
  ExpectFollowing(
    probe, [&] { return BitsOf(probe); },
    [&](double time) {
      vtkNew<vtkIrradianceProbeFilter> fresh;
      fresh->SetInputData(MakeSensors(0.5 * time));
      fresh->SetSourceConnection(MakeSceneAt(time)->GetOutputPort());
      fresh->Update();
      return BitsOf(fresh);
    });
}

TEST(FiltersOverTime, ProbeOfWhatStandsStillHasNoTimes)
{
  vtkNew<vtkIrradianceProbeFilter> probe;
  probe->SetInputData(MakeSensors(0));
  const auto walker = MakeWalker();
  const auto moving = MakeMovingScene(walker), still = MakeSceneAt(0);
  probe->SetSourceConnection(moving->GetOutputPort());
  EXPECT_EQ(StepsOf(probe), WalkerTimes);
  probe->SetSourceConnection(still->GetOutputPort());
  EXPECT_TRUE(StepsOf(probe).empty());
  EXPECT_TRUE(RangeOf(probe).empty());
}

TEST(FiltersOverTime, RadianceFollowsItsInput)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(filter->GetOutputPort());
  EXPECT_EQ(StepsOf(radiance), WalkerTimes);
  EXPECT_EQ(RangeOf(radiance), (std::vector<double>{ 0, 2 }));
  ExpectFollowing(
    radiance, [&] { return OutputBits(radiance->GetOutput()); },
    [](double time) {
      vtkNew<vtkOutgoingRadianceFilter> fresh;
      fresh->SetInputConnection(MakeSceneAt(time)->GetOutputPort());
      fresh->Update();
      return OutputBits(fresh->GetOutput());
    });
}

TEST(FiltersOverTime, PointIrradianceFollowsItsInput)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  vtkNew<vtkPointIrradianceFilter> points;
  points->SetInputConnection(filter->GetOutputPort());
  points->SetNumberOfRays(2);
  EXPECT_EQ(StepsOf(points), WalkerTimes);
  ExpectFollowing(
    points, [&] { return OutputBits(points->GetOutput()); },
    [](double time) {
      vtkNew<vtkPointIrradianceFilter> fresh;
      fresh->SetInputConnection(MakeSceneAt(time)->GetOutputPort());
      fresh->SetNumberOfRays(2);
      fresh->Update();
      return OutputBits(fresh->GetOutput());
    });
}

TEST(FiltersOverTime, WalksFollowTheInputs)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  filter->SetNumberOfOutputWalks(50);
  EXPECT_EQ(StepsOf(filter, 1), WalkerTimes);
  EXPECT_EQ(RangeOf(filter, 1), (std::vector<double>{ 0, 2 }));
  const auto bitsOf = [](vtkIrradianceFilter* of) {
    vtkNew<vtkPolyData> walks; // `Repaired` tells how the walks came about
    walks->ShallowCopy(of->GetWalksOutput());
    walks->GetCellData()->RemoveArray("Repaired");
    walks->GetPointData()->RemoveArray("Repaired");
    return OutputBits(walks);
  };
  ExpectFollowing(
    filter, [&] { return bitsOf(filter); },
    [&](double time) {
      const auto fresh = MakeSceneAt(time);
      fresh->SetNumberOfOutputWalks(50);
      fresh->Update();
      return bitsOf(fresh);
    });
}

// It visits times itself. Behind another filter, too, it takes the steps that come through.
TEST(FiltersOverTime, ExposureTakesTheTimesThroughOtherFilters)
{
  const auto walker = MakeWalker();
  const auto filter = MakeMovingScene(walker);
  vtkNew<vtkOutgoingRadianceFilter> radiance;
  radiance->SetInputConnection(filter->GetOutputPort());
  vtkNew<vtkRadiantExposureFilter> exposure;
  exposure->SetInputConnection(radiance->GetOutputPort());
  exposure->SetIntegrationModeToTimeSteps();
  exposure->Update();
  EXPECT_TRUE(StepsOf(exposure).empty());
  EXPECT_TRUE(RangeOf(exposure).empty());
  vtkDataArray* times =
    exposure->GetOutputDataObject(0)->GetFieldData()->GetArray("IntegrationTimes");
  ASSERT_EQ(times->GetNumberOfTuples(), 4);
  EXPECT_EQ(walker->Visits, WalkerTimes);
}
