// SPDX-License-Identifier: BSD-3-Clause
// A run that is aborted continues with the same bits; one whose input changes starts again.

#include "ExposureScenes.h"

#include "vtkKeyFramedPose.h"

using namespace ExposureScenes;

TEST(RadiantExposure, ContinuesAfterAnAbort)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  const auto aborter = EventObserver::Watch(exposure);
  const auto abortedUpdate = [&] {
    aborter->AbortIn = 3; // the first event comes before anything is done
    exposure->Modified();
    exposure->Update();
    EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), 0u);
    exposure->SetAbortExecute(0);
  };
  abortedUpdate();
  EXPECT_EQ(scene.Ball->Visits.size(), 2u);
  abortedUpdate();
  EXPECT_EQ(scene.Ball->Visits.size(), 4u);
  exposure->Update();
  EXPECT_EQ(scene.Ball->Visits, kTimes) << "every time once";
  ExpectSumOverFresh(exposure, scene, kTimes);

  // What matters has changed, so all times are visited again.
  const auto expectAnew = [&](const std::vector<double>& times) {
    scene.Ball->Visits.clear();
    exposure->Update();
    EXPECT_EQ(scene.Ball->Visits, times);
    ExpectSumOverFresh(exposure, scene, times);
  };
  abortedUpdate();
  exposure->SetEndTime(1);
  expectAnew({ 0, 0.25, 0.5, 1 });
  exposure->SetEndTime(1.5);
  abortedUpdate();
  scene.Irradiance->SetSeed(3);
  scene.Irradiance->SetSeed(1);
  expectAnew(kTimes);
}

// The user aborts the long first shooting, or an update, where its progress is seen.
TEST(RadiantExposure, ContinuesAfterAnAbortUpstream)
{
  const WalkThrough scene(1000);
  const auto exposure = MakeExposure(scene.Irradiance);
  const auto observer = ErrorObserver::Watch(exposure);
  const auto starts = EventObserver::Watch(scene.Irradiance, vtkCommand::StartEvent);
  const auto aborter = EventObserver::Watch(scene.Irradiance);
  for (const int execution : { 1, 3, 0 })
  {
    starts->EventsToWait = execution - 1;
    starts->Change = [&] { aborter->AbortIn = 1; };
    exposure->Modified();
    exposure->Update();
    EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), execution == 0 ? 2u : 0u);
  }
  EXPECT_TRUE(observer->Errors.empty() && observer->Warnings.empty());
  ExpectSumOverFresh(exposure, scene, kTimes);
  EXPECT_EQ(starts->Count, static_cast<int>(kTimes.size()) + 2) << "two were aborted";
}

// Many a reader sets itself up when it is first asked; that is no change of the scene.
TEST(RadiantExposure, OfASourceThatModifiesItselfContinuesToo)
{
  const auto make = [] {
    auto irradiance = MakeFilter(MakeEmptyRoom(), 1000);
    vtkNew<vtkKeyFramedPose> way;
    way->SetInputDataObject(MakeBall(0.3, 6));
    for (int key = 0; key < 3; ++key)
    {
      way->AddPose(key, 0.6 + 0.5 * key, 1.2 + 0.1 * key * key, 1, 0, 0, 0);
    }
    EventObserver::Watch(way, vtkCommand::EndEvent)->Change = [source = way.Get()] {
      source->Modified();
    };
    irradiance->AddInputConnection(1, way->GetOutputPort());
    return irradiance;
  };
  const auto irradiance = make(), other = make();
  const auto exposure = MakeExposure(irradiance), whole = MakeExposure(other);
  const auto observer = ErrorObserver::Watch(exposure);
  const auto updates = EventObserver::Watch(irradiance, vtkCommand::EndEvent);
  for (vtkRadiantExposureFilter* filter : { exposure.Get(), whole.Get() })
  {
    filter->SetIntegrationModeToUniform();
    filter->SetNumberOfTimeSteps(5);
  }
  EventObserver::Watch(exposure)->AbortIn = 4;
  exposure->Update();
  EXPECT_EQ(BlocksOf(exposure)->GetNumberOfBlocks(), 0u);
  exposure->SetAbortExecute(0);
  exposure->Update();
  EXPECT_EQ(updates->Count, 6) << "every time once";
  whole->Update();
  EXPECT_TRUE(IsSame(OutputBits(BlocksOf(exposure)), OutputBits(BlocksOf(whole))));
  EXPECT_TRUE(observer->Warnings.empty() && observer->Errors.empty());
}

TEST(RadiantExposure, ReportsProgress)
{
  const auto square = MakeLitSquare({ 0, 1, 2, 3 }, [](double time) { return time; });
  const auto exposure = MakeExposure(square);
  const auto observer = EventObserver::Watch(exposure);
  exposure->Update();
  EXPECT_EQ(observer->Progress, (std::vector<double>{ 0, 0.25, 0.5, 0.75, 1 }));
}

// An observer changes the scene during the run: what was summed up is of no use.
TEST(RadiantExposure, StartsAgainIfSomethingChangesMeanwhile)
{
  const auto square = MakeLitSquare({ 0, 1, 2, 3 }, [](double time) { return time; });
  const auto exposure = MakeExposure(square);
  const auto observer = EventObserver::Watch(exposure);
  observer->EventsToWait = 2;
  observer->Change = [&] {
    square->Change = [](vtkPolyData* part, double) { SetCellValues(part, "Irradiance", { 10 }); };
    square->Modified();
  };
  exposure->Update();
  EXPECT_EQ(observer->Progress[2], 0.5);
  EXPECT_EQ(SquareExposure(exposure), 30);
}
