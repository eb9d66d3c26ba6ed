// SPDX-License-Identifier: BSD-3-Clause
// The engine with the cell estimate Gathered: laws, what is known by closed forms, error bars, what
// it refuses.

#include "DirectRuns.h"
#include "Estimates/FinalGatherEstimator.h"
#include "MovingScene.h"
#include "Progress/InputError.h"
#include "ShownAnswer.h"
#include "ThreadExecution.h"
#include "ThreadRanks.h"
#include "TickingExecution.h"

#include "../RayCasting/TestSimdLevels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <mutex>
#include <tuple>

namespace irradiance
{

namespace
{

using test::box;
using test::furnace;
using test::gathering;
using test::grey;
using test::meansOf;
using test::MovingScene;
using test::ObjectBuilder;
using test::SeedMeans;

/// The number of cells that gather in a frame.
std::size_t numberOfSmall(const IrradianceEngine& engine, const EngineSettings& settings)
{
  const CellRoles roles(
    engine.cells(), settings.numberOfWalks, settings.gatherRays, settings.gathersEverywhere);
  std::size_t count = 0;
  engine.cells().numbers().forEach(
    [&](const SceneCell& cell) { count += roles.gathers(cell) ? 1 : 0; });
  return count;
}

}

// Law 1: all kinds of motion, bands and sides. The threads differ as well.
TEST(FinalGatherEstimator, UpdateEqualsRebuild)
{
  for (const auto& [bands, separatesSides, replicates] :
    { std::tuple(1, false, 1u), std::tuple(3, true, 4u), std::tuple(1, true, 5u) })
  {
    MovingScene scene(bands, bands == 3, 71);
    EngineSettings settings = gathering(20000);
    settings.separateSides = separatesSides;
    settings.replicates = replicates;
    IrradianceEngine engine;
    test::ThreadExecution threads(2);
    for (int frame = 0; frame < (test::kIsSanitized ? 4 : 10); ++frame, scene.nextFrame())
    {
      engine.update(scene.objects(), settings, threads);
      ASSERT_TRUE(test::shownAnswer(engine, scene.objects(), settings) ==
        test::freshShownAnswer(scene.objects(), settings))
        << bands << " bands, " << replicates << " replicates, frame " << frame;
      EXPECT_EQ(engine.statistics().shootSeconds > 0, frame == 0);
    }
    const std::size_t small = numberOfSmall(engine, settings);
    EXPECT_GT(small, 50u);
    EXPECT_LT(small, engine.cells().numbers().size()) << "some are read";
  }
}

// Law 1 where large cells gather too, and are read by the rays of others, or not.
TEST(FinalGatherEstimator, UpdateEqualsRebuildWhoeverGathers)
{
  MovingScene scene(1, true, 72);
  EngineSettings settings = gathering(60000);
  IrradianceEngine engine;
  Execution serial;
  std::size_t fewer = 0;
  for (const bool isEverywhere : { false, true })
  {
    settings.gathersEverywhere = isEverywhere;
    for (int frame = 0; frame < 3; ++frame, scene.nextFrame())
    {
      settings.unbiasedGather = frame == 2;
      engine.update(scene.objects(), settings, serial);
      ASSERT_TRUE(test::shownAnswer(engine, scene.objects(), settings) ==
        test::freshShownAnswer(scene.objects(), settings))
        << isEverywhere << ", frame " << frame;
    }
    const std::size_t count = numberOfSmall(engine, settings);
    EXPECT_GT(count, fewer);
    fewer = count;
  }
}

namespace
{

/// A lit room of four cells a wall, with a lamp and mirrors in part; a ball of many cells.
SceneObjects shinyRoom()
{
  ObjectBuilder room, ball;
  test::Look wall = grey(0.4), shiny = grey(0.3);
  wall.specular = { 0.2 };
  wall.exponent = 20;
  shiny.specular = { 0.5 };
  room.addBox(box({ 0, 0, 0 }, { 4, 3, 4 }), 2, wall, true);
  room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0.1, 5));
  ball.addSphere({ 0, 0, 0 }, 0.5, 8, shiny);
  return { room.build(), { ball.build(test::shift({ 2, 1.5, 1 })) } };
}

}

