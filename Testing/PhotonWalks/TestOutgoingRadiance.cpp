// SPDX-License-Identifier: BSD-3-Clause
#include "Views/OutgoingRadiance.h"

#include "CosineHemisphere.h"
#include "EngineRun.h"
#include "MovingScene.h"
#include "OnlySet.h"
#include "ThreadExecution.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

using test::box;
using test::Look;
using test::MovingScene;
using test::ObjectBuilder;
using test::sampleCosineHemisphere;

constexpr std::uint32_t kMirrorSamples = 16;

EngineSettings settingsOf(std::uint32_t walks, bool gathersDirectLight = false)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.keepPhotons = true;
  settings.gathersDirectLight = gathersDirectLight;
  return settings;
}

Look glossy(double diffuse, double specular, double exponent, double exitance = 0)
{
  Look look = test::grey(diffuse, exitance);
  look.specular = { specular, specular, specular };
  look.exponent = exponent;
  return look;
}

/// The integral over the hemisphere around `normal` of radiance times cosine, W/m2. The directions
/// have a density of cos / pi, so the mean radiance times pi is the integral.
double exitanceOf(const OutgoingRadiance& radiance, std::uint32_t object, std::size_t cell,
  const Vector3& normal, int steps)
{
  double sum = 0;
  for (int i = 0; i < steps * steps; ++i)
  {
    const Vector3 direction =
      sampleCosineHemisphere(normal, { (i / steps + 0.5) / steps, (i % steps + 0.5) / steps });
    sum += radiance({ object, cell }, { direction, true })[0];
  }
  return sum * M_PI / (steps * steps);
}

/// The radiances of all cells towards a near and a far eye by turns.
std::vector<double> allRadiances(IrradianceEngine& engine)
{
  Execution execution;
  engine.collect<CellPhotonSets>(execution);
  const OutgoingRadiance radiance(engine, 2, execution);
  const Eye near{ { 0.1, 0.2, 0.3 } }, far{ { 0, 0.6, 0.8 }, true };
  std::vector<double> all;
  for (std::uint32_t object = 0; object < engine.objects().size(); ++object)
  {
    for (std::size_t cell = 0; cell < engine.objects()[object].material->numberOfCells; ++cell)
    {
      const auto bands = radiance({ object, cell }, cell % 2 == 0 ? near : far);
      all.insert(all.end(), bands.begin(), bands.end());
    }
  }
  return all;
}

}

// What leaves a cell over all directions is what it reflects of the light that it received: the sum
// over photons holds for each of them, whatever their number. So it does for samples of gathered light. 1 % is the
// error of the directions.
TEST(OutgoingRadiance, IntegratesToTheReflectedIrradiance)
{
  for (const auto& [exponent, isGathered] :
    { std::pair(0.0, false), std::pair(3.0, false), std::pair(40.0, false), std::pair(0.0, true),
      std::pair(3.0, true), std::pair(40.0, true) })
  {
    ObjectBuilder room;
    room.addBox(box({ 0, 0, 0 }, { 4, 3, 2 }), 2, glossy(0.2, 0.5, exponent), true);
    room.addPointLight({ 1, 1, 1.5 }, 10);
    const SceneObjects objects{ room.build(), {} };
    IrradianceEngine engine;
    Execution execution;
    engine.update(objects, settingsOf(1000, isGathered), execution);
    engine.collect<CellPhotonSets>(execution);
    const OutgoingRadiance radiance(engine, kMirrorSamples, execution);
    const Vector3 normals[] = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
      { 0, 0, -1 } };
    for (std::size_t cell = 0; cell < 24; ++cell)
    {
      const double received = engine.irradiance({ 0, cell }, 0);
      EXPECT_NEAR(
        exitanceOf(radiance, 0, cell, normals[cell / 4], 32), 0.7 * received, 0.007 * received)
        << "exponent " << exponent << ", cell " << cell << ", gathered " << isGathered;
    }
  }
}

namespace
{

/// In a furnace the radiance is 1 / pi everywhere and in each direction, also in mirrors.
void expectFurnace(bool isGathered, double tolerance)
{
  ObjectBuilder room;
  const Box walls = box({ 0, 0, 0 }, { 4, 3, 2 });
  room.addSide(walls, 0, 3, glossy(0, 0.6, kInfinity, 0.4), true);
  for (int side = 1; side < 6; ++side)
  {
    room.addSide(walls, side, 3, glossy(0.3, 0.4, 5, 0.3), true);
  }
  const SceneObjects objects{ room.build(), {} };
  IrradianceEngine engine;
  Execution execution;
  engine.update(objects, settingsOf(test::scaled(400000), isGathered), execution);
  engine.collect<CellPhotonSets>(execution);
  const OutgoingRadiance radiance(engine, kMirrorSamples, execution);
  for (const Vector3& eye : { Vector3(2, 1.5, 1), Vector3(3.5, 0.4, 0.3) })
  {
    double mean = 0;
    for (std::size_t cell = 0; cell < 54; ++cell)
    {
      const double seen = radiance({ 0, cell }, { eye })[0] * M_PI;
      EXPECT_NEAR(seen, 1, tolerance) << "cell " << cell;
      mean += seen / 54;
    }
    EXPECT_NEAR(mean, 1, 0.1 * tolerance);
  }
}

}

// 10^6 photons on 54 cells: a lobe of exponent 5 holds some 1,500 of those on a cell, so 10 % are over 3.5
// standard errors of the effective number, a third of that.
TEST(OutgoingRadiance, IsThatOfAFurnace)
{
  expectFurnace(false, test::kIsSanitized ? 0.4 : 0.1);
}

