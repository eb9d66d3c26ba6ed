// SPDX-License-Identifier: BSD-3-Clause
// Times come from all inputs, and a requested time is passed to all of them.

#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// A mesh that, at time t, stands t metres along x from where it was, by ObjectToWorld.
class TimedSource : public vtkPolyDataAlgorithm
{
public:
  static TimedSource* New();
  vtkTypeMacro(TimedSource, vtkPolyDataAlgorithm);

  Mesh Model;
  std::vector<double> Times;
  double LastTime = -1;

protected:
  TimedSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    const double range[2] = { this->Times.front(), this->Times.back() };
    vtkInformation* info = output->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), this->Times.data(),
      static_cast<int>(this->Times.size()));
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* output) override
  {
    vtkInformation* info = output->GetInformationObject(0);
    auto* key = vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP();
    this->LastTime = info->Has(key) ? info->Get(key) : 0;
    vtkPolyData* polyData = vtkPolyData::GetData(output);
    polyData->ShallowCopy(this->Model);
    vtkNew<vtkDoubleArray> array;
    array->SetName("ObjectToWorld");
    for (int i = 0; i < 16; ++i)
    {
      array->InsertNextValue(i == 3 ? this->LastTime : (i % 5 == 0 ? 1 : 0));
    }
    polyData->GetFieldData()->AddArray(array);
    return 1;
  }
};

vtkStandardNewMacro(TimedSource);

}

TEST(TimeSteps, AreTheUnionOverAllInputs)
{
  vtkNew<TimedSource> lampless, walker, runner;
  lampless->Model = MakeRoom(3, 1);
  lampless->Times = { 0, 1 };
  walker->Model = MakeBall(0.3, 6);
  walker->Times = { 0.5, 1, 2 };
  runner->Model = MakeBox(0.3, 0.3, 0.3);
  runner->Times = { 0.25, 2.5 };
  auto filter = MakeFilter({ { MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} }, 1000);
  filter->AddInputConnection(0, lampless->GetOutputPort());
  filter->AddInputConnection(1, walker->GetOutputPort());
  filter->AddInputConnection(1, runner->GetOutputPort());
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  auto* stepsKey = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  const double* steps = info->Get(stepsKey);
  const std::vector<double> expected{ 0, 0.25, 0.5, 1, 2, 2.5 };
  EXPECT_EQ(std::vector<double>(steps, steps + info->Length(stepsKey)), expected);
  const double* range = info->Get(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  EXPECT_EQ(range[0], 0);
  EXPECT_EQ(range[1], 2.5);
}

TEST(TimeSteps, ReachTheInputsAndTheOutput)
{
  Scene scene{ { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
  vtkNew<TimedSource> walker;
  walker->Model = MakeBall(0.3, 6);
  walker->Times = { 0.5, 1, 2 };
  auto filter = MakeFilter(scene, 1000);
  filter->AddInputConnection(1, walker->GetOutputPort());
  for (const double time : { 0.5, 1.0, 1.7, 0.5 }) // also one between the steps, also back
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(walker->LastTime, time);
    EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);

    Scene then = scene;
    then.Moving.push_back(MakeMoving(walker->Model, { time, 0, 0 }));
    const auto fresh = MakeFilter(then, 1000);
    fresh->Update();
    EXPECT_TRUE(IsSame(OutputBits(filter), OutputBits(fresh))) << "time " << time;
  }
  EXPECT_EQ(Field(filter, "ShootSeconds"), 0);
}

// Times in random order: each has the bits that it had when it was first asked for.
TEST(TimeSteps, OutOfOrderHaveTheSameBits)
{
  Scene scene{ { MakeRoom(3, 2), MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} };
  vtkNew<TimedSource> walker, runner;
  walker->Model = MakeBall(0.3, 6);
  runner->Model = MakeBox(0.4, 0.3, 0.5);
  for (int i = 0; i < 12; ++i)
  {
    walker->Times.push_back(0.25 * i);
    runner->Times.push_back(0.25 * i);
  }
  auto filter = MakeFilter(scene, 1000);
  filter->AddInputConnection(1, walker->GetOutputPort());
  filter->AddInputConnection(1, runner->GetOutputPort());
  std::map<int, OutputBits> first;
  RandomNumbers random(3);
  for (int i = 0; i < 100; ++i)
  {
    const int step = random.Below(12);
    filter->UpdateTimeStep(0.25 * step);
    const auto known = first.emplace(step, OutputBits(filter)).first;
    ASSERT_TRUE(IsSame(OutputBits(filter), known->second)) << "step " << step << ", visit " << i;
  }
  EXPECT_EQ(first.size(), 12u);
}