// Law 2.
TEST(FinalGatherEstimator, IsTheSameForAnyThreadsAndInstructions)
{
  for (const SceneObjects& objects : { MovingScene(3, false, 77).objects(), shinyRoom() })
  {
    EngineSettings settings = gathering(20000);
    settings.replicates = 5;
    const test::Answer expected = test::freshShownAnswer(objects, settings);
    const auto expectSame = [&](Execution& execution) {
      IrradianceEngine engine;
      engine.update(objects, settings, execution);
      EXPECT_TRUE(test::shownAnswer(engine, objects, settings) == expected);
    };
    test::ThreadExecution two(2), five(5);
    test::BackwardExecution backward;
    expectSame(two);
    expectSame(five);
    expectSame(backward);
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      expectSame(two);
    }
  }
}

TEST(FinalGatherEstimator, IsTheSameOnAnyRanks)
{
  MovingScene scene(1, true, 78);
  EngineSettings settings = gathering(20000);
  settings.replicates = 4;
  std::vector<SceneObjects> frames;
  std::vector<test::Answer> expected;
  for (int frame = 0; frame < 3; ++frame, scene.nextFrame())
  {
    frames.push_back(scene.objects());
    expected.push_back(test::freshShownAnswer(frames.back(), settings));
  }
  test::ThreadRanks all(3);
  std::mutex mutex;
  const std::vector<std::string> errors = all.run([&](test::ThreadRanks::Rank& rank) {
    IrradianceEngine engine;
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      engine.update(frames[i], settings, rank);
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_TRUE(test::shownAnswer(engine, frames[i], settings) == expected[i])
        << "rank " << rank.rank() << ", frame " << i;
    }
  });
  EXPECT_EQ(errors, std::vector<std::string>(3));
}

// One radiance everywhere: what rays read has no bias, so each small cell finds 1 W/m2. The ball
// sees itself nowhere, the boxes see each other. A false alarm once in 10^4 for each of 5 x 2
// groups of cells; the means over both, |t| > 5 of 11 degrees, once in 2,500 for each of five.
TEST(FinalGatherEstimator, SmallCellsOfAFurnaceReceiveOneWatt)
{
  for (const auto& [bands, isGlossy] :
    { std::pair(1, false), std::pair(1, true), std::pair(3, true) })
  {
    if (test::kIsSanitized && bands == 1)
    {
      continue; // goes where three bands go
    }
    ObjectBuilder room(bands), ball(bands), boxes(bands);
    room.addBox(box({ 0, 0, 0 }, { 4, 3, 5 }), 2, {}, true);
    ball.addSphere({ 0, 0, 0 }, 0.5, 6, {});
    for (const Vector3& at : { Vector3(0, 0, 0), Vector3(0.5, 0, 0), Vector3(0.25, 0.5, 0) })
    {
      boxes.addBox(box(at, at + Vector3(0.4, 0.4, 0.4)), 2, {});
    }
    const SceneObjects objects{ furnace(room, 0.5, isGlossy),
      { furnace(ball, 0.7, isGlossy, test::shift({ 1, 1.5, 2 })),
        furnace(boxes, 0.8, isGlossy, test::shift({ 2.5, 1, 3 })) } };
    std::vector<SeedMeans> found(static_cast<std::size_t>(bands));
    std::vector<test::ReplicateMean> means(found.size());
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
      const EngineSettings settings = gathering(12000, seed);
      IrradianceEngine engine;
      Execution serial;
      engine.update(objects, settings, serial);
      for (int band = 0; band < bands; ++band)
      {
        const auto i = static_cast<std::size_t>(band);
        found[i].add(engine, band);
        means[i].add(
          (test::estimatedWattsOn(engine, 1, band) + test::estimatedWattsOn(engine, 2, band)) /
          (test::areaOf(engine, 1) + test::areaOf(engine, 2)));
      }
      ASSERT_EQ(numberOfSmall(engine, settings), 72u + 72u);
    }
    for (const SeedMeans& cells : found)
    {
      EXPECT_LT(cells.chiSquareBesideLimit(24, 96, 1), 1) << "ball";
      EXPECT_LT(cells.chiSquareBesideLimit(96, 168, 1), 1) << "boxes";
    }
    for (const test::ReplicateMean& mean : means)
    {
      mean.print(isGlossy ? "glossy furnace, small cells" : "furnace, small cells", 1);
      EXPECT_LT(std::abs(mean.t(1)), 5);
    }
  }
}

