// SPDX-License-Identifier: BSD-3-Clause
// Each rule of the choice alone, at its limit.

#include "Estimates/AutomaticChoice.h"
#include "FinalGather/CellRoles.h"
#include "Kit.h"
#include "Walks/WalkSets.h"

namespace irradiance::test
{
namespace
{

struct Settings
{
  WalkSettings walks;
  EstimateSettings estimate;
};

/// That direct light may be gathered.
Settings settingsOf(std::uint32_t walks)
{
  Settings settings;
  settings.walks.numberOfWalks = walks;
  settings.walks.gathersDirectLight = true;
  return settings;
}

constexpr LeftToScene kAll{ true, true };

Settings chosen(const SceneObjects& objects, Settings settings, const LeftToScene& left = kAll)
{
  SceneCells cells;
  cells.update(objects, {});
  std::optional<LightSurvey> survey;
  const auto surveyed = [&]() -> const LightSurvey& {
    return survey ? *survey
                  : survey.emplace(objects, sourcesOf(objects, WalkSets::planOf(settings.walks)));
  };
  chooseByScene(left, objects, cells, surveyed, settings.walks, settings.estimate);
  return settings;
}

void expectChoice(const Settings& settings, CellEstimate estimate, bool gathersDirectLight)
{
  EXPECT_EQ(settings.estimate.cellEstimate, estimate);
  EXPECT_EQ(settings.walks.gathersDirectLight, gathersDirectLight);
}

/// 54 cells. `specular`: of its cells.
ObjectBuilder quadRoom(double specular = 0)
{
  Look look = grey(0.5);
  look.specular[0] = specular;
  return plainRoom({ 3, 3, 3 }, 3, look);
}

// From both sides of a cell: 1.2 times as many as walks at most, but four in any case.
TEST(AutomaticChoice, TakesFewerRaysWhereCellsAreMany)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 10, 0, 0 }, { 0, 10, 0 }, 1, 1, grey(0.5));
  builder.addQuad({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 40, 40, grey(0.5)); // 1600 small cells
  const SceneObjects objects{ builder.build(), {} };
  for (const auto& [walks, rays] : { std::pair(85334u, 32u), std::pair(85333u, 16u),
         std::pair(42667u, 16u), std::pair(10667u, 4u) })
  {
    const Settings settings = chosen(objects, settingsOf(walks));
    expectChoice(settings, CellEstimate::Gathered, true);
    EXPECT_EQ(settings.estimate.gatherRays, rays) << walks;
  }
  expectChoice(chosen(objects, settingsOf(10666)), CellEstimate::Spread, true);
}

// Rays have to find something to read: here one large cell and 64 small ones, which are not read.
TEST(AutomaticChoice, ReadsHalfOfTheArea)
{
  for (const double small : { 0.1, 0.5, 0.99, 1.01, 1.2 })
  {
    ObjectBuilder builder;
    builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(0.5));
    builder.addQuad({ 0, 0, 1 }, { small, 0, 0 }, { 0, 1, 0 }, 8, 8, grey(0.5));
    expectChoice(chosen({ builder.build(), {} }, settingsOf(2000)),
      small <= 1 ? CellEstimate::Gathered : CellEstimate::Spread, true);
  }
}

// The walks that a target takes in the end are not known before.
TEST(AutomaticChoice, GathersDirectLightOfAsManyCellsAsWalksUnlessItIsToBeShot)
{
  const SceneObjects objects{ quadRoom().build(), {} };
  expectChoice(chosen(objects, settingsOf(54)), CellEstimate::Spread, true);
  expectChoice(chosen(objects, settingsOf(53)), CellEstimate::Spread, false);
  Settings settings = settingsOf(1000);
  settings.walks.targetRelativeError = 0.05;
  settings.walks.replicates = 16;
  expectChoice(chosen(objects, settings), CellEstimate::Spread, true);
  settings = settingsOf(100000);
  settings.walks.gathersDirectLight = false;
  expectChoice(chosen(objects, settings, { false, true }), CellEstimate::Spread, false);
}

// No reflection of points is known to rays. Where three quarters are reflected samples do not pay
// for themselves. Gloss alone, or a point light alone, is.
TEST(AutomaticChoice, KnowsPointLightsBesideGloss)
{
  for (const double specular : { 0.0, 0.25 })
  {
    ObjectBuilder builder = quadRoom(specular);
    expectChoice(chosen({ builder.build(), {} }, settingsOf(100000)), CellEstimate::Gathered, true);
    builder.addPointLight({ 1, 1, 1 }, 10);
    expectChoice(chosen({ builder.build(), {} }, settingsOf(100000)),
      specular > 0 ? CellEstimate::Spread : CellEstimate::Gathered, specular == 0);
  }
  ObjectBuilder light;
  light.addPointLight({ 1, 1, 1 }, 10);
  SceneObjects objects{ quadRoom(0.25).build(), { light.build() } };
  expectChoice(chosen(objects, settingsOf(100000)), CellEstimate::Spread, false);
  objects.dynamicObjects[0].isPresent = false;
  expectChoice(chosen(objects, settingsOf(100000)), CellEstimate::Gathered, true);
}

