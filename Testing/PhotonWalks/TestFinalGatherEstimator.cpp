// SPDX-License-Identifier: BSD-3-Clause
// The engine with the cell estimate Gathered: laws, what is known by closed forms, error bars, what
// it refuses.

#include "Estimates/FinalGatherEstimator.h"
#include "Kit.h"
#include "Progress/InputError.h"

namespace irradiance::test
{
namespace
{

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

/// A lit room with n x n cells a wall, and a ball of 128 small cells: 98 are the walls and the lamp
/// if n is 4.
SceneObjects roomWithBall(int n)
{
  return { litRoom(n).build(), { ball({ 2.4, 1.5, 1 }, 0.4, 8) } };
}

std::size_t firstOfBall(int n)
{
  return static_cast<std::size_t>(6 * n * n + 1);
}

/// Of shot walks, in which nothing is gathered.
SeedMeans shotMeans(
  const SceneObjects& objects, int seeds, std::uint32_t walks, std::uint64_t firstSeed = 1001)
{
  return meansOf(objects, seeds, Shoot(scaled(walks)), firstSeed);
}

// Nothing is outside of the walls; the lamp is lit on both sides; the ball is closed. Most of the
// area is of large cells, which take four times as many rays if they gather.
TEST(FinalGatherEstimator, SamplesFollowTheRays)
{
  const SceneObjects objects = roomWithBall(4);
  EngineSettings settings = gathering(30000);
  for (const bool isEverywhere : { false, true })
  {
    settings.gathersEverywhere = isEverywhere;
    UpdatedEngine engine(objects, settings);
    EXPECT_EQ(engine.statistics().followedPaths, 32 * (128 + (isEverywhere ? 4 * (96 + 2) : 0)));
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
  EXPECT_LT(chiSquare, 1.2 * chiSquareLimit(count, 3.72));
  ReplicateMean ratio;
  for (std::size_t i = first; i < gathered.cells().size(); ++i)
  {
    ratio.add(gathered.cells()[i].mean() / shot.cells()[i].mean());
  }
  EXPECT_NEAR(ratio.mean(), 1, kIsSanitized ? 0.03 : 0.01);
}

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
  ObjectBuilder room = plainRoom({ 4, 4, 3 }, 2, grey(0.8));
  addPanel(room, { 1, 1, 2.9 }, 1, 1, 30);
  return { room.build(), { block({ 2.3, 2.2, 0 }, { 0.4, 0.4, 0.4 }, 4) } };
}

// Nothing shines below the floor, though its cells, which rays from there would hit, are bright
// above.
TEST(FinalGatherEstimator, NoLightLeaksToWhatIsBuried)
{
  const SceneObjects objects = buriedBox();
  UpdatedEngine engine(objects, gathering(50000));
  const SceneObject& thing = objects.dynamicObjects[0];
  std::size_t dark = 0, lit = 0;
  for (std::uint32_t i = 0; i < thing.body->mesh().size(); ++i)
  {
    const Box bounds = thing.body->mesh()[i].bounds();
    const double found = engine.irradiance({ { 1, thing.material->cellOfTriangle[i] } }, 0);
    EXPECT_EQ(found > 0, bounds.upper[2] > 0);
    ++(bounds.upper[2] <= 0 ? dark : lit);
  }
  EXPECT_EQ(dark, 2u * (16 + 4 * 8));
  EXPECT_EQ(lit, dark);
}

// Where few walks make what rays read the main noise: replicates that shared it would claim too
// little. In a furnace nothing is biased; each seed counts as one, as its cells have much of the
// noise in common.
TEST(FinalGatherEstimator, ErrorBarsKnowTheNoiseOfWhatIsRead)
{
  ObjectBuilder thing;
  thing.addSphere({ 0, 0, 0 }, 0.5, 4, {});
  const SceneObjects objects{ furnace(plainRoom({ 8, 8, 8 }, 3, {}), 0.8),
    { furnace(thing, 0.5, shift({ 4, 4, 4 })) } };
  EngineSettings settings = gathering(4000);
  settings.replicates = 16;
  double squares = 0; // of differences, in standard errors
  constexpr int kSeeds = 40, kCells = 32;
  overSeeds(objects, kSeeds, settings, [&](const IrradianceEngine& engine) {
    const ErrorEstimate errors = engine.errorEstimate();
    for (std::size_t cell = 0; cell < kCells; ++cell)
    {
      const CellSide side{ { 1, cell } };
      const double error = engine.watts(errors.standardError(side, 0)) / engine.cells().area(side);
      squares += std::pow((engine.irradiance(side, 0) - 1) / error, 2) / (kSeeds * kCells);
    }
  });
  // Squares of Student's t of 15 degrees have the mean 15 / 13, and the variance 3.3: of 40, off by
  // 4 standard errors once in 10^4 or so.
  EXPECT_LT(squares, 15.0 / 13 + 4 * std::sqrt(3.3 / kSeeds));
  EXPECT_GT(squares, 0.25) << "nor much too wide";
}

// The spot is smaller than the large cells: 5 % off with those that are read as a whole; the lights
// are asked in these.
TEST(FinalGatherEstimator, HasNoBiasBySmallSpots)
{
  for (const int n : { 4, 12 })
  {
    const SceneObjects objects = spotRoom(n);
    EngineSettings settings = gathering(scaled(200000));
    settings.gatherRays = scaled(1024);
    SeedMeans gathered[2], shot[2];
    for (int half = 0; half < 2; ++half)
    {
      const auto seed = static_cast<std::uint64_t>(4 * half);
      gathered[half] = meansOf(objects, 2, settings, 1 + seed);
      shot[half] = shotMeans(objects, 3, 400000, 1001 + seed);
    }
    const double bias = std::sqrt(std::abs(systematicSquare(gathered, shot, firstOfBall(n))));
    EXPECT_TRUE(kIsSanitized || bias < 0.02) << bias; // of few walks noise hides it
  }
}

// A lamp close over the floor, tilted to it: its walks start at it and bring the direct light with
// all other. Small cells have to get its direct light once; in a black room it is all there is.
// Limits as above.
TEST(FinalGatherEstimator, SmallCellsGatherTheLightOfANearLamp)
{
  ObjectBuilder room = plainRoom({ 4, 4, 3 }, 4, grey(0));
  room.addQuad({ 0.5, 1.2, 0.04 }, { 0, 1.6, 0 }, { 0.08, 0, 0.08 }, 1, 1, grey(0, 100));
  const SceneObjects objects{ room.build(), { ball({ 1.9, 2, 0.5 }, 0.6, 6, grey(0)) } };
  const std::size_t first = 6 * 16 + 1;
  EngineSettings settings = gathering(60000);
  {
    UpdatedEngine engine(objects, settings);
    ASSERT_EQ(numberOfSmall(engine, settings), 72u) << "the ball";
    ASSERT_FALSE(engine.walks().sets().front().source().cells) << "walks start at the lamp";
  }
  const SeedMeans shot = shotMeans(objects, 16, 300000);
  const SeedMeans gathered = meansOf(objects, 16, settings);
  double chiSquare = 0, all = 0, found = 0, count = 0;
  for (std::size_t i = first; i < gathered.cells().size(); ++i)
  {
    const ReplicateMean &x = gathered.cells()[i], &y = shot.cells()[i];
    all += y.mean();
    found += x.mean();
    if (y.mean() > 10 * y.standardError()) // else too few photons tell
    {
      chiSquare += std::pow(x.mean() - y.mean(), 2) /
        (std::pow(x.standardError(), 2) + std::pow(y.standardError(), 2));
      ++count;
    }
  }
  EXPECT_GT(count, kIsSanitized ? 10 : 20);
  EXPECT_LT(chiSquare * 28 / 30, 1.1 * chiSquareLimit(count, 3.72));
  EXPECT_NEAR(found / all, 1, kIsSanitized ? 0.05 : 0.01);
}

TEST(FinalGatherEstimator, IsRefusedWhereItCannotBeRight)
{
  EngineSettings settings = gathering(1000);
  EXPECT_EQ(conflictOf(settings, settings), "");
  settings.gathersDirectLight = false;
  EXPECT_EQ(
    conflictOf(settings, settings).find("CellEstimate Gathered needs DirectLight Gathered"), 0u);
  // A path meets no point, so a mirror would not show it.
  const MovingScene glossy(1, true, 5, true), matte(1, true, 5);
  UpdatedEngine engine;
  EXPECT_THROW(engine.update(glossy.objects(), gathering(1000)), InputError);
  engine.update(matte.objects(), gathering(1000));
  EXPECT_TRUE(engine.isValid());
  // Before anything is shot: what was known stays.
  const std::uint64_t state = engine.state();
  EXPECT_THROW(engine.update(glossy.objects(), gathering(1000)), InputError);
  EXPECT_TRUE(engine.isValid());
  EXPECT_EQ(engine.state(), state);
}

}
}