// One radiance everywhere, so each ray of each cell, of walls too, reads it: no noise but of the
// sums that are read.
TEST(FinalGatherEstimator, AllCellsOfAFurnaceReceiveOneWatt)
{
  ObjectBuilder room(1), ball(1);
  room.addBox(box({ 0, 0, 0 }, { 4, 3, 5 }), 2, {}, true);
  ball.addSphere({ 0, 0, 0 }, 0.5, 6, {});
  const SceneObjects objects{ furnace(room, 0.5, false),
    { furnace(ball, 0.7, false, test::shift({ 1, 1.5, 2 })) } };
  std::vector<test::ReplicateMean> walls(24);
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    EngineSettings settings = gathering(12000, seed);
    settings.gathersEverywhere = true;
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    for (std::size_t cell = 0; cell < walls.size(); ++cell)
    {
      walls[cell].add(engine.irradiance({ { 0, cell }, 0 }, 0));
    }
  }
  for (const test::ReplicateMean& wall : walls)
  {
    // |t| > 7 of 11 degrees of freedom: once in 40,000 for each of 24.
    EXPECT_LT(std::abs(wall.t(1)), 7) << wall.mean();
    EXPECT_NEAR(wall.mean(), 1, 0.15);
  }
}

namespace
{

/// A room whose walls have n x n cells and a reflectance each, with a lamp below the ceiling, and a
/// ball of 128 small cells: 98 are the walls and the lamp if n is 4.
SceneObjects roomWithBall(int n)
{
  const double reflectances[] = { 0.6, 0.4, 0.7, 0.5, 0.3, 0.8 };
  ObjectBuilder room, ball;
  for (int side = 0; side < 6; ++side)
  {
    room.addSide(box({ 0, 0, 0 }, { 4, 4, 3 }), side, n, grey(reflectances[side]), true);
  }
  room.addQuad({ 1.2, 1.6, 2.9 }, { 0, 0.8, 0 }, { 1.2, 0, 0 }, 1, 1, grey(0, 30));
  ball.addSphere({ 0, 0, 0 }, 0.4, 8, grey(0.5));
  return { room.build(), { ball.build(test::shift({ 2.4, 1.5, 1 })) } };
}

std::size_t firstOfBall(int n)
{
  return static_cast<std::size_t>(6 * n * n + 1);
}

/// Of shot walks, in which nothing is gathered.
SeedMeans shotMeans(
  const SceneObjects& objects, int seeds, std::uint32_t walks, std::uint64_t firstSeed = 1001)
{
  EngineSettings settings;
  settings.numberOfWalks = test::scaled(walks);
  return meansOf(objects, seeds, settings, firstSeed);
}

}

