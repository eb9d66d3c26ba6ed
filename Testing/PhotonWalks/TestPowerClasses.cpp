// SPDX-License-Identifier: BSD-3-Clause
// A weak lamp beside a strong one has walks and samples of its own.

#include "DirectLight/FirstHits.h"
#include "DirectLight/PowerClasses.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// Lamps of so many watts, each a strip of ten facets that share corners, and a point light. No
/// light arrives anywhere.
SceneObjects lampsOf(const std::vector<double>& watts, double point = 0)
{
  ObjectBuilder builder;
  for (std::size_t i = 0; i < watts.size(); ++i)
  {
    builder.addQuad({ 0, 2.0 * double(i), 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 5, grey(0, watts[i]));
  }
  if (point > 0)
  {
    builder.addPointLight({ 5, 5, 5 }, point);
  }
  return { builder.build(), {} };
}

std::vector<double> fluxOfClasses(const SceneObjects& objects, double leastPart = 0)
{
  std::vector<double> flux;
  for (const LightTable& some : powerClassesOf(LightTable(objects, 1000), objects, leastPart))
  {
    flux.push_back(some.flux());
  }
  return flux;
}

void expectFlux(const std::vector<double>& found, const std::vector<double>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-9 * expected[i]) << i;
  }
}

/// Walls of 4 x 4 x 3 m in which a panel of 10 W hangs, and far above them a point light that
/// shines on the ground around.
SceneObjects hutAndSun(double sun)
{
  ObjectBuilder scene = plainRoom({ 4, 4, 3 }, 6, grey(0.5));
  scene.addBox(box({ -0.1, -0.1, -0.1 }, { 4.1, 4.1, 3.1 }), 2, grey(0.5));
  scene.addQuad({ -20, -20, -0.2 }, { 44, 0, 0 }, { 0, 44, 0 }, 8, 8, grey(0.5));
  scene.addQuad({ 1.5, 1.5, 2.9 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(1, 10));
  if (sun > 0)
  {
    scene.addPointLight({ 20, 0, 40 }, sun);
  }
  return { scene.build(), {} };
}

// Facets are weaker than their lamp.
TEST(PowerClasses, AreOfLampsAndNotOfFacets)
{
  expectFlux(fluxOfClasses(lampsOf({ 1, 1.01 })), { 2.01 });
  expectFlux(fluxOfClasses(lampsOf({ 100, 15.1, 14.9 })), { 115.1, 14.9 });
  expectFlux(fluxOfClasses(lampsOf({ 1, 2 }, 1000)), { 1000, 3 });
  EXPECT_TRUE(fluxOfClasses(lampsOf({})).size() == 1);
}

TEST(PowerClasses, AreFourAtMost)
{
  expectFlux(fluxOfClasses(lampsOf({ 1, 1e-3, 1e-6, 1e-9, 1e-12 })), { 1, 1e-3, 1e-6, 1.001e-9 });
}

TEST(PowerClasses, HaveNoneForWhatIsTooLittle)
{
  expectFlux(fluxOfClasses(lampsOf({ 1, 1e-3, 1e-6 }), 1e-5), { 1, 1.001e-3 });
  expectFlux(fluxOfClasses(lampsOf({ 1, 1e-6 }), 1e-5), { 1.000001 });
}

// A weak lamp whose light falls where a strong one sends more has no walks of its own to wait for;
// behind a wall it has. A desk lamp outshines the ceiling on its desk.
TEST(PowerClasses, AreOfLampsThatShineElsewhere)
{
  const auto scene = [](bool hasWall, double height) {
    ObjectBuilder room = plainRoom({ 8, 4, 3 }, 8, grey(0.5));
    room.addQuad({ 1, 1, 2.9 }, { 0, 2, 0 }, { 2, 0, 0 }, 2, 2, grey(0, 100));
    addPanel(room, { 6.4, 2.15, height }, 0.2, 0.2, 100);
    if (hasWall)
    {
      room.addQuad({ 4, 0, 0 }, { 0, 4, 0 }, { 0, 0, 3 }, 2, 2, grey(0.5));
    }
    return SceneObjects{ room.build(), {} };
  };
  expectFlux(fluxOfClasses(scene(false, 2.9)), { 404 });
  expectFlux(fluxOfClasses(scene(true, 2.9)), { 400, 4 });
  expectFlux(fluxOfClasses(scene(false, 0.3)), { 400, 4 });
}

// The walls of a furnace outshine the lamps in it everywhere.
TEST(PowerClasses, LeaveAFurnaceWhole)
{
  ObjectBuilder furnace = plainRoom({ 4, 4, 3 }, 4, grey(0.5, 0.5));
  furnace.addSphere({ 1.5, 2, 1.2 }, 0.3, 16, grey(0.5, 0.5));
  EXPECT_EQ(fluxOfClasses({ furnace.build(), {} }).size(), 1u);
}

// Their walks differ in power, and bring all of it: a tenth of them goes by flux, the others are
// dealt evenly.
TEST(PowerClasses, ShareWalks)
{
  for (const double sun : { 1e4, 1e8 })
  {
    const WalkPlan plan(100000, 100000, 16);
    const std::vector<WalkSource> sources = sourcesOf(hutAndSun(sun), plan);
    ASSERT_EQ(sources.size(), 2u);
    EXPECT_NEAR(sources[0].plan.walksAfter(1), 55000, 100);
    EXPECT_GT(sources[1].plan.walksAfter(1), sun < 1e5 ? 44900u : 1000u);
    EXPECT_EQ(sources[1].plan.rounds().front().firstWalk, sources[0].plan.endWalk());
    for (const WalkSource& source : sources)
    {
      EXPECT_NEAR(quantaPerWatt(source), quantaPerWatt(sources[0]), 2e-3 * 0x1p46 / (sun + 10));
    }
  }
}

// The hut has the light of its own lamp, however strong the sun is from which none gets in; whether
// light is shot or gathered. Its walls absorb half of what arrives, and the lamp nothing: they get
// 20 W. Standard errors of 8 seeds are .02 W; .2 W of the last sun, beside which the lamp has some
// 10 walks of each replicate.
TEST(PowerClasses, KeepAWeakLampBesideAStrongOne)
{
  for (const bool isGathered : { false, true })
  {
    for (const double sun : { 0.0, 1e5, 1e7, 1e9 })
    {
      ReplicateMean received;
      overSeeds(hutAndSun(sun), kIsSanitized ? 2 : 8, Shoot(100000).gathered(isGathered),
        [&](const IrradianceEngine& engine) { received.add(wattsOn(engine, 0, 0, 216)); });
      EXPECT_NEAR(received.mean(), 20, sun < 1e8 ? 0.15 : 0.6) << isGathered << ", " << sun;
    }
  }
}

// Lights that are no brighter than the scene are shot, and found by rays; all others are looked
// for.

/// Walls of 4 x 4 x 3 m, which are 80 m2, half of which reflects. With a panel of 1 m2 below the
/// ceiling, if that shines.
ObjectBuilder ovenWith(double exitance, double panel = 0)
{
  ObjectBuilder room = plainRoom({ 4, 4, 3 }, 6, grey(0.5, exitance));
  if (panel > 0)
  {
    addPanel(room, { 1.5, 1.5, 2.9 }, 1, 1, panel);
  }
  return room;
}

/// The flux of those that are dim, and of all others, W.
std::pair<double, double> partsOf(const SceneObjects& objects)
{
  const LightTable lights(objects, 1000);
  const std::vector<bool> areDim =
    FirstHits(objects, lights).dimLights(objects, lights, meanReflectance(objects.staticObject));
  std::pair<double, double> flux;
  for (std::size_t i = 0; i < areDim.size(); ++i)
  {
    (areDim[i] ? flux.first : flux.second) += lights[i].totalFlux();
  }
  return flux;
}

void expectParts(const SceneObjects& objects, double dim, double bright)
{
  const auto [ofDim, ofBright] = partsOf(objects);
  EXPECT_NEAR(ofDim, dim, 1e-9 * (dim + bright));
  EXPECT_NEAR(ofBright, bright, 1e-9 * (dim + bright));
}

// The mean radiosity of the closed room is its flux over the 40 m2 that absorb.
TEST(DimLights, AreNoBrighterThanTheScene)
{
  expectParts({ ovenWith(10).build(), {} }, 800, 0);
  expectParts({ ovenWith(0, 100).build(), {} }, 0, 100);
  // 2.5 times the radiosity.
  ObjectBuilder ceiling;
  for (int side = 0; side < 6; ++side)
  {
    ceiling.addSide(box({ 0, 0, 0 }, { 4, 4, 3 }), side, 6, grey(0.5, side == 5 ? 10 : 0), true);
  }
  expectParts({ ceiling.build(), {} }, 0, 160);
  // Warm walls beside a lamp.
  expectParts({ ovenWith(10, 500).build(), {} }, 800, 500);
}

// Radiosity is little where light escapes: a floor that shines into the sky is no dim light, nor is
// a point.
TEST(DimLights, AreNotWhereLightEscapes)
{
  ObjectBuilder floor;
  floor.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 4, 4, grey(0.9, 10));
  expectParts({ floor.build(), {} }, 0, 160);
  ObjectBuilder room = ovenWith(10);
  room.addPointLight({ 1, 1, 1 }, 1e-3);
  expectParts({ room.build(), {} }, 800, 1e-3);
}

