// SPDX-License-Identifier: BSD-3-Clause
// Two outputs come from one execution, whoever asks for which, when, and for which time.

#include "ErrorObserver.h"
#include "EventObserver.h"
#include "ShownWalks.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkKeyFramedPose.h"
#include "vtkPhotonWalksFilter.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTubeFilter.h"

#include <gtest/gtest.h>

using namespace ShownWalks;

namespace
{

vtkSmartPointer<vtkIrradianceFilter> MakeOldShowing(const Scene& scene, vtkIdType shown)
{
  auto filter = MakeFilter(scene, NumberOfWalks);
  filter->SetNumberOfOutputWalks(shown);
  return filter;
}

/// At time t, 0 to 2, it is at x = 0.5 + t.
vtkSmartPointer<vtkKeyFramedPose> MakeRide()
{
  auto ride = vtkSmartPointer<vtkKeyFramedPose>::New();
  ride->SetInputDataObject(MakeBall(0.3, 6));
  for (const double time : { 0, 2 })
  {
    ride->AddPose(time, 0.5 + time, 1.5, 1, 0, 0, 0);
  }
  return ride;
}

void UpdateTimeStep(vtkAlgorithm* filter, int port, double time)
{
  vtkNew<vtkInformation> request;
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), time);
  vtkNew<vtkInformationVector> requests;
  requests->SetInformationObject(port, request);
  filter->Update(port, requests);
}

/// Of both ports; nothing is computed for it.
void ExpectSameAsNew(vtkIrradianceFilter* filter, const Scene& scene)
{
  const auto fresh = MakeOldShowing(scene, 50);
  fresh->Update();
  EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh)));
  EXPECT_TRUE(IsSame(LastingBits(filter->GetWalksOutput()), LastingBits(fresh->GetWalksOutput())));
}

}

TEST(OutputPorts, HaveTheirTypes)
{
  const auto filter = MakeOldShowing(MakeSmallScene(), 50);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfOutputPorts(), 2);
  EXPECT_TRUE(filter->GetOutputDataObject(0)->IsA("vtkMultiBlockDataSet"));
  EXPECT_EQ(filter->GetOutput(), filter->GetOutputDataObject(0));
  EXPECT_EQ(filter->GetOutput(0), filter->GetOutputDataObject(0));
  EXPECT_STREQ(filter->GetOutputDataObject(1)->GetClassName(), "vtkPolyData");
  EXPECT_EQ(filter->GetWalksOutput(), filter->GetOutputDataObject(1));
  EXPECT_EQ(filter->GetWalksOutputPort(), filter->GetOutputPort(1));
  EXPECT_EQ(filter->GetOutput(1), nullptr);
}

TEST(OutputPorts, ComeFromOneExecution)
{
  const Scene scene = MakeSmallScene();
  for (const int first : { 0, 1 })
  {
    SCOPED_TRACE(first);
    const auto filter = MakeOldShowing(scene, 50);
    const auto executions = EventObserver::Watch(filter, vtkCommand::StartEvent);
    filter->Update(first);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 2u);
    EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 50);
    filter->Update(1 - first);
    filter->Update(first);
    EXPECT_EQ(executions->Count, 1);
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
    filter->Update(first);
    ExpectSameAsNew(filter, scene);
    filter->Update(1 - first);
    EXPECT_EQ(executions->Count, 2);
  }
}

