// SPDX-License-Identifier: BSD-3-Clause
// The engine with the cell estimate Spread: laws, what is stale, error bars.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

EngineSettings spreading(std::uint32_t walks, double photons)
{
  return Shoot(scaled(walks)).spread(photons);
}

/// W/m2 of all cells and sides, with the standard errors.
std::vector<double> allValues(const IrradianceEngine& engine)
{
  std::vector<double> all;
  const ErrorEstimate errors = engine.errorEstimate();
  engine.cells().numbers().forEach([&](const SceneCell& cell) {
    forEachSide(cell, engine.settings().separateSides, [&](const CellSide& side) {
      all.push_back(engine.irradiance(side, 0));
      all.push_back(errors.standardError(side, 0));
    });
  });
  return all;
}

// In a black scene all light is gathered: nothing is blurred, and the error bars are those of the
// sums.
TEST(CellSpread, LeavesGatheredLightWhereItIs)
{
  ObjectBuilder room = plainRoom({ 3, 3, 3 }, 8, grey(0));
  room.addPointLight({ 1, 2, 2.8 }, 20);
  const SceneObjects objects{ room.build(), { ball({ 1.5, 1.5, 1 }, 0.5, 6, grey(0)) } };
  EngineSettings settings = spreading(100000, 1000);
  settings.gathersDirectLight = true;
  settings.separateSides = true;
  settings.replicates = 4;
  const UpdatedEngine spread(objects, settings);
  settings.cellEstimate = CellEstimate::Sums;
  const UpdatedEngine plain(objects, settings);
  const std::vector<double> expected = allValues(plain);
  EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 1);
  const std::vector<double> values = allValues(spread);
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_TRUE(values[i] == expected[i] || std::isnan(expected[i])) << "value " << i;
  }
}

// Indirect light is blurred, and no power is lost.
TEST(CellSpread, ConservesThePowerOfGatheredAndShotLight)
{
  const MovingScene scene(1, true, 77);
  EngineSettings settings = spreading(20000, 300);
  settings.gathersDirectLight = true;
  UpdatedEngine engine(scene.objects(), settings);
  std::size_t blurred = 0, all = 0;
  for (std::uint32_t object = 0; object < scene.objects().size(); ++object)
  {
    const std::size_t cells = engine.cells().numbers().sizeOf(object);
    const double sum = wattsOn(engine, object, 0, cells);
    EXPECT_NEAR(estimatedWattsOn(engine, object, 0), sum, 1e-9 * sum) << "object " << object;
    for (std::size_t cell = 0; cell < cells; ++cell, ++all)
    {
      const double own = engine.watts(engine.sums().sum({ { object, cell } }, 0));
      blurred +=
        std::abs(engine.irradiance({ object, cell }, 0) * engine.cells().area({ object, cell }) -
          own) > 1e-6 * own
        ? 1
        : 0;
    }
  }
  EXPECT_GT(blurred, all / 4) << "large cells keep what they have";
}

// While walks are stale, the stale part is spread like the whole. In the end nothing is stale.
TEST(CellSpread, SpreadsWhatIsStaleAlike)
{
  MovingScene scene(1, true, 76);
  EngineSettings settings = spreading(20000, 200);
  settings.repairTimeBudget = 10 * TickingExecution::kTick;
  IrradianceEngine engine;
  TickingExecution clock;
  engine.update(scene.objects(), settings, clock);
  scene.nextFrame();
  engine.update(scene.objects(), settings, clock);
  int waits = 0;
  for (; onlySet(engine).stale() && !onlySet(engine).stale()->isEmpty(); ++waits)
  {
    for (std::uint32_t object = 0; object < scene.objects().size(); ++object)
    {
      const std::vector<double> areas = cellAreas(scene.objects()[object]);
      double watts = 0, stale = 0;
      for (std::size_t cell = 0; cell < areas.size(); ++cell)
      {
        watts += engine.staleIrradiance({ object, cell }, 0) * areas[cell];
        stale += engine.watts(onlySet(engine).stale()->sums().sum({ object, cell }, 0));
      }
      EXPECT_NEAR(watts, stale, 1e-8 * stale);
    }
    engine.update(scene.objects(), settings, clock);
  }
  EXPECT_GE(waits, 2);
  EXPECT_TRUE(isShownAsFresh(engine));
}