// What moves changes nothing.
TEST(DimLights, DependOnTheStaticObjectAndTheLights)
{
  ObjectBuilder ball, sheet;
  ball.addSphere({ 2, 2, 1 }, 0.5, 4, grey(0.5, 10));
  sheet.addQuad({ 0, 0, 2 }, { 4, 0, 0 }, { 0, 4, 0 }, 1, 1, grey(0.5));
  const double ofBall = LightTable({ nothing(), { ball.build() } }, 1000).flux();
  expectParts({ ovenWith(10).build(), { ball.build() } }, 800 + ofBall, 0);
  expectParts({ ovenWith(10).build(), { ball.build(), sheet.build() } }, 800 + ofBall, 0);
}

TEST(DimLights, HaveASourceOfTheirOwn)
{
  const SceneObjects objects{ ovenWith(10, 500).build(), {} };
  const WalkPlan plan(10000, 10000, 16);
  const std::vector<WalkSource> sources = gatheredOf(objects, plan);
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_TRUE(sources[0].areFoundByRays);
  EXPECT_FALSE(sources[0].cells.has_value());
  EXPECT_NEAR(sources[0].lights.flux(), 800, 1e-9);
  EXPECT_FALSE(sources[1].areFoundByRays);
  EXPECT_TRUE(sources[1].cells.has_value());
  EXPECT_NEAR(sources[1].lights.flux(), 500, 1e-9);
}