// A third of the light is gathered, with 256 samples on a cell, some 50 of them in a lobe: 5 % of all light.
TEST(OutgoingRadiance, IsThatOfAFurnaceWithGatheredLight)
{
  expectFurnace(true, test::kIsSanitized ? 0.6 : 0.22);
}

// A mirror shows the black and white halves of the wall opposite, where the laws of reflection say.
TEST(OutgoingRadiance, AMirrorShowsWhatIsThere)
{
  ObjectBuilder scene;
  scene.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 1, glossy(0, 0.8, kInfinity));
  scene.addQuad({ -2, -2, 3 }, { 0, 4, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0, 5)); // x < 0
  scene.addQuad({ 0, -2, 3 }, { 0, 4, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0, 7));  // x > 0
  const SceneObjects objects{ scene.build(), {} };
  IrradianceEngine engine;
  Execution execution;
  engine.update(objects, settingsOf(100), execution);
  engine.collect<CellPhotonSets>(execution);
  const OutgoingRadiance radiance(engine, kMirrorSamples, execution);
  const Eye above{ { 0, 0, 1 }, true };
  EXPECT_NEAR(radiance({ 0, 0 }, above)[0], 0.8 * 5 / M_PI, 1e-12);
  EXPECT_NEAR(radiance({ 0, 1 }, above)[0], 0.8 * 7 / M_PI, 1e-12);
  const Eye below{ { 0, 0, -1 }, true };
  EXPECT_EQ(radiance({ 0, 0 }, below)[0], 0) << "there is nothing to see";
  // A lamp shows its front alone; seen from behind, it is dark.
  EXPECT_NEAR(radiance({ 0, 2 }, below)[0], 5 / M_PI, 1e-12);
  EXPECT_EQ(radiance({ 0, 2 }, above)[0], 0);
}

// A glossy sheet that is lit from above shows nothing from below.
TEST(OutgoingRadiance, PhotonsOfTheOtherSideAreNotSeen)
{
  ObjectBuilder scene;
  scene.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1, glossy(0, 0.9, 2));
  scene.addPointLight({ 0, 0, 1 }, 1);
  const SceneObjects objects{ scene.build(), {} };
  IrradianceEngine engine;
  Execution execution;
  engine.update(objects, settingsOf(1000), execution);
  engine.collect<CellPhotonSets>(execution);
  const OutgoingRadiance radiance(engine, kMirrorSamples, execution);
  EXPECT_GT(radiance({ 0, 0 }, { { 0, 0.5, 2 } })[0], 0.01);
  EXPECT_EQ(radiance({ 0, 0 }, { { 0, 0.5, -2 } })[0], 0);
}

// The photons of an engine that updates equal a new one's, and so does what is seen.
TEST(OutgoingRadiance, UpdateEqualsRebuild)
{
  for (const auto& [bands, isGathered] :
    { std::pair(1, false), std::pair(3, false), std::pair(1, true), std::pair(3, true) })
  {
    MovingScene scene(bands, bands == 3, 91, true);
    EngineSettings settings = settingsOf(test::scaled(500), isGathered);
    settings.separateSides = bands == 3;
    IrradianceEngine engine;
    test::ThreadExecution threads(2);
    const int frames = test::kIsSanitized ? 5 : 100 / bands;
    for (int frame = 0; frame < frames; ++frame, scene.nextFrame())
    {
      engine.update(scene.objects(), settings, threads);
      EXPECT_EQ(engine.statistics().shootSeconds > 0, frame == 0);
      IrradianceEngine fresh;
      Execution execution;
      fresh.update(scene.objects(), settings, execution);
      ASSERT_EQ(allRadiances(engine), allRadiances(fresh))
        << bands << " bands, frame " << frame << ", gathered " << isGathered;
    }
  }
}

// A time budget leaves photons in the sets that are stale; when all is repaired, none is.
TEST(OutgoingRadiance, ABudgetConvergesToTheRebuild)
{
  MovingScene scene(1, true, 92, true);
  EngineSettings settings = settingsOf(2000);
  IrradianceEngine engine;
  Execution execution;
  engine.update(scene.objects(), settings, execution);
  allRadiances(engine); // from here on the photons are kept up to date
  scene.nextFrame();
  settings.repairTimeBudget = 1e-9;
  int updates = 0;
  do
  {
    engine.update(scene.objects(), settings, execution);
    allRadiances(engine);
    ++updates;
  } while (test::onlySet(engine).stale() && !test::onlySet(engine).stale()->isEmpty());
  EXPECT_GT(updates, 1);
  IrradianceEngine fresh;
  fresh.update(scene.objects(), settings, execution);
  EXPECT_EQ(allRadiances(engine), allRadiances(fresh));
}

// With a target, rounds of walks come and go.
TEST(OutgoingRadiance, ATargetThatAddsAndDropsRoundsKeepsThePhotons)
{
  MovingScene scene(1, true, 93, true);
  EngineSettings settings = settingsOf(4000);
  settings.replicates = 8;
  settings.maximumNumberOfWalks = 64000;
  IrradianceEngine engine;
  Execution execution;
  for (const double target : { 1.0, 0.6, 2.0 })
  {
    settings.targetRelativeError = target;
    engine.update(scene.objects(), settings, execution);
    IrradianceEngine fresh;
    fresh.update(scene.objects(), settings, execution);
    ASSERT_EQ(allRadiances(engine), allRadiances(fresh)) << "target " << target;
    scene.nextFrame();
  }
}

}
