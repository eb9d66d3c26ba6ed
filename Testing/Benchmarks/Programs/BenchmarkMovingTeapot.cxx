// SPDX-License-Identifier: BSD-3-Clause
/**
 * The main job on the scene of Examples/MovingTeapot: what a frame costs beside the first shooting,
 * which is what every frame would cost without a history, what the cache is good for, and whether
 * a repair keeps to its budget of time; and what other changes cost. BenchmarkShooting compares with the rival that users would
 * take. The answers are compared before any time counts. CPU time of the one thread. 59 frames
 * after the first are the teapot's whole way.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 59] [head.off]
 */
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Scenes/MovingTeapotScene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

using namespace irradiance;

namespace
{

const std::string kTable = "MovingTeapot";
const std::string kShooting = "first shooting";
const std::string kOverShooting = "time / first shooting";

double timeUnchanged(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  constexpr int kRepetitions = 20;
  Execution serial;
  return medianOf(
    timeInTurns({ [&] { engine.update(objects, settings, serial); } }, kRepetitions)[0]);
}

/// What the first shooting costs, and its history.
void reportShooting(const IrradianceEngine& engine, double shooting)
{
  const auto segments = static_cast<double>(engine.balance().segments);
  report(kTable, kShooting, "ns a segment", 1e9 * shooting / segments);
  report(kTable, "history", "bytes a segment",
    static_cast<double>(engine.statistics().historyBytes) / segments, { 50, 40 });
}

/// A new engine from the first shooting on. Of a small teapot what a whole frame costs is reported
/// alone.
void timeRound(const MovingScene& scene, const EngineSettings& settings, int frames, bool isSmall)
{
  const std::string which = isSmall ? ", small teapot" : "";
  const SceneObjects objects = scene.at(0);
  IrradianceEngine engine;
  const double shooting = timeUpdate(engine, objects, settings).whole;
  if (!isSmall)
  {
    reportShooting(engine, shooting);
    report(kTable, "frame in which nothing moved", kOverShooting,
      timeUnchanged(engine, objects, settings) / shooting, { 1e-5, 0 });
  }
  for (int frame = 1; frame <= frames; ++frame)
  {
    const UpdateTime time = timeUpdate(engine, scene.inFrame(frame), settings);
    if (!isSmall)
    {
      report(kTable, "verification (paper: 0.14)", kOverShooting, time.verification / shooting,
        { 0.03, 0.01 });
      report(kTable, "repair (paper: 0.029)", kOverShooting, time.repair / shooting);
      report(kTable, "frame (paper: 0.17)", kOverShooting, time.whole / shooting);
    }
    report(kTable, "re-shooting" + (isSmall ? which : " (paper: 5.9)"), "first shooting / frame",
      shooting / time.whole);
    report(kTable, "walks that change in a frame" + which, "share of all walks",
      static_cast<double>(engine.statistics().invalidWalks) / settings.numberOfWalks);
  }
}

/// The first cells of the static object, a tenth of its area, reflect otherwise.
SceneObjects withOtherWall(SceneObjects objects)
{
  const std::vector<double> areas = cellAreas(objects.staticObject);
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  auto material = std::make_shared<Material>(*objects.staticObject.material);
  double area = 0;
  for (std::size_t cell = 0; area < 0.1 * all; area += areas[cell++])
  {
    double& reflectance = material->reflectance[cell];
    reflectance += reflectance > 0.5 ? -0.25 : 0.25;
  }
  objects.staticObject.material = material;
  return objects;
}

/// Changes beside the first shooting of what they lead to.
void timeChanges(
  const MovingScene& scene, const MovingScene& withoutHead, const EngineSettings& settings)
{
  const SceneObjects first = scene.at(0), painted = withOtherWall(first);
  EngineSettings twice = settings;
  twice.numberOfWalks *= 2;
  IrradianceEngine engine;
  timeUpdate(engine, first, settings);
  const auto timeChange = [&](const std::string& row, const SceneObjects& to,
                            const EngineSettings& now, const Goal& goal) {
    IrradianceEngine anew;
    const double shooting = timeUpdate(anew, to, now).whole;
    const double change = timeUpdate(engine, to, now).whole;
    requireEqualAnswers(engine, anew, to);
    report(kTable, row, kOverShooting, change / shooting, goal);
  };
  timeChange("the static head goes", withoutHead.at(0), settings, {});
  timeChange("the static head comes", first, settings, {});
  timeChange("a tenth of the area reflects otherwise", painted, settings, { 0.3, 0.15 });
  timeChange("twice as many walks", painted, twice, { 0.6, 0.52 });
}

/// The teapot swings over the head and back with the same step in every frame, so that what it
/// hides in one frame it sets free in another.
void timeCache(const MovingScene& scene, EngineSettings settings, int frames)
{
  constexpr int kSwing = 5;         // frames in one direction
  constexpr int kFill = 2 * kSwing; // the cache begins empty
  const char* const overWithout = "time / without the cache of static hits";
  EngineSettings without = settings;
  settings.cacheStaticHits = true;
  without.cacheStaticHits = false;
  IrradianceEngine engine, plain;
  for (int frame = 0; frame <= kFill + frames; ++frame)
  {
    const int phase = kSwing - std::abs(kSwing - frame % (2 * kSwing));
    const SceneObjects objects = scene.at(0.4 + MovingScene::kFrame * phase);
    const UpdateTime cached = timeUpdate(engine, objects, settings);
    const UpdateTime uncached = timeUpdate(plain, objects, without);
    requireEqualAnswers(engine, plain, objects);
    if (frame > kFill)
    {
      report(kTable, "repair, swinging teapot (paper: 0.69)", overWithout,
        cached.repair / uncached.repair, { 0.8, 0.6 });
      report(kTable, "verification, swinging teapot", overWithout,
        cached.verification / uncached.verification);
      report(kTable, "frame, swinging teapot", overWithout, cached.whole / uncached.whole);
    }
  }
}

/// Each frame is repaired in full by one engine, and by another one with a part of that time as its
/// budget, which then repairs the rest.
void timeBudget(const MovingScene& scene, const EngineSettings& settings, int frames, int percent)
{
  const std::string table = "RepairBudget",
                    row = "budget " + std::to_string(percent) + " % of the repair";
  IrradianceEngine full, timed;
  timeUpdate(full, scene.at(0), settings);
  timeUpdate(timed, scene.at(0), settings);
  double kept = 0;
  for (int frame = 1; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.inFrame(frame);
    const double whole = timeUpdate(full, objects, settings).repair;
    EngineSettings own = settings;
    own.repairTimeBudget = 0.01 * percent * whole;
    timeUpdate(timed, objects, own);
    const double taken = timed.statistics().repairSeconds;
    timeUpdate(timed, objects, settings);
    requireEqualAnswers(timed, full, objects);
    const double excess = taken - own.repairTimeBudget;
    kept += excess <= std::max(0.2 * own.repairTimeBudget, 0.002) ? 1 : 0;
    report(table, row, "time / budget", taken / own.repairTimeBudget);
    report(table, row, "time with the rest / repair at once",
      (taken + timed.statistics().repairSeconds) / whole);
  }
  report(table, row, "frames within 20 % or 2 ms, %", 100 * kept / frames);
}

}

void run(const Arguments& arguments)
{
  constexpr double kSmallTeapot = 0.5; // about a hundredth of the walks changes in a frame
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  settings.cacheStaticHits = false; // as in the filter
  const int rounds = arguments.number(1, 5);
  const int frames = arguments.number(2, 59);
  const std::string head = arguments.text(3, VTKIRRADIANCE_HEAD);
  const MovingScene scene = makeMovingTeapot(head), small = makeMovingTeapot(head, kSmallTeapot),
                    withoutHead = makeMovingTeapot({});
  for (const bool isSmall : { false, true })
  {
    for (int round = 0; round < rounds; ++round)
    {
      timeRound(isSmall ? small : scene, settings, frames, isSmall);
    }
  }
  for (int round = 0; round < rounds; ++round)
  {
    timeChanges(scene, withoutHead, settings);
  }
  timeCache(scene, settings, frames);
  for (const int percent : { 10, 50 })
  {
    timeBudget(scene, settings, frames, percent);
  }
}
