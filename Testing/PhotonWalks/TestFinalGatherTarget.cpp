// SPDX-License-Identifier: BSD-3-Clause
// A target where cells gather: more walks, or more rays, whichever is missing.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// A lit room of 96 wall cells, with a ball of small cells that may move, and a block that stands
/// still.
SceneObjects roomWithBall()
{
  return { litRoom(4).build(),
    { ball({ 2.4, 1.5, 1 }, 0.4, 4), block({ 0.5, 0.5, 0.2 }, { 0.2, 0.2, 0.2 }, 1) } };
}

/// All cells gather, unless it is changed.
EngineSettings towards(double target, std::uint32_t walks, std::uint32_t rays)
{
  return Shoot(walks).finalGather(rays).everywhere().errors(8).target(target, 16 * walks);
}

std::vector<double> irradiances(const IrradianceEngine& engine)
{
  std::vector<double> found;
  engine.cells().numbers().forEach(
    [&](const SceneCell& cell) { found.push_back(engine.irradiance({ cell }, 0)); });
  return found;
}

/// What far more walks and rays find, the mean of two seeds.
std::vector<double> longRun(const SceneObjects& objects)
{
  EngineSettings settings = towards(0, 60000, 256);
  settings.replicates = 1;
  const SeedMeans means = meansOf(objects, 2, settings, 1001);
  std::vector<double> found;
  for (const ReplicateMean& cell : means.cells())
  {
    found.push_back(cell.mean());
  }
  return found;
}

/// Notes whether progress ever went back.
class WatchedExecution : public Execution
{
public:
  bool reportProgress(double progress) override
  {
    isMonotone = isMonotone && progress >= last_ && progress <= 1;
    last_ = progress;
    ++reports;
    return true;
  }

  bool isMonotone = true;
  int reports = 0;

private:
  double last_ = 0;
};

// No walks are left, so rays do it. The truth lies within the target on more than 95 % of the area.
// Where errors are those that are stated, some 1 % of the area is farther off, as most cells are
// better known than the worst of those that count; that 5 % are is less likely than 1e-8 with 300
// independent cells.
TEST(FinalGatherTarget, RaysReachItWhereWalksAreCapped)
{
  const SceneObjects objects = roomWithBall();
  const std::vector<double> truth = longRun(objects);
  double within = 0, all = 0;
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    EngineSettings settings = towards(0.1, 20000, 32);
    settings.maximumNumberOfWalks = settings.numberOfWalks;
    settings.seed = seed;
    IrradianceEngine engine;
    WatchedExecution execution;
    engine.update(objects, settings, execution);
    EXPECT_EQ(engine.numberOfWalks(), settings.numberOfWalks);
    EXPECT_GT(engine.numberOfGatherRays(), settings.gatherRays);
    EXPECT_LT(engine.numberOfGatherRays(), settings.maximumGatherRays);
    EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
    EXPECT_TRUE(execution.isMonotone);
    EXPECT_GT(execution.reports, 10);
    std::size_t i = 0;
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      const double area = engine.cells().area(cell), found = engine.irradiance({ cell }, 0);
      within += std::abs(found - truth[i++]) <= settings.targetRelativeError * found ? area : 0;
      all += area;
    });
  }
  EXPECT_GT(within, 0.95 * all);
}

// Few rays that read what many walks brought; many rays that read what few did; cells that cast no
// rays at all.
TEST(FinalGatherTarget, DoublesWhatIsMissing)
{
  const SceneObjects objects = roomWithBall();
  const auto reach = [&](const EngineSettings& settings, UpdatedEngine& engine) {
    engine.update(objects, settings);
    EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
  };
  UpdatedEngine fewRays, fewWalks, ownSums;
  reach(towards(0.12, 80000, 8), fewRays);
  EXPECT_EQ(fewRays.numberOfWalks(), 80000u);
  EXPECT_GE(fewRays.numberOfGatherRays(), 32u);
  reach(towards(0.07, 1000, 512), fewWalks);
  EXPECT_GE(fewWalks.numberOfWalks(), 8000u);
  EXPECT_LE(fewWalks.numberOfGatherRays(), 1024u);
  EngineSettings settings = towards(0.12, 20000, 64);
  settings.gathersEverywhere = false;
  reach(settings, ownSums);
  EXPECT_GE(ownSums.numberOfWalks(), 40000u);
  EXPECT_EQ(ownSums.numberOfGatherRays(), 64u);
}

// Walls that do not gather miss the target, and no walks are left: no rays of the few others would
// help.
TEST(FinalGatherTarget, CastsNoRaysInVain)
{
  EngineSettings settings = towards(0.01, 20000, 16);
  settings.gathersEverywhere = false;
  settings.maximumNumberOfWalks = 40000;
  UpdatedEngine engine(roomWithBall(), settings);
  EXPECT_EQ(engine.numberOfWalks(), 40000u);
  EXPECT_LE(engine.numberOfGatherRays(), 64u);
  EXPECT_GT(engine.reachedRelativeError(), 0.01);
}

