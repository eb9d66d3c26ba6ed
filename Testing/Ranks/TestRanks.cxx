// SPDX-License-Identifier: BSD-3-Clause
// Under mpirun: filters of all processes together bring the bits of a filter alone, or each has one error.

#include "ErrorObserver.h"
#include "ExposureScenes.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include "vtkMPIController.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

vtkMPIController* Controller = nullptr;

bool AreSeveral()
{
  return Controller->GetNumberOfProcesses() > 1;
}

using Settings = std::function<void(vtkIrradianceFilter*)>;

/// Takes the processes' filter through frames, and compares it with a filter alone in each.
void ExpectBitsOfOne(const Settings& set)
{
  Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> together, alone;
  for (vtkIrradianceFilter* filter : { together.Get(), alone.Get() })
  {
    Connect(filter, scene);
    filter->SetNumberOfWalks(6000);
    set(filter);
  }
  together->SetController(Controller);
  vtkIdType invalid = 0;
  for (int frame = 0; frame < 4; ++frame)
  {
    scene.Moving[static_cast<std::size_t>(frame % 2)].Pose->Translate(0.1, 0.05, 0.02);
    together->Update();
    alone->Update();
    EXPECT_TRUE(IsSame(OutputBits(together), OutputBits(alone))) << "frame " << frame;
    EXPECT_FALSE(OutputBits(together).IsEmpty());
    invalid += together->GetNumberOfInvalidWalks();
  }
  EXPECT_GT(invalid, 0);
}

/// Updates, and expects one error.
std::string OneErrorOf(vtkIrradianceFilter* filter)
{
  const auto observer = ErrorObserver::Watch(filter);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(observer->Errors.size(), 1u);
  return observer->Errors.empty() ? "" : observer->Errors.front();
}

}

TEST(Ranks, BringTheBitsOfOne)
{
  ExpectBitsOfOne([](vtkIrradianceFilter*) {});
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) {
    filter->SetComputeStandardError(true);
    filter->SetSeparateSides(true);
    filter->SetCellEstimateToSpread();
  });
}

TEST(Ranks, ReachATargetTogether)
{
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) {
    filter->SetTargetRelativeError(0.5);
    filter->SetMaximumNumberOfWalks(30000);
  });
}

TEST(Ranks, AddUpADose)
{
  std::vector<OutputBits> bits;
  for (vtkMPIController* controller : { Controller, static_cast<vtkMPIController*>(nullptr) })
  {
    const ExposureScenes::WalkThrough scene(2000);
    scene.Irradiance->SetController(controller);
    const auto exposure = ExposureScenes::MakeExposure(scene.Irradiance);
    exposure->Update();
    bits.emplace_back(ExposureScenes::BlocksOf(exposure));
  }
  EXPECT_TRUE(IsSame(bits[0], bits[1]));
}

// What a budget leaves stale is repaired by all in the end.
TEST(Ranks, RepairWithinABudget)
{
  Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> together, alone;
  Connect(together, scene);
  Connect(alone, scene);
  together->SetController(Controller);
  together->Update();
  scene.Moving[0].Pose->Translate(0.3, 0, 0);
  together->SetRepairTimeBudget(1e-9);
  together->Update();
  EXPECT_GT(together->GetStalePower(), 0);
  together->SetRepairTimeBudget(0);
  together->Update();
  alone->Update();
  EXPECT_TRUE(IsSame(OutputBits(together), OutputBits(alone)));
}

TEST(Ranks, HaveOneErrorEachWhenOneFails)
{
  const bool isLast = Controller->GetLocalProcessId() == Controller->GetNumberOfProcesses() - 1;
  const Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> filter;
  Connect(filter, scene);
  filter->SetController(Controller);
  filter->SetDefaultDiffuseReflectance(isLast ? 2 : 0.5);
  const std::string error = OneErrorOf(filter);
  EXPECT_NE(error.find(isLast ? "DefaultDiffuseReflectance is 2" : "failed or was stopped"),
    std::string::npos)
    << error;
  // All begin again together.
  filter->SetDefaultDiffuseReflectance(0.5);
  const auto observer = ErrorObserver::Watch(filter);
  filter->Modified(); // on all, though only one has another setting
  filter->Update();
  EXPECT_TRUE(observer->Errors.empty());
  EXPECT_GT(filter->GetAbsorbedPower(), 0);
}

TEST(Ranks, HaveOneErrorEachWhenNotGivenTheSame)
{
  const bool isLast = Controller->GetLocalProcessId() == Controller->GetNumberOfProcesses() - 1;
  const bool areSeveral = AreSeveral();
  const Scene scene = MakeSmallScene();
  const auto expect = [&](vtkIrradianceFilter* filter, const std::string& text) {
    filter->SetController(Controller);
    if (areSeveral)
    {
      const std::string error = OneErrorOf(filter);
      EXPECT_NE(error.find(text), std::string::npos) << error;
    }
  };
  vtkNew<vtkIrradianceFilter> settings, places, none;
  Connect(settings, scene);
  settings->SetSeed(isLast ? 2 : 1);
  expect(settings, "other settings than on the first process on 1 of ");
  Connect(places, scene);
  scene.Moving[0].Pose->Translate(isLast ? 0.1 : 0.2, 0, 0);
  expect(places, "other inputs than on the first process on 1 of ");
  if (!isLast)
  {
    Connect(none, scene);
  }
  expect(none, "other inputs than on the first process on 1 of ");
}

TEST(Ranks, SayWhatNeedsAllPhotons)
{
  const Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> filter;
  Connect(filter, scene);
  filter->SetController(Controller);
  filter->SetNumberOfOutputWalks(10);
  if (AreSeveral())
  {
    EXPECT_NE(OneErrorOf(filter).find("need all photons in one process"), std::string::npos);
  }
  else
  {
    filter->Update();
    EXPECT_EQ(filter->GetWalksOutput()->GetNumberOfCells(), 10);
  }
}

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  vtkNew<vtkMPIController> controller;
  controller->Initialize(&argc, &argv);
  Controller = controller;
  const int result = RUN_ALL_TESTS();
  controller->Finalize();
  return result;
}