// Nothing is outside of the walls; the lamp is lit on both sides; the ball is closed. Most of the
// area is of large cells, which take four times as many rays if they gather. Direct light takes a
// sample for two rays; or more, up to 64, of cells of which there are few.
TEST(FinalGatherEstimator, SamplesFollowTheRays)
{
  const SceneObjects objects = roomWithBall(4);
  EngineSettings settings = gathering(30000);
  for (const bool isEverywhere : { false, true })
  {
    settings.gathersEverywhere = isEverywhere;
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    EXPECT_EQ(engine.statistics().followedPaths, 32 * (128 + (isEverywhere ? 4 * (96 + 2) : 0)));
    std::vector<std::uint32_t> samples(firstOfBall(4) + 128);
    for (const WalkSet& set : engine.walks().sets())
    {
      set.forEachGathered([&](const DirectGather& light) {
        const DirectPlan& plan = light.light().plan();
        for (std::size_t cell = 0; cell < plan.numberOfCells(); ++cell)
        {
          samples[cell] = std::max(samples[cell], plan.samplesOf(cell));
        }
      });
    }
    // Of 96 walls, and of the upper half of the ball, 30000 / 4 walks are more than 64 each.
    EXPECT_EQ(*std::min_element(samples.begin(), samples.begin() + 96), isEverywhere ? 64u : 16u);
    EXPECT_EQ(*std::max_element(samples.end() - 128, samples.end()), 64u);
  }
}

// Shot walks are unbiased. Differences have the variance n / (n - 2) of Student's t, n = 30; a
// false alarm once in 10^4 if cells are independent, for which a tenth is added, and another for
// the bias of walls of 8 x 8 cells.
TEST(FinalGatherEstimator, SmallCellsAgreeWithShotWalks)
{
  const SceneObjects objects = roomWithBall(8);
  const SeedMeans shot = shotMeans(objects, 16, 500000);
  const SeedMeans gathered = meansOf(objects, 16, gathering(100000));
  const std::size_t first = firstOfBall(8);
  const double count = static_cast<double>(gathered.cells().size() - first);
  ASSERT_EQ(count, 128);
  const double chiSquare = chiSquareOf(shot, gathered, first) * 28 / 30;
  std::printf("chi-square of %.0f cells: %.1f\n", count, chiSquare);
  EXPECT_LT(chiSquare, 1.2 * test::chiSquareLimit(count, 3.72));
  test::ReplicateMean ratio;
  for (std::size_t i = first; i < gathered.cells().size(); ++i)
  {
    ratio.add(gathered.cells()[i].mean() / shot.cells()[i].mean());
  }
  ratio.print("gathered / shot", 1);
  EXPECT_NEAR(ratio.mean(), 1, test::kIsSanitized ? 0.03 : 0.01);
}

namespace
{

/// The mean square difference of the small cells from the truth, in units of their mean: noise has
/// no part, as halves of both are multiplied.
double systematicSquare(const SeedMeans* gathered, const SeedMeans* shot, std::size_t first)
{
  double sum = 0, mean = 0;
  const std::size_t end = gathered[0].cells().size();
  for (std::size_t i = first; i < end; ++i)
  {
    const auto off = [&](int half) {
      return gathered[half].cells()[i].mean() - shot[half].cells()[i].mean();
    };
    sum += off(0) * off(1);
    mean += 0.5 * (shot[0].cells()[i].mean() + shot[1].cells()[i].mean());
  }
  const auto count = static_cast<double>(end - first);
  return sum / count / std::pow(mean / count, 2);
}

/// A box in a room of four cells a wall that sticks through the floor, to its middle.
SceneObjects buriedBox()
{
  ObjectBuilder room, thing;
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 2, grey(0.8), true);
  room.addQuad({ 1, 1, 2.9 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 30));
  thing.addBox(box({ -0.4, -0.4, -0.4 }, { 0.4, 0.4, 0.4 }), 4, grey(0.5));
  return { room.build(), { thing.build(test::shift({ 2.3, 2.2, 0 })) } };
}

}

// Nothing shines below the floor, though its cells, which rays from there would hit, are bright
// above.
TEST(FinalGatherEstimator, NoLightLeaksToWhatIsBuried)
{
  const SceneObjects objects = buriedBox();
  IrradianceEngine engine;
  Execution serial;
  engine.update(objects, gathering(50000), serial);
  const SceneObject& thing = objects.dynamicObjects[0];
  std::size_t dark = 0, lit = 0;
  for (std::uint32_t i = 0; i < thing.body->mesh().size(); ++i)
  {
    const Box bounds = thing.body->mesh()[i].bounds();
    const double found = engine.irradiance({ { 1, thing.material->cellOfTriangle[i] } }, 0);
    if (bounds.upper[2] <= 0)
    {
      EXPECT_EQ(found, 0);
      ++dark;
    }
    else
    {
      EXPECT_GT(found, 0);
      ++lit;
    }
  }
  EXPECT_EQ(dark, 2u * (16 + 4 * 8));
  EXPECT_EQ(lit, dark);
}