TEST(FinalGatherTarget, ThatIsMetAtOnceChangesNoBit)
{
  const SceneObjects objects = roomWithBall();
  EngineSettings settings = towards(1, 20000, 16);
  settings.maximumNumberOfWalks = settings.numberOfWalks; // with which photons start
  const UpdatedEngine with(objects, settings);
  settings.targetRelativeError = 0;
  const UpdatedEngine without(objects, settings);
  EXPECT_EQ(irradiances(with), irradiances(without));
  // But for the noise of cells, which a target needs.
  const auto bytes = [](const IrradianceEngine& engine) {
    return static_cast<double>(engine.statistics().historyBytes);
  };
  EXPECT_NEAR(bytes(with) / bytes(without), 1, 0.01);
}

// Rounds of rays outlast motions and rounds of walks, until no frame needs them.
TEST(FinalGatherTarget, KeepsThePathsOfAllRounds)
{
  SceneObjects objects = roomWithBall();
  EngineSettings settings = towards(0.1, 20000, 16);
  UpdatedEngine engine(objects, settings);
  const std::int64_t all = engine.statistics().followedPaths;
  const auto rays = static_cast<std::int64_t>(engine.numberOfGatherRays());
  EXPECT_GE(rays, 64);
  EXPECT_GT(engine.numberOfWalks(), settings.numberOfWalks);
  // Each path once, though there were estimates of fewer walks. Large cells, those of the block
  // too, take four times as many; inner sides are lit by nothing, nor is what stands on the floor,
  // but the lamp has two sides.
  const CellNumbers& cells = engine.cells().numbers();
  const std::size_t large = cells.sizeOf(0) + 1 + cells.sizeOf(2) - 1;
  const std::int64_t paths = rays * static_cast<std::int64_t>(4 * large + cells.sizeOf(1));
  EXPECT_EQ(all, paths);
  engine.update(objects, settings);
  EXPECT_EQ(engine.statistics().followedPaths, 0) << "nothing has moved";
  objects.dynamicObjects[0].worldFromObject.translation.x() += 0.01;
  engine.update(objects, settings);
  EXPECT_EQ(engine.numberOfGatherRays(), static_cast<std::uint64_t>(rays));
  EXPECT_GE(engine.statistics().followedPaths, rays * static_cast<std::int64_t>(cells.sizeOf(1)))
    << "what moves gathers anew";
  EXPECT_LT(engine.statistics().followedPaths, all / 2);
  const std::size_t bytes = engine.statistics().historyBytes;
  settings.targetRelativeError = 1;
  engine.update(objects, settings);
  EXPECT_EQ(engine.numberOfGatherRays(), 16u);
  EXPECT_LT(engine.statistics().historyBytes, bytes / 2);
}

class ErrorBarUpdates : public BothModes
{
};

// A new target continues from the existing walks, and the old target returns to them.
TEST_P(ErrorBarUpdates, TurningTheDialEqualsAFreshStart)
{
  const SceneObjects objects = shadedRoom(1);
  EngineSettings settings = Shoot(scaled(1000)).errors(16).gathered(isGathered());
  settings.maximumNumberOfWalks = 64000;
  UpdatedEngine engine;
  std::vector<std::uint32_t> walks;
  for (const double target : { 0.5, 0.2, 0.1, 0.3, 0.0001, 0.5 })
  {
    settings.targetRelativeError = target;
    engine.update(objects, settings);
    EXPECT_TRUE(isShownAsFresh(engine)) << "target " << target;
    walks.push_back(engine.numberOfWalks());
    EXPECT_NEAR(engine.watts(engine.balance().emitted[0]), 100, 1e-9);
    expectBalance(engine);
  }
  EXPECT_LT(walks[0], walks[1]);
  EXPECT_LT(walks[1], walks[2]);
  EXPECT_LT(walks[3], walks[2]);
  EXPECT_EQ(walks[4], settings.maximumNumberOfWalks) << "cannot be reached";
  EXPECT_EQ(walks[5], walks[0]);
  settings.targetRelativeError = 0;
  engine.update(objects, settings);
  EXPECT_TRUE(isShownAsFresh(engine));
}

// A tenth of the area is the inside of a box that no light can reach.
TEST_P(ErrorBarUpdates, DarkCellsDoNotMakeTheDialRunForever)
{
  ObjectBuilder room;
  room.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), 2, grey(0.3), true);
  room.addBox(box({ -1.5, -1, -1 }, { -0.3, 1, 1 }), 1, grey(0.5));
  room.addBox(box({ -1.4, -0.9, -0.9 }, { -0.4, 0.9, 0.9 }), 2, grey(0.5), true);
  room.addPointLight({ 1, 0, 0 }, 100);
  const EngineSettings settings =
    Shoot(1000).errors(16).gathered(isGathered()).target(kIsSanitized ? 0.5 : 0.2, 4000000);
  UpdatedEngine engine({ room.build(), {} }, settings);
  EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
  EXPECT_LT(engine.numberOfWalks(), settings.maximumNumberOfWalks);
}

INSTANTIATE_TEST_SUITE_P(ShotAndGathered, ErrorBarUpdates, testing::Bool(), nameOfMode);

}
}