TEST(AutomaticChoice, HasNothingToReadWithoutBias)
{
  Settings settings = settingsOf(100000);
  settings.estimate.unbiasedGather = true;
  expectChoice(chosen({ quadRoom().build(), {} }, settings), CellEstimate::Sums, true);
}

TEST(AutomaticChoice, KeepsWhatIsAskedFor)
{
  const SceneObjects objects{ quadRoom().build(), {} };
  Settings few = settingsOf(10);
  for (const CellEstimate estimate :
    { CellEstimate::Sums, CellEstimate::Spread, CellEstimate::Gathered })
  {
    few.estimate.cellEstimate = estimate;
    // Rays need gathered direct light, however many cells there are.
    expectChoice(
      chosen(objects, few, { true, false }), estimate, estimate == CellEstimate::Gathered);
    expectChoice(chosen(objects, few, { false, false }), estimate, true);
  }
  expectChoice(chosen(objects, few, { false, true }), CellEstimate::Spread, true);
}

// What is away has no cells, as if it had never been there.
TEST(AutomaticChoice, CountsWhatIsThere)
{
  ObjectBuilder sheet;
  sheet.addQuad({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 100, 100, grey(0.5));
  SceneObjects objects{ quadRoom().build(), { sheet.build() } };
  objects.dynamicObjects[0].worldFromObject.linear *= 10;
  expectChoice(chosen(objects, settingsOf(5000)), CellEstimate::Spread, false);
  objects.dynamicObjects[0].isPresent = false;
  expectChoice(chosen(objects, settingsOf(5000)), CellEstimate::Gathered, true);
}

/// A room that its lamp lights evenly or not, and a part of 900 small cells with so long edges, m.
SceneObjects roomWithPart(ObjectBuilder& room, double edge, double exitance = 0)
{
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 8, grey(0.5, exitance), true);
  ObjectBuilder part;
  part.addQuad({ 1, 1, 1 }, { edge, 0, 0 }, { 0, edge, 0 }, 30, 30, grey(0.5));
  return { room.build(), { part.build() } };
}

// All walls shine, or a panel below the ceiling.
TEST(AutomaticChoice, ReadsByRaysWhatIsLitEvenly)
{
  ObjectBuilder shining, lit;
  expectChoice(
    chosen(roomWithPart(shining, 0.5, 1), settingsOf(100000)), CellEstimate::Gathered, true);
  lit.addQuad({ 1.4, 1.4, 2.99 }, { 0, 1.2, 0 }, { 1.2, 0, 0 }, 1, 1, grey(0, 10));
  expectChoice(chosen(roomWithPart(lit, 0.5), settingsOf(100000)), CellEstimate::Gathered, true);
}

// Rays would find a bright spot by chance. A tiny part catches too few photons for all that.
TEST(AutomaticChoice, DrawsOnPhotonsWhereThereAreBrightSpots)
{
  for (const auto& [edge, estimate] :
    { std::pair(0.5, CellEstimate::Spread), std::pair(0.02, CellEstimate::Gathered) })
  {
    ObjectBuilder room;
    room.addPointLight({ 2, 2, 2.8 }, 10);
    expectChoice(chosen(roomWithPart(room, edge), settingsOf(100000)), estimate, true);
  }
}

// Of 312 photons on a part each cell would draw on 250, from all over it: sixteen rays err less. Of
// 3,120 that is a small patch.
TEST(AutomaticChoice, DrawsOnNoPhotonsFromAllOverAPart)
{
  for (const auto& [walks, estimate] :
    { std::pair(100000u, CellEstimate::Gathered), std::pair(1000000u, CellEstimate::Spread) })
  {
    ObjectBuilder room;
    room.addQuad({ 1.4, 1.4, 2.99 }, { 0, 1.2, 0 }, { 1.2, 0, 0 }, 1, 1, grey(0, 10));
    Settings settings = settingsOf(walks);
    settings.estimate.gatherRays = 16;
    expectChoice(chosen(roomWithPart(room, 0.5), settings), estimate, true);
  }
}

// Samples for many facets just below a ceiling are the larger noise.
TEST(AutomaticChoice, DrawsOnPhotonsWhereLampsAreHardToFind)
{
  ObjectBuilder room;
  addTubes(room);
  expectChoice(chosen(roomWithPart(room, 0.5), settingsOf(100000)), CellEstimate::Spread, false);
  expectChoice(chosen(roomWithPart(room, 0.5), settingsOf(100000), { false, true }),
    CellEstimate::Spread, true);
}

}
}
