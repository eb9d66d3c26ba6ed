// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the choice alone, at its limit.

#include "Estimates/AutomaticChoice.h"
#include "TestScenes.h"
#include "Walks/WalkSettings.h"

#include <gtest/gtest.h>

namespace irradiance::test
{

namespace
{

struct Settings
{
  WalkSettings walks;
  EstimateSettings estimate;
};

/// That direct light may be gathered, and so many rays that a cell expects 32 photons where there are four rays a walk.
Settings settingsOf(std::uint32_t walks)
{
  Settings settings;
  settings.walks.numberOfWalks = walks;
  settings.walks.gathersDirectLight = true;
  settings.estimate.gatherRays = 64;
  return settings;
}

constexpr LeftToScene kAll{ true, true };

Settings chosen(const SceneObjects& objects, Settings settings, const LeftToScene& left = kAll)
{
  AutomaticChoice().make(left, objects, settings.walks, settings.estimate);
  return settings;
}

void expectChoice(const Settings& settings, CellEstimate estimate, bool gathersDirectLight)
{
  EXPECT_EQ(settings.estimate.cellEstimate, estimate);
  EXPECT_EQ(settings.walks.gathersDirectLight, gathersDirectLight);
}

/// 54 cells of the same area. `specular`: of its cells.
ObjectBuilder room(double specular = 0)
{
  ObjectBuilder builder;
  Look look = grey(0.5);
  look.specular[0] = specular;
  builder.addBox(box({ 0, 0, 0 }, { 3, 3, 3 }), 3, look, true);
  return builder;
}

/// A rectangle of n x n cells and of this area, m2.
SceneObject rectangle(int n, double area, const AffineMap& worldFromObject = {})
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { area, 0, 0 }, { 0, 1, 0 }, n, n, grey(0.5));
  return builder.build(worldFromObject);
}

}

// 2 x 64 rays a cell.
TEST(AutomaticChoice, TakesAtMostFourRaysForEachWalk)
{
  const SceneObjects objects{ room().build(), {} };
  expectChoice(chosen(objects, settingsOf(54 * 32)), CellEstimate::Gathered, true);
  expectChoice(chosen(objects, settingsOf(54 * 32 - 1)), CellEstimate::Sums, true);
}

// Four samples a cell.
TEST(AutomaticChoice, TakesAtMostFourSamplesForEachWalk)
{
  const SceneObjects objects{ room().build(), {} };
  expectChoice(chosen(objects, settingsOf(54)), CellEstimate::Sums, true);
  expectChoice(chosen(objects, settingsOf(53)), CellEstimate::Sums, false);
}

TEST(AutomaticChoice, ShootsWhatIsToBeShot)
{
  Settings settings = settingsOf(100000);
  settings.walks.gathersDirectLight = false;
  const SceneObjects objects{ room().build(), {} };
  expectChoice(chosen(objects, settings, { false, true }), CellEstimate::Sums, false);
}

// No reflection of points is known to rays. Gloss alone, or a point light alone, is.
TEST(AutomaticChoice, KnowsPointLightsBesideGloss)
{
  for (const double specular : { 0.0, 0.25 })
  {
    ObjectBuilder builder = room(specular);
    expectChoice(chosen({ builder.build(), {} }, settingsOf(100000)), CellEstimate::Gathered, true);
    builder.addPointLight({ 1, 1, 1 }, 10);
    expectChoice(chosen({ builder.build(), {} }, settingsOf(100000)),
      specular > 0 ? CellEstimate::Sums : CellEstimate::Gathered, true);
  }
}

// A cell is read if it expects 25 photons: here one large cell, and 64 small ones that expect 23.
TEST(AutomaticChoice, ReadsHalfOfTheArea)
{
  const auto objects = [](double small) {
    return SceneObjects{ rectangle(1, 1), { rectangle(8, small) } };
  };
  expectChoice(chosen(objects(1), settingsOf(3000)), CellEstimate::Gathered, true);
  expectChoice(chosen(objects(1 + 0x1p-20), settingsOf(3000)), CellEstimate::Sums, true);
  expectChoice(chosen(objects(1 + 0x1p-20), settingsOf(3400)), CellEstimate::Gathered, true);
}

TEST(AutomaticChoice, HasNothingToReadWithoutBias)
{
  Settings settings = settingsOf(100000);
  settings.estimate.unbiasedGather = true;
  expectChoice(chosen({ room().build(), {} }, settings), CellEstimate::Sums, true);
}

TEST(AutomaticChoice, KeepsWhatIsAskedFor)
{
  const SceneObjects objects{ room().build(), {} };
  Settings few = settingsOf(10);
  for (const CellEstimate estimate :
    { CellEstimate::Sums, CellEstimate::Spread, CellEstimate::Nearest, CellEstimate::Gathered })
  {
    few.estimate.cellEstimate = estimate;
    // Rays need gathered direct light, however many cells there are.
    expectChoice(
      chosen(objects, few, { true, false }), estimate, estimate == CellEstimate::Gathered);
    expectChoice(chosen(objects, few, { false, false }), estimate, true);
  }
  expectChoice(chosen(objects, few, { false, true }), CellEstimate::Sums, true);
}

// What is away has no cells, as if it had never been there.
TEST(AutomaticChoice, CountsWhatIsThere)
{
  SceneObjects objects{ room().build(), { rectangle(20, 1000) } };
  expectChoice(chosen(objects, settingsOf(2000)), CellEstimate::Sums, true);
  expectChoice(chosen(objects, settingsOf(300)), CellEstimate::Sums, false);
  objects.dynamicObjects[0].isPresent = false;
  expectChoice(chosen(objects, settingsOf(2000)), CellEstimate::Gathered, true);
  expectChoice(chosen(objects, settingsOf(300)), CellEstimate::Sums, true);
}

TEST(AutomaticChoice, KnowsWhetherAPointLightIsThere)
{
  ObjectBuilder light;
  light.addPointLight({ 1, 1, 1 }, 10);
  SceneObjects objects{ room(0.25).build(), { light.build() } };
  expectChoice(chosen(objects, settingsOf(100000)), CellEstimate::Sums, true);
  objects.dynamicObjects[0].isPresent = false;
  expectChoice(chosen(objects, settingsOf(100000)), CellEstimate::Gathered, true);
}

// The walks that a target takes in the end are not known before.
TEST(AutomaticChoice, IsThatOfTheWalksToBeginWith)
{
  const SceneObjects objects{ room().build(), {} };
  Settings settings = settingsOf(54);
  settings.walks.targetRelativeError = 0.05;
  settings.walks.replicates = 16;
  expectChoice(chosen(objects, settings), CellEstimate::Sums, true);
}

// Frame by frame as at first: a part that grows, and shrinks again.
TEST(AutomaticChoice, DoesNotRememberFrames)
{
  AutomaticChoice choice;
  for (const double scale : { 1.0, 1.05, 1.0, 1.05 })
  {
    const SceneObjects objects{ rectangle(1, 1),
      { rectangle(8, 1, { scale * Matrix3::Identity(), { 0, 0, 1 } }) } };
    Settings settings = settingsOf(3000);
    choice.make(kAll, objects, settings.walks, settings.estimate);
    expectChoice(settings, scale == 1 ? CellEstimate::Gathered : CellEstimate::Sums, true);
  }
}

}