// The error bars of small cells. Replicates have sums of their own, so what they share is in no
// error bar but in the bias, which is small beside the noise of 32 rays.
TEST(FinalGatherEstimator, ErrorBarsHoldTheTruth)
{
  const SceneObjects objects = roomWithBall(8);
  const SeedMeans truth = shotMeans(objects, 8, 1000000);
  EngineSettings settings = gathering(100000);
  settings.replicates = 16;
  settings.verify = false;
  const double factor = ErrorEstimate::confidenceFactor(16);
  std::size_t known = 0, held = 0, all = 0;
  double squares = 0; // of differences, in standard errors
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    settings.seed = seed;
    IrradianceEngine engine;
    test::ThreadExecution two(2);
    engine.update(objects, settings, two);
    const ErrorEstimate errors = engine.errorEstimate();
    for (std::size_t cell = 0; cell < 128; ++cell, ++all)
    {
      const CellSide side{ { 1, cell } };
      const double error = engine.watts(errors.standardError(side, 0)) / engine.cells().area(side);
      if (!std::isnan(error))
      {
        const test::ReplicateMean& right = truth.cells()[firstOfBall(8) + cell];
        const double off = engine.irradiance(side, 0) - right.mean();
        ++known;
        squares += off * off / (error * error);
        // The noise of the truth counts as well.
        held += std::abs(off) <= factor * std::hypot(error, right.standardError()) ? 1 : 0;
      }
    }
  }
  const double share = double(held) / double(known);
  const double wide = std::sqrt(double(known) / squares);
  std::printf(
    "%zu of %zu intervals known, %.1f %% hold the truth; errors are %.2f of those claimed\n", known,
    all, 100 * share, 1 / wide);
  EXPECT_EQ(known, all);
  EXPECT_GT(share, 0.93);
  EXPECT_LT(wide, 2);
}

// Where few walks make what rays read the main noise: replicates that shared it would claim too
// little. In a furnace nothing is biased; each seed counts as one, as its cells have much of the
// noise in common.
TEST(FinalGatherEstimator, ErrorBarsKnowTheNoiseOfWhatIsRead)
{
  ObjectBuilder room, ball;
  room.addBox(box({ 0, 0, 0 }, { 8, 8, 8 }), 3, {}, true);
  ball.addSphere({ 0, 0, 0 }, 0.5, 4, {});
  const SceneObjects objects{ furnace(room, 0.8, false),
    { furnace(ball, 0.5, false, test::shift({ 4, 4, 4 })) } };
  EngineSettings settings = gathering(4000);
  settings.replicates = 16;
  settings.verify = false;
  double squares = 0; // of differences, in standard errors
  constexpr int kSeeds = 40, kCells = 32;
  for (settings.seed = 1; settings.seed <= kSeeds; ++settings.seed)
  {
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    const ErrorEstimate errors = engine.errorEstimate();
    for (std::size_t cell = 0; cell < kCells; ++cell)
    {
      const CellSide side{ { 1, cell } };
      const double error = engine.watts(errors.standardError(side, 0)) / engine.cells().area(side);
      squares += std::pow((engine.irradiance(side, 0) - 1) / error, 2) / (kSeeds * kCells);
    }
  }
  std::printf("errors are %.2f of those claimed\n", std::sqrt(squares));
  // Squares of Student's t of 15 degrees have the mean 15 / 13, and the variance 3.3: of 40, off by
  // 4 standard errors once in 10^4 or so.
  EXPECT_LT(squares, 15.0 / 13 + 4 * std::sqrt(3.3 / kSeeds));
  EXPECT_GT(squares, 0.25) << "nor much too wide";
}

