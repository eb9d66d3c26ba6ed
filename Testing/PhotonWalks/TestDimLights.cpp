// SPDX-License-Identifier: BSD-3-Clause
// Lights that are no brighter than the scene are shot, and found by rays; all others are looked
// for.

#include "DirectLight/DimLights.h"
#include "Kit.h"
#include "Surfaces/MeanReflectance.h"

namespace irradiance::test
{
namespace
{

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
  const DimLights dim(objects, FirstHits(objects, lights), meanReflectance(objects.staticObject));
  std::pair<double, double> flux;
  for (const Light& light : lights.lights())
  {
    (dim.contains(light) ? flux.first : flux.second) += light.totalFlux();
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
