// SPDX-License-Identifier: BSD-3-Clause
// What a user gets who chooses neither DirectLight nor CellEstimate. (The rules:
// TestAutomaticChoice.cpp of the engine.)

#include "ErrorObserver.h"
#include "OutputBits.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <functional>

using namespace TestScenes;

namespace
{

constexpr int Spread = vtkIrradianceFilter::Spread, FinalGather = vtkIrradianceFilter::FinalGather;
constexpr int Shot = vtkIrradianceFilter::Shot, Gathered = 1;

/// Updates without an error, and expects this choice in the field data.
void ExpectChoice(vtkIrradianceFilter* filter, int estimate, int directLight)
{
  const Reports reports = Update(filter);
  ASSERT_TRUE(reports.Errors.empty()) << reports.Errors.front();
  EXPECT_EQ(Field(filter, "CellEstimate"), estimate);
  EXPECT_EQ(Field(filter, "DirectLight"), directLight);
}

/// The same as if one had asked for it.
void ExpectBitsOf(vtkIrradianceFilter* filter, const Scene& scene, int estimate, int directLight)
{
  const auto asked = MakeDefaultFilter(scene, filter->GetNumberOfWalks());
  asked->SetCellEstimate(estimate);
  asked->SetDirectLight(directLight);
  EXPECT_TRUE(UpdatesLike(filter, asked));
}

/// Takes a filter with the default choice through frames, and compares each with a new filter. The
/// estimate is to be Gathered in the even ones alone, and the direct light this one in the others.
void ExpectUpdatesAcrossFlips(
  const Scene& scene, vtkIdType walks, int directLight, const std::function<void(int frame)>& goTo)
{
  const auto updated = MakeDefaultFilter(scene, walks);
  for (int frame = 0; frame < 4; ++frame)
  {
    SCOPED_TRACE(frame);
    goTo(frame);
    frame % 2 == 0 ? ExpectChoice(updated, FinalGather, Gathered)
                   : ExpectChoice(updated, Spread, directLight);
    EXPECT_TRUE(UpdatesLike(updated, MakeDefaultFilter(scene, walks)));
    EXPECT_GT(Field(updated, "ShootSeconds"), 0);
  }
}

}

TEST(AutomaticChoice, GathersInAPlainRoom)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeDefaultFilter(scene, 11000);
  ExpectChoice(filter, FinalGather, Gathered);
  ExpectBitsOf(filter, scene, FinalGather, Gathered);
}

TEST(AutomaticChoice, ShootsWhereOneAsksForIt)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeDefaultFilter(scene, 11000);
  filter->SetDirectLightToShot();
  ExpectChoice(filter, Spread, Shot);
  ExpectBitsOf(filter, scene, Spread, Shot);
}

TEST(AutomaticChoice, GathersDirectLightForAnEstimateThatNeedsIt)
{
  const auto filter = MakeDefaultFilter(MakeSmallScene(), 100);
  ExpectChoice(filter, Spread, Shot);
  filter->SetCellEstimateToGathered();
  ExpectChoice(filter, FinalGather, Gathered);
}

TEST(AutomaticChoice, TakesPointLightsBesideGloss)
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Moving[0].Model, "SpecularReflectance", { 0.25 });
  scene.Fixed.push_back(MakePointLight({ 0.5, 2, 2 }, { 20 }));
  const auto filter = MakeDefaultFilter(scene, 11000);
  ExpectChoice(filter, Spread, Gathered);
  ExpectBitsOf(filter, scene, Spread, Gathered);
}

// 9,600 cells of walls.
TEST(AutomaticChoice, ShootsAHugeMesh)
{
  Scene scene = MakeSmallScene();
  scene.Fixed[0] = MakeRoom(3, 40);
  const auto filter = MakeDefaultFilter(scene, 9000);
  ExpectChoice(filter, Spread, Shot);
  filter->SetNumberOfWalks(10000);
  ExpectChoice(filter, Spread, Gathered);
}

// A target takes more walks than one begins with: rays would read those.
TEST(AutomaticChoice, StaysWhereATargetTakesMoreWalks)
{
  const auto filter = MakeDefaultFilter(MakeSmallScene(), 1000);
  ExpectChoice(filter, Spread, Gathered);
  filter->SetTargetRelativeError(0.1);
  filter->SetMaximumNumberOfWalks(32000);
  ExpectChoice(filter, Spread, Gathered);
  EXPECT_GT(filter->GetFigure("NumberOfWalks"), 1000);
}

// No motion changes the choice, and so each is a repair.
TEST(AutomaticChoice, StaysWhileThingsMove)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeDefaultFilter(scene, 11000);
  for (int frame = 0; frame < 4; ++frame)
  {
    ExpectChoice(filter, FinalGather, Gathered);
    EXPECT_EQ(Field(filter, "ShootSeconds") > 0, frame == 0);
    scene.Moving[0].Pose->RotateWXYZ(30, 1, 2, 3);
    scene.Moving[1].Pose->Translate(-0.1, -0.1, 0.2);
    scene.Moving[1].Pose->Scale(1.3, 1.3, 0.5);
  }
}

// Most of the area is that of a sheet of small cells, which rays do not read, or of the walls,
// which they do.
TEST(AutomaticChoice, UpdateEqualsRebuildWhereAPartComes)
{
  Scene scene = MakeSmallScene();
  const Mesh sheet = MakeRectangle({ -6, -6, -1 }, { 12, 0, 0 }, { 0, 12, 0 }, 30);
  ExpectUpdatesAcrossFlips(scene, 5000, Gathered, [&](int frame) {
    scene.Moving[0].Model->ShallowCopy(frame % 2 == 0 ? Mesh::New() : sheet);
    scene.Moving[1].Pose->Translate(-0.1, 0, 0);
  });
}

TEST(AutomaticChoice, UpdateEqualsRebuildWhereAPointLightComesToGloss)
{
  Scene scene = MakeSmallScene();
  SetCellValues(scene.Fixed[0], "SpecularReflectance", { 0.25 });
  const Mesh light = MakePointLight({ 0, 0, 0.1 }, { 20 });
  ExpectUpdatesAcrossFlips(scene, 11000, Shot,
    [&](int frame) { scene.Moving[0].Model->ShallowCopy(frame % 2 == 0 ? Mesh::New() : light); });
}
