// SPDX-License-Identifier: BSD-3-Clause
// Under mpirun: filters of all processes together bring the bits of a filter alone, or each has one
// error.

#include "ErrorObserver.h"
#include "ExposureScenes.h"
#include "OutputBits.h"
#include "Processes.h"
#include "RandomLights.h"
#include "TestScenes.h"

#include "vtkPhotonWalksFilter.h"
#include "vtkPointIrradianceFilter.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;
using Processes::Controller;

namespace
{

bool AreSeveral()
{
  return Controller->GetNumberOfProcesses() > 1;
}

using Settings = std::function<void(vtkIrradianceFilter*)>;

/// Takes the processes' filter through frames, and compares it with a filter alone in each.
void ExpectBitsOfOne(const Settings& set, const Scene& scene = MakeSmallScene())
{
  const auto together = MakeFilter(scene, 6000), alone = MakeFilter(scene, 6000);
  set(together);
  set(alone);
  together->SetController(Controller);
  alone->SetController(nullptr);
  double invalid = 0;
  for (int frame = 0; frame < 4; ++frame)
  {
    scene.Moving[static_cast<std::size_t>(frame % 2)].Pose->Translate(0.1, 0.05, 0.02);
    EXPECT_TRUE(UpdatesLike(together, alone)) << "frame " << frame;
    EXPECT_FALSE(OutputBits(together).IsEmpty());
    invalid += together->GetFigure("NumberOfInvalidWalks");
  }
  EXPECT_GT(invalid, 0);
}

/// Updates, and expects one error.
void ExpectOneError(vtkIrradianceFilter* filter, const std::string& words)
{
  filter->Modified();
  ExpectOne(Update(filter).Errors, { words });
}

}

TEST(Ranks, BringTheBitsOfOne)
{
  ExpectBitsOfOne([](vtkIrradianceFilter*) {});
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) {
    filter->SetMethodToAutomatic();
    filter->SetNumberOfWalks(11000); // enough for rays
  });
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) {
    filter->SetComputeStandardError(true);
    filter->SetSeparateSides(true);
    filter->SetMethodToSpreadWalks();
  });
}

// Each process gathers all direct light, and adds that of its own cells; it shoots its part of the
// walks.
TEST(Ranks, GatherTheLightOfOne)
{
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) { filter->SetDirectLightToGathered(); });
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) {
    filter->SetDirectLightToGathered();
    filter->SetNumberOfWalks(20000);
    filter->SetComputeStandardError(true);
    filter->SetSeparateSides(true);
  });
}

// All processes read the tables, and shoot from lamps and sky, or look for them.
TEST(Ranks, BringTheLightOfLampsWithTablesAndOfASky)
{
  Scene scene = MakeSmallScene();
  RandomNumbers random(20261128);
  scene.Fixed[0] = MakeRectangle({ -2, -2, 0 }, { 7, 0, 0 }, { 0, 7, 0 }, 3);
  scene.Fixed.push_back(Placed(MakeBox(0.5, 0.25, 0.125), 1, { 1, 1, 2.5 }));
  scene.Moving.push_back(MakeMoving(MakeBox(0.25, 0.25, 0.25), { 2, 2, 2 }));
  for (const Mesh& lamp : { scene.Fixed.back(), scene.Moving.back().Model })
  {
    RandomModels::SetRandomTable(random, lamp, false);
    SetFieldTuple(lamp, "Flux", { 20, 10, 5 });
  }
  vtkNew<vtkSunSkySource> sky;
  sky->SetDirectNormalIrradiance(500);
  sky->SetBounds(-2, 5, -2, 5, 0, 5);
  sky->Update();
  scene.Fixed.push_back(sky->GetOutput());
  ExpectBitsOfOne([](vtkIrradianceFilter*) {}, scene);
  ExpectBitsOfOne([](vtkIrradianceFilter* filter) { filter->SetMethodToGathered(); }, scene);
}

// Each finds what changed in its own part of the walks.
TEST(Ranks, FollowChangesOfAllKinds)
{
  const Scene scene = MakeSmallScene();
  const auto together = MakeFilter(scene, 6000), alone = MakeFilter(scene, 6000);
  together->SetController(Controller);
  alone->SetController(nullptr);
  const Mesh corner = MakeBox(0.8, 0.9, 1.1);
  const auto forBoth = [&](const auto& change) {
    change(together.Get());
    change(alone.Get());
  };
  const auto expectUpdate = [&](const char* what, bool shoots) {
    EXPECT_TRUE(UpdatesLike(together, alone)) << what;
    EXPECT_EQ(together->GetFigure("ShootSeconds") > 0, shoots) << what;
  };
  expectUpdate("first", true);
  SetCellValues(scene.Fixed[0], "DiffuseReflectance", { 0.6 });
  expectUpdate("walls are painted", false);
  forBoth([](vtkIrradianceFilter* filter) { filter->SetNumberOfWalks(9000); });
  scene.Moving[0].Pose->Translate(0.3, 0, 0);
  expectUpdate("more walks, and motion", true);
  forBoth([&](vtkIrradianceFilter* filter) { filter->AddInputDataObject(0, corner); });
  expectUpdate("a static part comes", false);
  forBoth([&](vtkIrradianceFilter* filter) {
    filter->RemoveInputConnection(0, 2);
    filter->AddInputDataObject(1, corner);
  });
  expectUpdate("it may move", false);
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
  const Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> together, alone;
  Connect(together, scene);
  Connect(alone, scene);
  together->SetController(Controller);
  together->Update();
  scene.Moving[0].Pose->Translate(0.3, 0, 0);
  together->SetRepairTimeBudget(1e-9);
  together->Update();
  EXPECT_GT(together->GetFigure("StalePower"), 0);
  together->SetRepairTimeBudget(0);
  EXPECT_TRUE(UpdatesLike(together, alone));
}

