// SPDX-License-Identifier: BSD-3-Clause
// Each filter behind a part that moves: it has the part's times, and at any time, in any order, the
// values of a new pipeline.

#include "PartOverTime.h"
#include "ShownWalks.h"

#include "vtkInformation.h"
#include "vtkIrradianceProbeFilter.h"
#include "vtkOutgoingRadianceFilter.h"
#include "vtkPointIrradianceFilter.h"
#include "vtkRadiantExposureFilter.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

constexpr vtkIdType Walks = 2000;
const std::vector<double> WalkerTimes{ 0, 0.5, 1.5, 2 };

Vector PlaceAt(double time)
{
  return { 0.5 + time, 1.5, 1.5 };
}

vtkSmartPointer<PartOverTime> MakeWalker()
{
  return PartOverTime::Make(MakeBall(0.4, 8), WalkerTimes,
    [](vtkPolyData* part, double time) { MoveTo(part, PlaceAt(time)); });
}

vtkSmartPointer<vtkIrradianceFilter> MakeMovingScene(const vtkSmartPointer<PartOverTime>& walker)
{
  auto filter = MakeFilter(MakeEmptyRoom(), Walks);
  filter->AddInputConnection(1, walker->GetOutputPort());
  return filter;
}

vtkSmartPointer<vtkIrradianceFilter> MakeSceneAt(double time)
{
  Scene scene = MakeEmptyRoom();
  scene.Moving.push_back(MakeMoving(MakeBall(0.4, 8), PlaceAt(time)));
  return MakeFilter(scene, Walks);
}

/// Sensors on the floor, facing up, moved by `shift` along y.
Mesh MakeFloorSensors(double shift)
{
  Mesh sensors = MakeRectangle({ 0.6, 1.2 + shift, 0 }, { 1.8, 0, 0 }, { 0, 0.5, 0 }, 1);
  SetNormals(sensors, { { 0, 0, 1 } });
  return sensors;
}

/// Visits times forwards, backwards and at random. `makeAt`: a new pipeline at a time.
void ExpectFollowing(
  vtkAlgorithm* filter, const std::function<vtkSmartPointer<vtkAlgorithm>(double)>& makeAt,
  const std::function<OutputBits(vtkAlgorithm*)>& bits = [](vtkAlgorithm* of) {
    return OutputBits(of->GetOutputDataObject(0));
  })
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
    const auto fresh = makeAt(time);
    fresh->Update();
    ASSERT_TRUE(IsSame(bits(filter), bits(fresh))) << "time " << time;
    vtkInformation* info = filter->GetOutputDataObject(0)->GetInformation();
    EXPECT_TRUE(info->Has(vtkDataObject::DATA_TIME_STEP()));
    EXPECT_EQ(info->Get(vtkDataObject::DATA_TIME_STEP()), time);
    seen.emplace(time, bits(filter));
  }
  EXPECT_FALSE(IsSame(seen.at(0), seen.at(1))) << "nothing moves";
}

vtkSmartPointer<vtkIrradianceProbeFilter> MakeProbe(vtkIrradianceFilter* source)
{
  auto probe = vtkSmartPointer<vtkIrradianceProbeFilter>::New();
  probe->SetSourceConnection(source->GetOutputPort());
  return probe;
}

}

TEST(FiltersOverTime, ProbeFollowsItsSource)
{
  const Mesh sensors = MakeFloorSensors(0);
  sensors->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), 7); // as if cut out of other data
  const auto make = [&](vtkIrradianceFilter* source) {
    auto probe = MakeProbe(source);
    probe->SetInputData(sensors);
    return probe;
  };
  const auto probe = make(MakeMovingScene(MakeWalker()));
  EXPECT_EQ(StepsOf(probe), WalkerTimes);
  EXPECT_EQ(RangeOf(probe), (std::vector<double>{ 0, 2 }));
  ExpectFollowing(probe, [&](double time) { return make(MakeSceneAt(time)); });
}

TEST(FiltersOverTime, ProbeFollowsItsSensorsToo)
{
  const auto sensors = PartOverTime::Make(MakeFloorSensors(0), { -1, 0.5, 1 },
    [](vtkPolyData* part, double time) { part->ShallowCopy(MakeFloorSensors(0.5 * time)); });
  const auto probe = MakeProbe(MakeMovingScene(MakeWalker()));
  probe->SetInputConnection(sensors->GetOutputPort());
  EXPECT_EQ(StepsOf(probe), (std::vector<double>{ -1, 0, 0.5, 1, 1.5, 2 }));
  EXPECT_EQ(RangeOf(probe), (std::vector<double>{ -1, 2 }));
  ExpectFollowing(probe, [&](double time) {
    auto fresh = MakeProbe(MakeSceneAt(time));
    fresh->SetInputData(MakeFloorSensors(0.5 * time));
    return fresh;
  });
}

TEST(FiltersOverTime, ProbeOfWhatStandsStillHasNoTimes)
{
  const auto probe = MakeProbe(MakeMovingScene(MakeWalker()));
  probe->SetInputData(MakeFloorSensors(0));
  EXPECT_EQ(StepsOf(probe), WalkerTimes);
  probe->SetSourceConnection(MakeSceneAt(0)->GetOutputPort());
  EXPECT_TRUE(StepsOf(probe).empty());
  EXPECT_TRUE(RangeOf(probe).empty());
}

TEST(FiltersOverTime, RadianceFollowsItsInput)
{
  const auto make = [](vtkIrradianceFilter* source) {
    auto radiance = vtkSmartPointer<vtkOutgoingRadianceFilter>::New();
    radiance->SetInputConnection(source->GetOutputPort());
    return radiance;
  };
  const auto radiance = make(MakeMovingScene(MakeWalker()));
  EXPECT_EQ(StepsOf(radiance), WalkerTimes);
  EXPECT_EQ(RangeOf(radiance), (std::vector<double>{ 0, 2 }));
  ExpectFollowing(radiance, [&](double time) { return make(MakeSceneAt(time)); });
}

TEST(FiltersOverTime, PointIrradianceFollowsItsInput)
{
  const auto make = [](vtkIrradianceFilter* source) {
    auto points = vtkSmartPointer<vtkPointIrradianceFilter>::New();
    points->SetInputConnection(source->GetOutputPort());
    points->SetNumberOfRays(2);
    return points;
  };
  const auto points = make(MakeMovingScene(MakeWalker()));
  EXPECT_EQ(StepsOf(points), WalkerTimes);
  ExpectFollowing(points, [&](double time) { return make(MakeSceneAt(time)); });
}

TEST(FiltersOverTime, WalksFollowTheInputs)
{
  const auto withWalks = [](const vtkSmartPointer<vtkIrradianceFilter>& filter) {
    filter->SetNumberOfOutputWalks(50);
    return filter;
  };
  const auto filter = withWalks(MakeMovingScene(MakeWalker()));
  EXPECT_EQ(StepsOf(filter, 1), WalkerTimes);
  EXPECT_EQ(RangeOf(filter, 1), (std::vector<double>{ 0, 2 }));
  ExpectFollowing(
    filter, [&](double time) { return withWalks(MakeSceneAt(time)); },
    [](vtkAlgorithm* of) {
      return ShownWalks::LastingBits(vtkPolyData::SafeDownCast(of->GetOutputDataObject(1)));
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
  EXPECT_EQ(
    ValuesOf(exposure->GetOutputDataObject(0)->GetFieldData()->GetArray("IntegrationTimes")),
    WalkerTimes);
  EXPECT_EQ(walker->Visits, WalkerTimes);
}