namespace
{

/// A wide room with a lamp over the floor, so that a spot of light is smaller than large cells are,
/// and a ball of 32 cells that hangs farther from all walls than their cells are wide.
SceneObjects roomWithSpot(int n)
{
  ObjectBuilder room, ball;
  room.addBox(box({ 0, 0, 0 }, { 8, 8, 8 }), n, grey(0.6), true);
  room.addQuad({ 4.7, 2.7, 1 }, { 0, 0.6, 0 }, { 0.6, 0, 0 }, 1, 1, grey(0, 30));
  ball.addSphere({ 0, 0, 0 }, 0.7, 4, grey(0.5));
  return { room.build(), { ball.build(test::shift({ 3.7, 4.9, 3.5 })) } };
}

}

// The spot is smaller than the large cells: 5 % off with those that are read as a whole; the lights
// are asked in these.
TEST(FinalGatherEstimator, HasNoBiasBySmallSpots)
{
  std::vector<double> biases;
  for (const int n : { 4, 12 })
  {
    const SceneObjects objects = roomWithSpot(n);
    EngineSettings settings = gathering(test::scaled(200000));
    settings.gatherRays = test::scaled(1024);
    SeedMeans gathered[2], shot[2];
    for (int half = 0; half < 2; ++half)
    {
      const auto seed = static_cast<std::uint64_t>(4 * half);
      gathered[half] = meansOf(objects, 2, settings, 1 + seed);
      shot[half] = shotMeans(objects, 3, 400000, 1001 + seed);
    }
    const double square = systematicSquare(gathered, shot, firstOfBall(n));
    const double bias = std::copysign(std::sqrt(std::abs(square)), square);
    std::printf("%d cells along a wall: systematic RMS %.4f of the mean\n", n, bias);
    biases.push_back(bias);
  }
  if (!test::kIsSanitized) // with so few walks noise hides it
  {
    EXPECT_LT(std::abs(biases[0]), 0.02);
    EXPECT_LT(std::abs(biases[1]), 0.02);
  }
}

// Law 1 where parts leave and come back: cells are known by their number among those that gather.
TEST(FinalGatherEstimator, UpdateEqualsRebuildWhilePartsComeAndGo)
{
  MovingScene scene(1, true, 79);
  test::RandomVectors random(79);
  EngineSettings settings = gathering(10000);
  settings.replicates = 3;
  IrradianceEngine engine;
  Execution serial;
  for (int frame = 0; frame < 8; ++frame, scene.nextFrame())
  {
    SceneObjects objects = scene.objects();
    for (SceneObject& object : objects.dynamicObjects)
    {
      object.isPresent = random.engine() % 3 != 0;
    }
    settings.separateSides = frame % 4 == 3;
    settings.gatherRays = frame < 4 ? 32 : 7; // samples of direct light follow them
    engine.update(objects, settings, serial);
    ASSERT_TRUE(
      test::shownAnswer(engine, objects, settings) == test::freshShownAnswer(objects, settings))
      << "frame " << frame;
    EXPECT_EQ(engine.statistics().shootSeconds > 0, frame % 4 == 0);
  }
}

// What rests on stale walks is a part of the whole, the full update takes no more than that away,
// and in the end nothing is stale.
TEST(FinalGatherEstimator, KnowsWhatIsStale)
{
  MovingScene scene(1, true, 76);
  EngineSettings settings = gathering(20000);
  settings.repairTimeBudget = 40 * test::TickingExecution::kTick;
  EngineSettings full = settings;
  full.repairTimeBudget = 0;
  IrradianceEngine engine, exact;
  test::TickingExecution clock;
  engine.update(scene.objects(), settings, clock);
  scene.nextFrame();
  engine.update(scene.objects(), settings, clock);
  exact.update(scene.objects(), full, clock);
  int waits = 0, stale = 0;
  for (; engine.walks().hasStale(); ++waits)
  {
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      const double all = engine.irradiance({ cell }, 0), part = engine.staleIrradiance({ cell }, 0);
      EXPECT_GE(part, 0);
      EXPECT_LE(part, all);
      EXPECT_GE(exact.irradiance({ cell }, 0), (all - part) * (1 - 1e-9));
      stale += part > 0 ? 1 : 0;
    });
    engine.update(scene.objects(), settings, clock);
  }
  EXPECT_GE(waits, 2);
  EXPECT_GT(stale, 100);
  EXPECT_TRUE(test::shownAnswer(engine, scene.objects(), settings) ==
    test::freshShownAnswer(scene.objects(), settings));
}

