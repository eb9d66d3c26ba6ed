// SPDX-License-Identifier: BSD-3-Clause
// Method says in one word how light becomes known; the old names work beside it, and warn once.

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <sstream>

using namespace TestScenes;

namespace
{

using Filter = vtkIrradianceFilter;
using Setting = std::function<void(Filter*)>;

/// By method: what the old names call it.
const std::array<Setting, 6>& OldNames()
{
  static const std::array<Setting, 6> names{ [](Filter* f) {
                                              f->SetDirectLightToAutomatic();
                                              f->SetCellEstimateToAutomatic();
                                            },
    [](Filter* f) {
      f->SetDirectLightToShot();
      f->SetCellEstimateToSums();
    },
    [](Filter* f) {
      f->SetDirectLightToShot();
      f->SetCellEstimateToSpread();
    },
    [](Filter* f) {
      f->SetDirectLightToGathered();
      f->SetCellEstimateToGathered();
    },
    [](Filter* f) {
      f->SetDirectLight(1); // "Gathered" was 1
      f->SetCellEstimateToGathered();
      f->SetGatherOnToAllCells();
    },
    [](Filter* f) {
      f->SetDirectLight(Filter::Gathered);
      f->SetCellEstimateToGathered();
      f->UnbiasedGatherOn();
    } };
  return names;
}

Scene MakeScene()
{
  Scene scene = MakeSmallScene();
  scene.Moving[0].Model = MakeBall(0.3, 10);
  return scene;
}

}

TEST(Method, DefaultAndRange)
{
  vtkNew<Filter> filter;
  EXPECT_EQ(filter->GetMethod(), Filter::Automatic);
  filter->SetMethod(99);
  EXPECT_EQ(filter->GetMethod(), Filter::PathTraced) << "clamped";
  filter->SetMethod(-7);
  EXPECT_EQ(filter->GetMethod(), Filter::Automatic) << "clamped";
  const vtkMTimeType before = filter->GetMTime();
  filter->SetMethodToAutomatic();
  EXPECT_EQ(filter->GetMTime(), before) << "nothing has changed";
  filter->SetMethodToGathered();
  EXPECT_GT(filter->GetMTime(), before);
  EXPECT_EQ(filter->GetNumberOfRays(), 32);
  EXPECT_EQ(filter->GetNumberOfSpreadPhotons(), 250);
  EXPECT_EQ(filter->GetMaximumEffort(), 0);
  std::ostringstream text;
  filter->Print(text);
  ExpectWords(text.str(),
    { "Method: 3\n", "NumberOfRays: 32\n", "NumberOfSpreadPhotons: 250\n", "MaximumEffort: 0\n" });
}

// Bit for bit, and with one warning for each old name.
TEST(Method, IsWhatTheOldNamesSay)
{
  const Scene scene = MakeScene();
  std::vector<OutputBits> outputs;
  for (int method = Filter::Automatic; method <= Filter::PathTraced; ++method)
  {
    SCOPED_TRACE(method);
    const auto now = MakeFilter(scene, 2000), old = MakeFilter(scene, 2000);
    now->SetMethod(method);
    const auto reports = ErrorObserver::Watch(old);
    OldNames()[static_cast<std::size_t>(method)](old);
    const std::size_t names = reports->Warnings.size();
    EXPECT_GE(names, 2u);
    OldNames()[static_cast<std::size_t>(method)](old);
    EXPECT_EQ(reports->Warnings.size(), names) << "once";
    for (const std::string& warning : reports->Warnings)
    {
      ExpectWords(warning, { "set Method" });
    }
    EXPECT_EQ(old->GetMethod(), method);
    now->Update();
    old->Update();
    outputs.emplace_back(now);
    EXPECT_TRUE(IsSame(outputs.back(), OutputBits(old)));
  }
  for (std::size_t i = 2; i < outputs.size(); ++i)
  {
    EXPECT_FALSE(IsSame(outputs[i - 1], outputs[i])) << i;
  }
}

TEST(Method, IsUnknownWhereOldNamesSayNone)
{
  vtkNew<Filter> filter;
  const auto reports = ErrorObserver::Watch(filter);
  filter->SetDirectLight(-1); // as ParaView does where no old state sets it
  EXPECT_TRUE(reports->Warnings.empty());
  EXPECT_EQ(filter->GetMethod(), Filter::Automatic);
  filter->SetDirectLightToGathered();
  EXPECT_EQ(filter->GetMethod(), -1);
  EXPECT_EQ(filter->GetDirectLight(), 1);
  filter->SetCellEstimate(99);
  EXPECT_EQ(filter->GetCellEstimate(), Filter::AutomaticEstimate) << "clamped";
  filter->SetGatherOn(99);
  EXPECT_EQ(filter->GetGatherOn(), Filter::AllCells) << "clamped";
  filter->SetMethodToWalks();
  EXPECT_EQ(filter->GetGatherOn(), Filter::SmallCells);
  EXPECT_EQ(filter->GetUnbiasedGather(), 0);
}

TEST(Method, RaysAndEffortHaveOldNames)
{
  vtkNew<Filter> filter;
  const auto reports = ErrorObserver::Watch(filter);
  filter->SetNumberOfGatherRays(16);
  EXPECT_EQ(filter->GetNumberOfRays(), 16);
  EXPECT_EQ(filter->GetMaximumNumberOfWalks(), 10000000);
  EXPECT_EQ(filter->GetMaximumNumberOfGatherRays(), 1024);
  filter->SetNumberOfWalks(300);
  filter->SetMaximumEffort(2.5);
  EXPECT_EQ(filter->GetMaximumNumberOfWalks(), 750);
  EXPECT_EQ(filter->GetMaximumNumberOfGatherRays(), 40);
  filter->SetMaximumEffort(1e300);
  EXPECT_EQ(filter->GetMaximumNumberOfWalks(), 4294967295);
  EXPECT_EQ(filter->GetMaximumNumberOfGatherRays(), 65536);
  EXPECT_EQ(reports->Warnings.size(), 1u);
  filter->SetMaximumNumberOfWalks(20000);
  filter->SetMaximumNumberOfGatherRays(64);
  EXPECT_EQ(filter->GetMaximumNumberOfWalks(), 20000);
  EXPECT_EQ(filter->GetMaximumNumberOfGatherRays(), 64);
  EXPECT_EQ(reports->Warnings.size(), 3u);
}
