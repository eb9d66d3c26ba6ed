// SPDX-License-Identifier: BSD-3-Clause
// Sums of cells, spread over the cells around them: what is conserved, and what it depends on.

#include "Estimates/CellSpread.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// Sums with something at random in each part, `times` 2^30 or so, and in no few cells nothing.
CellSums randomSums(
  const SceneObjects& objects, const WalkPlan& plan, unsigned seed, std::int64_t times = 1)
{
  RandomVectors random(seed);
  CellSums sums(objects, plan);
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    sums.set(side, band, k,
      times * static_cast<std::int64_t>(random.engine() % 3 * (random.engine() % (1u << 30))));
  });
  return sums;
}

/// The sums of all cells of an object, by band and replicate.
std::map<std::pair<int, std::uint32_t>, std::int64_t> totals(
  const CellSums& sums, std::uint32_t object)
{
  std::map<std::pair<int, std::uint32_t>, std::int64_t> totals;
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    totals[{ band, k }] += side.object == object ? sums.shot(side, band, k, 1) : 0;
  });
  return totals;
}

/// All sums of the first round.
std::vector<double> valuesOf(const CellSums& sums)
{
  std::vector<double> values;
  forEachSum(sums, [&](const CellSide& side, int band, std::uint32_t k, std::size_t) {
    values.push_back(sums.sum(side, band, k, 1));
  });
  return values;
}

constexpr double kPhoton = 1 << 24; // quanta

/// On the average of its object, a cell draws on `photons` photons.
CellSums spreadOf(const SceneObjects& objects, const CellSums& sums, double photons, int sides = 1)
{
  Execution execution;
  CellSpread spread(sides);
  spread.update(objects, sums, 1, photons, kPhoton, execution);
  return spread.spread(objects, sums, 1, execution);
}

/// A sheet of fine cells, one with fewer, and a body.
SceneObjects someObjects(int bands = 1)
{
  ObjectBuilder sheet(bands), coarse(bands), body(bands);
  sheet.addQuad({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 20, 10, grey(0.5));
  coarse.addQuad({ 2, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 5, 10, grey(0.5));
  body.addSphere({ 0, 0, 2 }, 0.5, 10, grey(0.5));
  return { sheet.build(), { coarse.build(), body.build() } };
}

// Also where there are more quanta than a double can count.
TEST(CellSpread, ConservesThePowerOfEachObjectBandAndReplicate)
{
  for (const int sides : { 1, 2 })
  {
    for (const std::int64_t times : { 1, (1 << 18) - 1 })
    {
      const SceneObjects objects = someObjects(3);
      const CellSums sums = randomSums(objects, WalkPlan(1000, 1000, 4), 5, times);
      const CellSums spread = spreadOf(objects, sums, 5000.0 * double(times), sides);
      EXPECT_NE(valuesOf(sums), valuesOf(spread));
      const std::vector<double> values = valuesOf(spread);
      EXPECT_GE(*std::min_element(values.begin(), values.end()), 0);
      for (std::uint32_t object = 0; object < objects.size(); ++object)
      {
        EXPECT_EQ(totals(sums, object), totals(spread, object));
      }
    }
  }
}

// Two halves of a room, one lit, that meet at a crease, at a gap, or as two objects: no quantum
// goes to the other. In a plane it does.
TEST(CellSpread, DoesNotLeak)
{
  enum class Border
  {
    None,
    Crease,
    Gap,
    Object
  };
  for (const Border border : { Border::None, Border::Crease, Border::Gap, Border::Object })
  {
    ObjectBuilder lit, dark;
    lit.addQuad({ -1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 10, 10, grey(0.5));
    const auto addDark = [&](ObjectBuilder& builder) {
      builder.addQuad({ border == Border::Gap ? 1e-9 : 0, 0, 0 },
        border == Border::Crease ? Vector3(0, 0, 1) : Vector3(1, 0, 0), { 0, 1, 0 }, 10, 10,
        grey(0.5));
    };
    addDark(border == Border::Object ? dark : lit);
    const SceneObjects objects{ lit.build(), { dark.build() } };
    CellSums sums(objects, WalkPlan(1000, 1000, 1));
    for (std::size_t cell = 0; cell < 100; ++cell)
    {
      sums.set({ 0, cell, 0 }, 0, 0, cell % 7 == 0 ? 1 << 30 : 0);
    }
    const CellSums spread = spreadOf(objects, sums, 2000);
    double onDark = 0;
    for (std::size_t cell = 0; cell < 100; ++cell)
    {
      onDark +=
        border == Border::Object ? spread.sum({ 1, cell }, 0) : spread.sum({ 0, 100 + cell }, 0);
      EXPECT_GT(spread.sum({ 0, cell }, 0), 0);
    }
    EXPECT_EQ(onDark > 0, border == Border::None);
  }
}

// The same cells in another order, under other numbers.
TEST(CellSpread, DoesNotDependOnTheOrderOfCells)
{
  RandomVectors random(4);
  const SceneObject sphere = ball({ 0, 0, 0 }, 1, 12);
  const std::size_t cells = sphere.material->numberOfCells;
  std::vector<std::uint32_t> order(cells);
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), random.engine);
  ObjectBuilder builder;
  for (const std::uint32_t cell : order)
  {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < sphere.body->mesh().size(); ++i)
    {
      if (sphere.material->cellOfTriangle[i] == cell)
      {
        triangles.push_back(sphere.body->mesh()[i]);
      }
    }
    builder.addCell(triangles, grey(0.5));
  }
  const SceneObjects objects{ nothing(), { sphere } }, shuffled{ nothing(), { builder.build() } };
  const WalkPlan plan(1000, 1000, 1);
  const CellSums sums = randomSums(objects, plan, 6);
  CellSums other(shuffled, plan);
  for (std::size_t i = 0; i < cells; ++i)
  {
    other.set({ 1, i, 0 }, 0, 0, sums.shot({ { 1, order[i] } }, 0, 1));
  }
  const CellSums spread = spreadOf(objects, sums, 1000),
                 otherSpread = spreadOf(shuffled, other, 1000);
  for (std::size_t i = 0; i < cells; ++i)
  {
    EXPECT_EQ(otherSpread.sum({ 1, i }, 0), spread.sum({ 1, order[i] }, 0));
  }
}