// A lamp close over the floor, tilted to it: its walks start at it and bring the direct light with
// all other. Small cells have to get its direct light once; in a black room it is all there is.
// Limits as above.
TEST(FinalGatherEstimator, SmallCellsGatherTheLightOfANearLamp)
{
  ObjectBuilder room, ball;
  room.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 4, grey(0), true);
  room.addQuad({ 0.5, 1.2, 0.04 }, { 0, 1.6, 0 }, { 0.08, 0, 0.08 }, 1, 1, grey(0, 100));
  ball.addSphere({ 0, 0, 0 }, 0.6, 6, grey(0));
  const SceneObjects objects{ room.build(), { ball.build(test::shift({ 1.9, 2, 0.5 })) } };
  const std::size_t first = 6 * 16 + 1;
  EngineSettings settings = gathering(60000);
  {
    IrradianceEngine engine;
    Execution serial;
    engine.update(objects, settings, serial);
    ASSERT_EQ(numberOfSmall(engine, settings), 72u) << "the ball";
    ASSERT_FALSE(engine.walks().sets().front().source().cells) << "walks start at the lamp";
  }
  const SeedMeans shot = shotMeans(objects, 16, 300000);
  const SeedMeans gathered = meansOf(objects, 16, settings);
  double chiSquare = 0, all = 0, found = 0, count = 0;
  for (std::size_t i = first; i < gathered.cells().size(); ++i)
  {
    const test::ReplicateMean &x = gathered.cells()[i], &y = shot.cells()[i];
    all += y.mean();
    found += x.mean();
    if (y.mean() > 10 * y.standardError()) // else too few photons tell
    {
      chiSquare += std::pow(x.mean() - y.mean(), 2) /
        (std::pow(x.standardError(), 2) + std::pow(y.standardError(), 2));
      ++count;
    }
  }
  std::printf("chi-square of %.0f cells: %.1f; %.4f of the light\n", count, chiSquare, found / all);
  EXPECT_GT(count, test::kIsSanitized ? 10 : 20);
  EXPECT_LT(chiSquare * 28 / 30, 1.1 * test::chiSquareLimit(count, 3.72));
  EXPECT_NEAR(found / all, 1, test::kIsSanitized ? 0.05 : 0.01);
}

TEST(FinalGatherEstimator, IsRefusedWhereItCannotBeRight)
{
  EngineSettings settings = gathering(1000);
  EXPECT_EQ(conflictOf(settings, settings), "");
  settings.gathersDirectLight = false;
  EXPECT_EQ(
    conflictOf(settings, settings).find("CellEstimate Gathered needs DirectLight Gathered"), 0u);
  // A path meets no point, so a mirror would not show it.
  MovingScene glossy(1, true, 5, true);
  IrradianceEngine engine;
  Execution serial;
  EXPECT_THROW(engine.update(glossy.objects(), gathering(1000), serial), InputError);
  const MovingScene matte(1, true, 5);
  engine.update(matte.objects(), gathering(1000), serial);
  EXPECT_TRUE(engine.isValid());
  // Before anything is shot: what was known stays.
  const std::uint64_t state = engine.state();
  EXPECT_THROW(engine.update(glossy.objects(), gathering(1000), serial), InputError);
  EXPECT_TRUE(engine.isValid());
  EXPECT_EQ(engine.state(), state);
}

}
