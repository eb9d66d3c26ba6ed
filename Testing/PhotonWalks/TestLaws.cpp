// SPDX-License-Identifier: BSD-3-Clause
// The laws of the engine, each for each feature: see Features.cpp for the rows of the table.

#include "Features.h"

namespace irradiance::test
{
namespace
{

class Laws : public testing::TestWithParam<Feature>
{
protected:
  /// The first frames of the feature's film.
  static Film film(std::size_t frames = 100)
  {
    Film film = GetParam().film();
    film.resize(std::min(frames, film.size()));
    return film;
  }

  /// Of an engine that goes through all frames.
  static Answer lastOf(const Film& film, const Asking& asking)
  {
    FilmRun run(GetParam());
    for (const FilmFrame& frame : film)
    {
      run.update(frame, asking.execution);
    }
    return run.told(asking);
  }
};

// Law 1. Forth and back; a frame in which nothing moves costs nothing.
TEST_P(Laws, UpdateEqualsRebuild)
{
  const Film frames = film();
  FilmRun run(GetParam());
  ThreadExecution two(2);
  std::int64_t changes = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const Answer updated = run.at(frames[i], two);
    ASSERT_TRUE(updated == freshAnswer(GetParam(), frames[i])) << "frame " << i;
    const EngineStatistics& statistics = run.engine().statistics();
    EXPECT_TRUE((statistics.shootSeconds > 0) == (i == 0) || GetParam().shootsLater) << i;
    changes += i == 0 ? 0 : statistics.invalidWalks + statistics.followedPaths;
  }
  EXPECT_TRUE(changes > 0 || GetParam().hasNoWalks);
  const Answer last = run.told({ two });
  EXPECT_TRUE(run.at(frames.back(), two) == last);
  const EngineStatistics& still = run.engine().statistics();
  EXPECT_EQ(still.shootSeconds + still.verifySeconds + still.repairSeconds, 0);
  EXPECT_EQ(still.invalidWalks + still.repairedSegments + still.followedPaths, 0);
  EXPECT_TRUE(run.at(frames.front(), two) == freshAnswer(GetParam(), frames.front()));
}

// Law 2: threads, the order of work, traversals, the cache, verification, loose triangles.
TEST_P(Laws, SameBitsWhateverTheWay)
{
  struct Way
  {
    TraversalMode mode;
    bool cache, verify, isFlattened;
    std::shared_ptr<Execution> execution;
  };
  const auto seven = std::make_shared<ThreadExecution>(7);
  const auto backward = std::make_shared<BackwardExecution>();
  const Way ways[] = { { TraversalMode::OneTree, true, true, false, seven },
    { TraversalMode::OneTree, false, true, true, backward },
    { TraversalMode::Sequential, true, true, true, seven },
    { TraversalMode::Sequential, false, false, false, backward },
    { TraversalMode::Parallel, false, true, true, seven },
    { TraversalMode::Parallel, true, true, false, backward } };
  const Film frames = film(3);
  const Answer expected = freshAnswer(GetParam(), frames.back());
  for (const Way& way : ways)
  {
    Film other = frames;
    for (FilmFrame& frame : other)
    {
      frame.settings.traversalMode = way.mode;
      frame.settings.cacheStaticHits = way.cache;
      frame.settings.verify = way.verify;
      for (SceneObject& object : frame.objects.dynamicObjects)
      {
        object.isFlattened = object.isFlattened || way.isFlattened;
      }
    }
    EXPECT_TRUE(lastOf(other, { *way.execution }) == expected) << "way " << &way - ways;
  }
}

TEST_P(Laws, SameBitsWhateverTheInstructions)
{
  const Film frames = film(3);
  const Answer expected = freshAnswer(GetParam(), frames.back());
  for (const SimdLevel level : simdLevels())
  {
    const SimdLimit limit(level);
    ThreadExecution two(2);
    EXPECT_TRUE(lastOf(frames, { two }) == expected) << "SIMD level " << static_cast<int>(level);
  }
}

// Engines that share the work go through frames together. Some have nothing to do.
TEST_P(Laws, SameBitsOnAnyRanks)
{
  const Film frames = film(3);
  Execution serial;
  const Answer expected = lastOf(frames, { serial, 1, true });
  for (const std::uint32_t ranks : { 2u, 5u })
  {
    std::mutex mutex;
    const auto errors = ThreadRanks(ranks).run([&](ThreadRanks::Rank& rank) {
      const Answer told = lastOf(frames, { rank, 1, true });
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_TRUE(told == expected) << "rank " << rank.rank() << " of " << ranks;
    });
    EXPECT_EQ(errors, std::vector<std::string>(ranks));
  }
}

// reportProgress stops the first update, or a later one, at its first, second, sixth, ...
// call.
TEST_P(Laws, AbortsLeaveNoTrace)
{
  const Film frames = film(3);
  const Answer expected = freshAnswer(GetParam(), frames.back());
  Execution serial;
  for (const bool isFirst : { true, false })
  {
    std::optional<FilmRun> run;
    int stops = 0;
    bool isStopped = true;
    for (int stopAt = 0; isStopped; stopAt = 4 * stopAt + 1)
    {
      if (isFirst || !run)
      {
        run.emplace(GetParam());
      }
      if (!isFirst)
      {
        run->update(frames[0], serial);
      }
      StoppingExecution stopping(stopAt);
      isStopped = false;
      try
      {
        run->update(frames[1], stopping);
      }
      catch (const Interrupted&)
      {
        isStopped = true;
        ++stops;
      }
      ASSERT_TRUE(run->at(frames.back(), serial) == expected) << "stopped at call " << stopAt;
    }
    EXPECT_GE(stops, 1);
  }
}

// Law 6.
TEST_P(Laws, ScaleByPowersOfTwoChangesNothing)
{
  Execution serial;
  const Film frames = film(3);
  const Answer expected = freshAnswer(GetParam(), frames.back());
  for (const auto& [exponent, scalesModels] :
    { std::pair(-20, true), std::pair(1, false), std::pair(10, true), std::pair(30, false) })
  {
    const double scale = std::ldexp(1.0, exponent);
    EXPECT_TRUE(lastOf(scaledFilm(frames, scale, scalesModels), { serial, scale }) == expected)
      << "2^" << exponent << (scalesModels ? ", models" : ", poses");
  }
}

/// What a budget leaves is a part of the whole.
void expectStalePart(const IrradianceEngine& engine)
{
  expectBalance(engine);
  const EngineSettings& settings = engine.settings();
  EXPECT_EQ(engine.stalePower().isZero(), engine.walks().staleGainBound(0) == 0);
  EXPECT_TRUE(settings.targetRelativeError == 0 ||
    engine.walks().hasStale() == std::isnan(engine.reachedRelativeError()));
  forEachSide(engine.objects(), settings.separateSides, [&](const CellSide& side, int band) {
    EXPECT_GE(engine.staleIrradiance(side, band), 0);
    EXPECT_LE(engine.staleIrradiance(side, band), engine.irradiance(side, band));
  });
}

// Things go on moving while walks wait, and come back, but for the last step, which would hide what
// was missed; the number of walks stays, unless it is asked for. Each call repairs something, until it is a rebuild.
TEST_P(Laws, ABudgetEndsInTheRebuild)
{
  Film frames = film(5);
  const Answer expected = freshAnswer(GetParam(), frames[1]);
  for (std::size_t i = frames.size() - 1; i-- > 1;)
  {
    frames.push_back(frames[i]);
  }
  FilmRun run(GetParam());
  const IrradianceEngine& engine = run.engine();
  TickingExecution clock;
  RandomVectors random(7);
  std::uint32_t walks = 0, asked = 0;
  int waits = 0;
  const auto update = [&](FilmFrame frame, double ticks) {
    frame.settings.repairTimeBudget = ticks * TickingExecution::kTick;
    run.update(frame, clock);
    expectStalePart(engine);
    const bool asksForOthers = frame.settings.numberOfWalks != asked;
    asked = frame.settings.numberOfWalks;
    EXPECT_TRUE(!engine.walks().hasStale() || engine.numberOfWalks() == walks || asksForOthers);
    walks = engine.numberOfWalks();
    waits += engine.walks().hasStale() ? 1 : 0;
  };
  for (const FilmFrame& frame : frames)
  {
    update(frame, random.powerOfTwo(-3, 6));
  }
  for (std::size_t left = numberOfStale(engine); engine.walks().hasStale();)
  {
    update(frames.back(), 20);
    ASSERT_LT(numberOfStale(engine), left);
    left = numberOfStale(engine);
  }
  // Sanitized, films are short, and may end before a walk has to wait.
  EXPECT_TRUE(waits > 0 || GetParam().hasNoWalks || GetParam().shootsLater || kIsSanitized);
  EXPECT_TRUE(run.told({ clock }) == expected);
}

/// All rows; every sixth where sanitizers make each take many times as long.
std::vector<Feature> rows()
{
  std::vector<Feature> rows;
  const std::vector<Feature> all = features();
  for (std::size_t i = 0; i < all.size(); i += kIsSanitized ? 6 : 1)
  {
    rows.push_back(all[i]);
  }
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Of, Laws, testing::ValuesIn(rows()),
  [](const auto& info) { return std::string(info.param.name); });

// What no row of the table has.

// 10,000 frames out and the same 10,000 back: nothing drifts, nothing is left behind.
TEST(UpdateEqualsRebuild, ThereAndBackRestoresEveryBit)
{
  const int frames = kIsSanitized ? 250 : 10000;
  MovingScene scene(1, false, 23);
  SceneObjects objects = scene.objects();
  const Shoot settings(100);
  UpdatedEngine engine;
  const auto pose = [&](int frame) {
    for (std::size_t i = 0; i < 3; ++i)
    {
      AffineMap& map = objects.dynamicObjects[i].worldFromObject;
      const double angle = 0.001 * frame * double(i + 1);
      map.linear = Eigen::AngleAxisd(angle, Vector3(1, 2, 3).normalized()).toRotationMatrix();
      map.translation = Vector3(2 + std::sin(angle), 2 + std::cos(1.7 * angle), 1.0 + double(i));
    }
  };
  pose(0);
  engine.update(objects, settings);
  const Answer first = answerOf(engine, objects);
  std::int64_t invalid = 0;
  for (int step = 1; step <= 2 * frames; ++step)
  {
    pose(step <= frames ? step : 2 * frames - step);
    engine.update(objects, settings);
    invalid += engine.statistics().invalidWalks;
  }
  EXPECT_TRUE(answerOf(engine, objects) == first);
  EXPECT_TRUE(isAsFresh(engine));
  EXPECT_GT(invalid, frames);
}

// Poses that are equal as numbers but differ in the sign of a zero.
TEST(UpdateEqualsRebuild, SignOfAZeroInAPose)
{
  ObjectBuilder room, wall;
  room.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), 2, grey(0.5), true);
  room.addPointLight({ 1, 1, 1 }, 1);
  wall.addQuad({ -1, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 2, grey(0.9));
  wall.addQuad({ 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2, grey(0.9));
  const Shoot settings(2000);
  SceneObjects objects{ room.build(), { wall.build() } };
  for (unsigned signs = 0; signs < 4096; signs += 31)
  {
    AffineMap& pose = objects.dynamicObjects[0].worldFromObject;
    pose = {};
    UpdatedEngine engine(objects, settings);
    for (int i = 0; i < 12; ++i)
    {
      double& entry = i < 9 ? pose.linear(i / 3, i % 3) : pose.translation[i - 9];
      entry = entry == 0 && (signs >> i & 1u) != 0 ? -0.0 : entry;
    }
    engine.update(objects, settings);
    ASSERT_TRUE(isAsFresh(engine)) << "signs " << signs;
  }
}

TEST(SameBits, SidesAddUpToTheSum)
{
  MovingScene scene(3, false, 42);
  const EngineSettings together = Shoot(scaled(10000)), apart = Shoot(scaled(10000)).bySide();
  UpdatedEngine a, b;
  double back = 0;
  for (int frame = 0; frame < 5; ++frame, scene.nextFrame())
  {
    a.update(scene.objects(), together);
    b.update(scene.objects(), apart);
    a.cells().numbers().forEach([&](const SceneCell& cell) {
      for (int band = 0; band < 3; ++band)
      {
        const double ofBack = b.irradiance({ cell, 1 }, band);
        const double sum = b.irradiance({ cell, 0 }, band) + ofBack;
        ASSERT_NEAR(a.irradiance({ cell }, band), sum, 0x1p-50 * sum);
        back += ofBack;
      }
    });
    a.update(scene.objects(), apart);
    ASSERT_EQ(a.statistics().shootSeconds, 0) << "sides are always known";
    ASSERT_EQ(a.statistics().repairedSegments, 0);
    ASSERT_TRUE(answerOf(a, scene.objects(), true) == answerOf(b, scene.objects(), true));
  }
  EXPECT_GT(back, 0);
}

struct Input
{
  SceneObjects objects;
  EngineSettings settings;
};

struct Change
{
  const char* name;
  std::function<void(Input&)> apply;
};

SceneObject lamp(double exitance)
{
  ObjectBuilder builder;
  builder.addBox(box({ 0, 0, 0 }, { 0.2, 0.2, 0.2 }), 1, grey(0.3, exitance));
  return builder.build(shift({ 3, 3, 1 }));
}

/// Changes between two frames, other than poses of objects that do not shine.
std::vector<Change> changes()
{
  const auto changeSurface = [](SceneObject& object, const auto& change) {
    auto surface = std::make_shared<Material>(*object.material);
    change(*surface);
    object.material = surface;
  };
  const auto changeLight = [](SceneObject& object, const auto& change) {
    auto emission = std::make_shared<Emission>(*object.emission);
    change(*emission);
    object.emission = emission;
  };
  return {
    { "moving emitter", [](Input& in) { in.objects.dynamicObjects.back().worldFromObject = {}; } },
    { "exitance", [](Input& in) { in.objects.dynamicObjects.back() = lamp(5); } },
    { "static reflectance",
      [=](Input& in) {
        changeSurface(in.objects.staticObject, [](Material& s) { s.reflectance[3] = 0.9; });
      } },
    { "dynamic reflectance",
      [=](Input& in) {
        changeSurface(in.objects.dynamicObjects[0], [](Material& s) { s.reflectance[0] = 0; });
      } },
    { "point light",
      [=](Input& in) {
        changeLight(in.objects.staticObject, [](Emission& e) { e.points[0].position[2] += 1e-3; });
      } },
    { "dimmed lamp",
      [=](Input& in) {
        changeLight(in.objects.dynamicObjects.back(), [](Emission& e) { e.exitance[0] *= 0.5; });
      } },
    { "static geometry",
      [](Input& in) { in.objects.staticObject = MovingScene(1, true, 1).objects().staticObject; } },
    { "object added",
      [](Input& in) { in.objects.dynamicObjects.push_back(in.objects.dynamicObjects[0]); } },
    { "object removed",
      [](Input& in) { in.objects.dynamicObjects.erase(in.objects.dynamicObjects.begin() + 1); } },
    { "objects swapped",
      [](Input& in) { std::swap(in.objects.dynamicObjects[0], in.objects.dynamicObjects[1]); } },
    { "object loose", [](Input& in) { in.objects.dynamicObjects[1].isFlattened = true; } },
    { "all objects gone", [](Input& in) { in.objects.dynamicObjects.clear(); } },
    { "seed", [](Input& in) { in.settings.seed = 77; } },
    { "number of walks", [](Input& in) { in.settings.numberOfWalks += 1; } },
    { "one walk", [](Input& in) { in.settings.numberOfWalks = 1; } },
    { "sides", [](Input& in) { in.settings.separateSides = true; } },
    { "no verification", [](Input& in) { in.settings.verify = false; } },
    { "cache off", [](Input& in) { in.settings.cacheStaticHits = false; } },
    { "one tree", [](Input& in) { in.settings.traversalMode = TraversalMode::OneTree; } },
    { "sequential", [](Input& in) { in.settings.traversalMode = TraversalMode::Sequential; } },
    { "darkness",
      [](Input& in) {
        in.objects.dynamicObjects.pop_back();
        in.objects.staticObject.emission = nullptr;
      } },
    { "bands", [](Input& in) { in.objects = MovingScene(3, false, 31).objects(); } },
  };
}

TEST(ChangesShootAnew, EveryChangeThereAndBackEqualsANewEngine)
{
  MovingScene scene(1, false, 31);
  UpdatedEngine engine;
  for (const Change& change : changes())
  {
    const SceneObject still = lamp(2);
    const auto expectFresh = [&](bool isChanged, const char* when) {
      Input in{ scene.objects(), Shoot(scaled(3000)) };
      in.objects.dynamicObjects.push_back(still);
      if (isChanged)
      {
        change.apply(in);
      }
      engine.update(in.objects, in.settings);
      EXPECT_TRUE(isAsFresh(engine)) << change.name << ", " << when;
    };
    expectFresh(false, "before");
    scene.nextFrame();
    expectFresh(false, "moved");
    expectFresh(true, "alone");
    expectFresh(false, "undone");
    scene.nextFrame();
    expectFresh(true, "in motion");
    expectFresh(true, "again");
    scene.nextFrame();
  }
}

}
}