// Alone they are shot with as many walks as if nothing were gathered.
TEST(DimLights, AreShotAlone)
{
  const SceneObjects objects{ ovenWith(10).build(), {} };
  const WalkPlan plan(10000, 10000, 16);
  const std::vector<WalkSource> sources = gatheredOf(objects, plan);
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_TRUE(sources[0].areFoundByRays);
  EXPECT_EQ(sources[0].plan.walksAfter(1), 10000u);
}

// The noise of rays in a furnace is that of what they read alone: where all emits 1 - reflectance
// each finds 1 W/m2. Looking for these lights small cells were 20 % off.
TEST(DimLights, AreFoundByAnyRayOfAFurnace)
{
  ObjectBuilder thing;
  thing.addSphere({ 1.5, 2, 1.2 }, 0.3, 16, grey(0.5, 0.5));
  const SceneObjects objects{ plainRoom({ 4, 4, 3 }, 4, grey(0.5, 0.5)).build(),
    { thing.build() } };
  const UpdatedEngine engine(objects, gathering(200000));
  double square = 0;
  const std::size_t count = objects.dynamicObjects[0].material->numberOfCells;
  for (std::size_t cell = 0; cell < count; ++cell)
  {
    square += std::pow(engine.irradiance({ { 1, cell } }, 0) - 1, 2);
  }
  EXPECT_LT(std::sqrt(square / static_cast<double>(count)), 0.02);
}

}
}