// Photons are asked of port 0 alone; port 1 must neither forget them nor ask for the light again.
TEST(OutputPorts, ServeThoseWhoNeedPhotonsAndThoseWhoDrawWalks)
{
  Scene scene = MakeSmallScene();
  scene.Moving.clear(); // no walk is stored unless somebody asks
  for (const vtkIdType shown : { 0, 50 })
  {
    SCOPED_TRACE(shown);
    const auto filter = MakeFilter(scene, NumberOfWalks);
    filter->SetNumberOfOutputWalks(shown);
    const auto executions = EventObserver::Watch(filter, vtkCommand::StartEvent);
    vtkNew<vtkPhotonWalksFilter> walks;
    walks->SetInputConnection(filter->GetOutputPort());
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputConnection(filter->GetWalksOutputPort());
    const auto reports = ErrorObserver::Watch(walks);
    tubes->Update();
    walks->Update();
    const int count = executions->Count;
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, shown == 0) << "walks to look at are stored";
    for (int i = 0; i < 3; ++i)
    {
      tubes->Update();
      walks->Update();
    }
    EXPECT_EQ(executions->Count, count);
    EXPECT_TRUE(reports->Errors.empty());
    EXPECT_EQ(tubes->GetOutput()->GetNumberOfCells() > 0, shown > 0);
    filter->Modified();
    tubes->Update();
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
    walks->Update();
    EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
    EXPECT_TRUE(reports->Errors.empty());
  }
}

TEST(OutputPorts, AreOfTheSameTime)
{
  Scene scene = MakeSmallScene();
  scene.Moving.clear();
  const auto filter = MakeOldShowing(scene, 50);
  filter->AddInputConnection(1, MakeRide()->GetOutputPort());
  for (const int port : { 0, 1 })
  {
    EXPECT_EQ(RangeOf(filter, port), (std::vector<double>{ 0, 2 }));
  }
  RandomNumbers random(5);
  for (int i = 0; i < 20; ++i)
  {
    const int port = random.Below(2);
    const double time = random.Below(3);
    SCOPED_TRACE(
      std::to_string(i) + ": port " + std::to_string(port) + ", " + std::to_string(time));
    UpdateTimeStep(filter, port, time);
    EXPECT_NEAR(OutputOf(filter->GetOutput(), 1, 0)->GetCenter()[0], 0.5 + time, 1e-6);
    for (const int each : { 0, 1 })
    {
      EXPECT_EQ(
        filter->GetOutputDataObject(each)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()),
        time);
    }
    const auto fresh = MakeOldShowing(scene, 50);
    fresh->AddInputConnection(1, MakeRide()->GetOutputPort());
    UpdateTimeStep(fresh, 0, time);
    EXPECT_TRUE(
      IsSame(LastingBits(filter->GetWalksOutput()), LastingBits(fresh->GetWalksOutput())));
  }
}

TEST(OutputPorts, AreEmptyAfterAnAbort)
{
  for (const int port : { 0, 1 })
  {
    const Scene scene = MakeSmallScene();
    const auto filter = MakeOldShowing(scene, 50);
    filter->Update();
    const auto progress = EventObserver::Watch(filter, vtkCommand::ProgressEvent);
    progress->Change = [&] { filter->SetAbortExecute(1); };
    scene.Moving[0].Pose->Translate(0.1, 0, 0);
    filter->Update(port);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfBlocks(), 0u);
    EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 0);
    EXPECT_EQ(filter->GetWalksOutput()->GetCellData()->GetNumberOfArrays(), 0);
    filter->SetAbortExecute(0);
    filter->Update(port);
    ExpectSameAsNew(filter, scene);
  }
}

TEST(OutputPorts, SeeWhatChangedWhileTheyWereMade)
{
  for (const int port : { 0, 1 })
  {
    const Scene scene = MakeSmallScene();
    const auto filter = MakeOldShowing(scene, 50);
    const auto meddler = EventObserver::Watch(filter, vtkCommand::ProgressEvent);
    meddler->Change = [&] { scene.Moving[0].Pose->Translate(0.1, 0, 0); };
    filter->Update(port);
    filter->Update(1 - port); // sees it
    ExpectSameAsNew(filter, scene);
    const auto executions = EventObserver::Watch(filter, vtkCommand::StartEvent);
    filter->Update(port);
    EXPECT_EQ(executions->Count, 0);
  }
}

TEST(OutputPorts, AreEmptyWithoutInputs)
{
  vtkNew<vtkIrradianceFilter> filter;
  filter->SetNumberOfOutputWalks(10);
  const auto reports = ErrorObserver::Watch(filter);
  filter->Update();
  filter->Update(1);
  EXPECT_TRUE(reports->Errors.empty());
  EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 0);
}
