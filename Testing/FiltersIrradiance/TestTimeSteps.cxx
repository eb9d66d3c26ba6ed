// SPDX-License-Identifier: BSD-3-Clause
// Times come from all inputs, and a requested time is passed to all of them.

#include "OutputBits.h"
#include "PartOverTime.h"
#include "TestScenes.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

using namespace TestScenes;

namespace
{

/// A mesh that, at time t, stands t metres along x from where it was, by ObjectToWorld.
vtkSmartPointer<PartOverTime> MakeWalker(const Mesh& model, const std::vector<double>& times)
{
  return PartOverTime::Make(model, times, [](vtkPolyData* part, double time) {
    MoveTo(part, { time, 0, 0 });
  });
}

}

TEST(TimeSteps, AreTheUnionOverAllInputs)
{
  const auto lampless = MakeWalker(MakeRoom(3, 1), { 0, 1 });
  const auto walker = MakeWalker(MakeBall(0.3, 6), { 0.5, 1, 2 });
  const auto runner = MakeWalker(MakeBox(0.3, 0.3, 0.3), { 0.25, 2.5 });
  auto filter = MakeFilter({ { MakeLamp({ 1.5, 1.5, 2.9 }, 0.5, { 100 }) }, {} }, 1000);
  filter->AddInputConnection(0, lampless->GetOutputPort());
  filter->AddInputConnection(1, walker->GetOutputPort());
  filter->AddInputConnection(1, runner->GetOutputPort());
  runner->TellsRange = false; // that of its steps
  EXPECT_EQ(StepsOf(filter), (std::vector<double>{ 0, 0.25, 0.5, 1, 2, 2.5 }));
  EXPECT_EQ(RangeOf(filter), (std::vector<double>{ 0, 2.5 }));
}

TEST(TimeSteps, ReachTheInputsAndTheOutput)
{
  const auto walker = MakeWalker(MakeBall(0.3, 6), { 0.5, 1, 2 });
  auto filter = MakeFilter(MakeEmptyRoom(), 1000);
  filter->AddInputConnection(1, walker->GetOutputPort());
  for (const double time : { 0.5, 1.0, 1.7, 0.5 }) // also one between the steps, also back
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(walker->Visits.back(), time);
    EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), time);

    Scene then = MakeEmptyRoom();
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
  std::vector<double> times;
  for (int i = 0; i < 12; ++i)
  {
    times.push_back(0.25 * i);
  }
  const auto walker = MakeWalker(MakeBall(0.3, 6), times);
  const auto runner = MakeWalker(MakeBox(0.4, 0.3, 0.5), times);
  auto filter = MakeFilter(MakeEmptyRoom(), 1000);
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