// Walls that receive enough keep their bits, error bars included; only the fine object changes.
TEST(CellSpread, LeavesLargeCellsAlone)
{
  ObjectBuilder room = plainRoom({ 4, 4, 4 }, 3, grey(0.5)), thing;
  room.addPointLight({ 1, 1, 3 }, 10);
  thing.addSphere({ 2.5, 2.5, 1.5 }, 0.6, 16, grey(0.5));
  const SceneObjects objects{ room.build(), { thing.build() } };
  EngineSettings settings = spreading(50000, 100);
  settings.replicates = 4;
  const UpdatedEngine spread(objects, settings);
  settings.cellEstimate = CellEstimate::Sums;
  const UpdatedEngine sums(objects, settings);
  for (std::size_t cell = 0; cell < objects.staticObject.material->numberOfCells; ++cell)
  {
    EXPECT_EQ(spread.irradiance({ 0, cell }, 0), sums.irradiance({ 0, cell }, 0));
    const double error = spread.errorEstimate().standardError({ 0, cell }, 0);
    EXPECT_EQ(error, sums.errorEstimate().standardError({ 0, cell }, 0));
  }
  std::size_t changed = 0, known = 0, knownBySums = 0;
  const std::size_t cells = objects.dynamicObjects[0].material->numberOfCells;
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    changed += spread.irradiance({ 1, cell }, 0) != sums.irradiance({ 1, cell }, 0) ? 1 : 0;
    known += std::isnan(spread.errorEstimate().standardError({ 1, cell }, 0)) ? 0 : 1;
    knownBySums += std::isnan(sums.errorEstimate().standardError({ 1, cell }, 0)) ? 0 : 1;
  }
  EXPECT_GT(changed, cells * 9 / 10);
  EXPECT_GT(known, cells * 9 / 10);
  EXPECT_LT(knownBySums, cells / 10);
}

// The estimate can change without a new walk, with and without something that may move.
TEST(CellSpread, ShootsNothingAnew)
{
  for (const bool isStatic : { false, true })
  {
    SceneObjects objects = MovingScene(1, true, 78).objects();
    objects.dynamicObjects.resize(isStatic ? 0 : objects.dynamicObjects.size());
    EngineSettings settings = spreading(5000, 100);
    settings.replicates = 4;
    UpdatedEngine engine(objects, settings);
    for (const double photons : { 0.0, 100.0, 37.0, 0.0 })
    {
      settings.cellEstimate = photons == 0 ? CellEstimate::Sums : CellEstimate::Spread;
      settings.spreadPhotons = std::max(1.0, photons);
      engine.update(objects, settings);
      EXPECT_EQ(engine.statistics().shootSeconds, 0);
      EXPECT_TRUE(isShownAsFresh(engine));
    }
  }
}

// In a furnace nothing is there to blur, so the intervals hold the truth, 1 W/m2. Cells next to
// each other err alike: of each seed, the many cells of an object are worth some 30. Over 20 seeds,
// the share of intervals that hold the truth is off by 0.04 once in 10^5.
TEST(CellSpread, IntervalsHoldTheTruth)
{
  const SceneObjects objects = furnaceWithBall(92, 20);
  const std::vector<double> areas = cellAreas(objects.dynamicObjects[0]);
  EngineSettings settings = spreading(40000, 150);
  settings.replicates = 16;
  IntervalCount intervals(settings.replicates);
  double squares = 0;
  overSeeds(objects, 20, settings, [&](const IrradianceEngine& engine) {
    const ErrorEstimate errors = engine.errorEstimate();
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      const double off = engine.irradiance({ 1, cell }, 0) - 1,
                   error = engine.watts(errors.standardError({ 1, cell }, 0)) / areas[cell];
      squares += off * off / double(areas.size()) / 20;
      intervals.add(off, error);
    }
  });
  if (!kIsSanitized)
  {
    EXPECT_GE(intervals.shareKnown(), 0.99);
    EXPECT_NEAR(intervals.shareThatHolds(), 0.95, 0.04);
    EXPECT_NEAR(std::sqrt(squares * 150), 1, 0.25) << "the noise of as many photons";
  }
}

}
}