// Rigid motion and mirrors change nothing, to the bit; nor do powers of two. A shear does, as other
// cells come closer.
TEST(CellSpread, IsThatOfTheShape)
{
  RandomVectors random(8);
  const Matrix3 shear = (Matrix3() << 1, 2.5, 0, 0, 1, 0, 0, 0, 0.7).finished();
  const auto valuesWith = [](const Matrix3& linear, const Vector3& translation) {
    SceneObjects objects = someObjects();
    for (SceneObject& object : objects.dynamicObjects)
    {
      object.worldFromObject = { linear, translation };
    }
    const CellSums sums = randomSums(objects, WalkPlan(1000, 1000, 2), 9);
    return valuesOf(spreadOf(objects, sums, 3000, 2));
  };
  for (const Matrix3& shape : { Matrix3(Matrix3::Identity()), Matrix3(1.3 * shear), shear })
  {
    const auto expected = valuesWith(shape, { 0, 0, 0 });
    for (int i = 0; i < 10; ++i)
    {
      Matrix3 rotation = random.rotation();
      rotation.row(0) *= i % 3 == 0 ? -1 : 1;
      EXPECT_EQ(valuesWith(rotation * shape, random.inCube()), expected);
      EXPECT_EQ(valuesWith(std::ldexp(1.0, i - 5) * shape, random.inCube()), expected);
    }
  }
  EXPECT_NE(valuesWith(shear, { 0, 0, 0 }), valuesWith(Matrix3::Identity(), { 0, 0, 0 }));
}

// Of unit variance per area, by brute force: the sum of W_ik^2 A_k / A_i over all k.
TEST(CellSpread, KnowsThePartOfAPhotonThatACellTakes)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 8, 8, grey(0.5));
  builder.addQuad({ 1, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 4, 8, grey(0.5));
  builder.addQuad({ 9, 0, 0 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, 1, 1, grey(0.5)); // alone
  builder.addQuad({ 11, 0, 0 }, { 5, 0, 0 }, { 0, 1, 0 }, 2, 1, grey(0.5));    // large
  const SceneObjects objects{ builder.build(), {} };
  const std::vector<double> areas = cellAreas(objects.staticObject);
  const WalkPlan plan(1000, 1000, 2);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double photons = 0.5 / area; // of one photon in all: the width is 0.5 m2
  std::vector<double> shares(areas.size(), 0.0);
  for (std::size_t k = 0; k < areas.size(); ++k)
  {
    CellSums sums(objects, plan);
    sums.set({ 0, k, 0 }, 0, 0, std::int64_t{ 1 } << 24); // a photon
    const CellSums spread = spreadOf(objects, sums, photons);
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
      const double w = double(spread.sum({ 0, i }, 0)) / kPhoton;
      shares[i] += w * w * areas[k] / areas[i];
    }
  }
  CellSums sums(objects, plan);
  sums.set({ 0, 0, 0 }, 0, 0, std::int64_t{ 1 } << 24);
  CellSpread spread(1);
  Execution execution;
  spread.update(objects, sums, 1, photons, kPhoton, execution);
  double ratio = 0;
  const std::size_t small = 64 + 32;
  for (std::size_t i = 0; i < small; ++i)
  {
    EXPECT_LT(shares[i], 0.5);
    EXPECT_NEAR(spread.photonShare({ 0, i }) / shares[i], 1, 1.4) << "4 standard errors";
    ratio += spread.photonShare({ 0, i }) / shares[i] / double(small);
  }
  EXPECT_NEAR(ratio, 1, 0.25) << "some ten independent parts";
  for (std::size_t i = small; i < areas.size(); ++i)
  {
    EXPECT_EQ(spread.photonShare({ 0, i }), 1);
    EXPECT_NEAR(shares[i], 1, 1e-12);
  }
}

// The engine with the cell estimate Spread: laws, what is stale, error bars.

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