TEST(Ranks, HaveOneErrorEachWhenOneFails)
{
  const bool isLast = Processes::IsLast();
  const Scene scene = MakeSmallScene();
  vtkNew<vtkIrradianceFilter> filter;
  Connect(filter, scene);
  filter->SetController(Controller);
  filter->SetDefaultDiffuseReflectance(isLast ? 2 : 0.5);
  ExpectOneError(filter, isLast ? "DefaultDiffuseReflectance is 2" : "failed or was stopped");
  // All begin again together.
  filter->SetDefaultDiffuseReflectance(0.5);
  filter->Modified(); // on all, though only one has another setting
  EXPECT_TRUE(Update(filter).Errors.empty());
  EXPECT_GT(filter->GetFigure("AbsorbedPower"), 0);
}

TEST(Ranks, HaveOneErrorEachWhenNotGivenTheSame)
{
  const bool isLast = Processes::IsLast();
  const Scene scene = MakeSmallScene();
  const auto expect = [&](vtkIrradianceFilter* filter, const std::string& text) {
    filter->SetController(Controller);
    if (AreSeveral())
    {
      ExpectOneError(filter, text);
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

TEST(Ranks, ShowTheWalksOfOne)
{
  const Scene scene = MakeSmallScene();
  const auto together = MakeDefaultFilter(scene, 6000), alone = MakeDefaultFilter(scene, 6000);
  together->SetController(Controller);
  alone->SetController(nullptr);
  for (const vtkIdType cell : { -1, 4 })
  {
    for (const auto& filter : { together, alone })
    {
      filter->SetNumberOfOutputWalks(300);
      filter->SetOutputWalksCell(cell);
    }
    scene.Moving[0].Pose->Translate(0.1, 0.05, 0.02);
    together->Update();
    alone->Update();
    EXPECT_GT(together->GetWalksOutput()->GetNumberOfCells(), 100);
    EXPECT_TRUE(
      IsSame(OutputBits(together->GetWalksOutput()), OutputBits(alone->GetWalksOutput())));
  }
}

// Each process has the light at all points.
TEST(Ranks, HaveTheSameLightAtPoints)
{
  Scene scene = MakeSmallScene();
  const auto together = MakeFilter(scene, 6000), alone = MakeFilter(scene, 6000);
  together->SetController(Controller);
  alone->SetController(nullptr);
  vtkNew<vtkPointIrradianceFilter> ofAll, ofOne;
  ofAll->SetInputConnection(together->GetOutputPort());
  ofOne->SetInputConnection(alone->GetOutputPort());
  for (int frame = 0; frame < 2; ++frame)
  {
    scene.Moving[0].Pose->Translate(0.1, 0.05, 0.02);
    for (vtkPointIrradianceFilter* points : { ofAll.Get(), ofOne.Get() })
    {
      points->SetNumberOfRays(4);
      points->Update();
    }
    EXPECT_TRUE(IsSame(OutputBits(ofAll->GetOutput()), OutputBits(ofOne->GetOutput())));
  }
}

// Each process would repair other walks, and then show other photons.
TEST(Ranks, RefuseABudgetWherePhotonsAreRead)
{
  const auto filter = MakeFilter(MakeSmallScene(), 6000);
  filter->SetController(Controller);
  filter->SetRepairTimeBudget(1);
  vtkNew<vtkPhotonWalksFilter> walks;
  walks->SetInputConnection(filter->GetOutputPort());
  const auto observer = ErrorObserver::Watch(filter);
  walks->Update();
  ASSERT_EQ(observer->Errors.size(), AreSeveral() ? 1u : 0u);
  if (AreSeveral())
  {
    ExpectWords(observer->Errors[0], { "RepairTimeBudget is 1, but there are " });
  }
}

// VTK does not call a filter whose input fails; the others must hear of it.
TEST(Ranks, EndWhenTheInputOfOneFails)
{
  const auto source = PartOverTime::Make(MakeRoom(3, 3), {}, [](vtkPolyData*, double) {});
  vtkNew<vtkIrradianceFilter> filter;
  filter->SetController(Controller);
  filter->SetNumberOfWalks(2000);
  filter->AddInputConnection(0, source->GetOutputPort());
  filter->AddInputDataObject(0, MakeLamp({ 1.5, 1.5, 2.875 }, 0.75, { 100 }));
  source->FailsAt = Processes::IsLast() ? 0 : 7;
  const auto observer = ErrorObserver::Watch(filter);
  const auto ofSource = ErrorObserver::Watch(source);
  filter->Update();
  EXPECT_EQ(observer->Errors.size(), Processes::IsLast() ? 0u : 1u);
  EXPECT_EQ(ofSource->Failures, Processes::IsLast() ? 1 : 0);
  // All begin again together.
  source->FailsAt = 7;
  source->Modified();
  filter->Update();
  EXPECT_GT(filter->GetFigure("AbsorbedPower"), 0);
}
