// SPDX-License-Identifier: BSD-3-Clause
/**
 * The bars of the main job on the scene of Examples/MovingTeapot: how shooting compares with the same
 * walks in Embree (BenchmarkShooting has the rival that users would take), what a frame costs beside
 * the first shooting, and what a cache and a second thread are good for. The answers are compared
 * before any time counts. CPU time of the one thread; two threads by the clock on the wall. 59 frames
 * after the first are the teapot's whole way.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 59] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/CellField.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Rivals/EmbreeShooter.h"
#include "Scenes/MovingTeapotScene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

const std::string kTable = "MovingTeapot";
const std::string kShooting = "first shooting";
const std::string kOverShooting = "time / first shooting";

/// Power received by the teapot, the last object, as a part of that received by all.
double teapotsShare(const CellSums& sums, const SceneObjects& objects)
{
  const CellField power =
    fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double /*area*/) {
      return static_cast<double>(sums.sum(object, cell, 0, 0));
    });
  const std::size_t cells = objects.dynamicObjects[0].material->numberOfCells;
  return power.tail(static_cast<Eigen::Index>(cells)).sum() / power.sum();
}

void compareAnswers(const IrradianceEngine& engine, const SceneObjects& objects,
  std::int64_t segments, const CellSums& sums)
{
  const double share = teapotsShare(sums, objects) / teapotsShare(engine.sums(), objects);
  const double walks =
    static_cast<double>(segments) / static_cast<double>(engine.balance().segments);
  if (std::abs(walks - 1) > 2e-3 || std::abs(share - 1) > 2e-2)
  {
    throw std::runtime_error("Embree's answer differs: " + std::to_string(walks) +
      " of the segments, " + std::to_string(share) + " of the teapot's share of power");
  }
}

/// Of each form, after its answer was compared with the engine's.
std::vector<double> timeEmbree(
  const IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  const EmbreeShooter embree(objects, settings.numberOfWalks, settings.seed);
  std::vector<double> seconds;
  for (const EmbreeForm& form : kEmbreeForms)
  {
    CellSums sums(objects, 1);
    const double start = threadCpuSeconds();
    const std::int64_t segments = (embree.*form.shoot)(sums);
    seconds.push_back(threadCpuSeconds() - start);
    compareAnswers(engine, objects, segments, sums);
  }
  return seconds;
}

double timeUnchanged(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  constexpr int kRepetitions = 20;
  Execution serial;
  return medianOf(
    timeInTurns({ [&] { engine.update(objects, settings, serial); } }, kRepetitions)[0]);
}

/// What the first shooting costs, beside Embree's (`embree`: for each form), and its history.
void reportShooting(
  const IrradianceEngine& engine, double shooting, const std::vector<double>& embree)
{
  const auto segments = static_cast<double>(engine.balance().segments);
  report(kTable, kShooting, "speed / our walks in Embree's fastest way",
    *std::min_element(embree.begin(), embree.end()) / shooting, { 0.85, 1.2 });
  report("MovingTeapotSegments", kShooting, "ns", 1e9 * shooting / segments);
  for (std::size_t i = 0; i < embree.size(); ++i)
  {
    const std::string name = kEmbreeForms[i].name;
    report(kTable, kShooting, "speed / our walks in Embree, " + name, embree[i] / shooting);
    report(
      "MovingTeapotSegments", "our walks in Embree, " + name, "ns", 1e9 * embree[i] / segments);
  }
  report(kTable, "history", "bytes a hit",
    static_cast<double>(engine.statistics().historyBytes) / segments, { 56, 40 });
}

/// A new engine from the first shooting on, beside Embree's shooting. Of a small teapot what a frame
/// costs beside that is reported alone.
void timeRound(const MovingScene& scene, const EngineSettings& settings, int frames, bool isSmall)
{
  const std::string which = isSmall ? ", small teapot" : "";
  const SceneObjects objects = scene.at(0);
  IrradianceEngine engine;
  const double shooting = timeUpdate(engine, objects, settings).whole;
  const std::vector<double> embree = timeEmbree(engine, objects, settings);
  if (!isSmall)
  {
    reportShooting(engine, shooting, embree);
    report(kTable, "frame in which nothing moved", kOverShooting,
      timeUnchanged(engine, objects, settings) / shooting, { 0.0001, 0 });
  }
  for (int frame = 1; frame <= frames; ++frame)
  {
    const UpdateTime time = timeUpdate(engine, scene.inFrame(frame), settings);
    if (!isSmall)
    {
      report(kTable, "verification (paper: 0.14)", kOverShooting, time.verification / shooting,
        { 0.03, 0.01 });
      report(kTable, "repair (paper: 0.029)", kOverShooting, time.repair / shooting);
      report(kTable, "verification and repair (paper: 0.17)", kOverShooting, time.whole / shooting);
    }
    report(kTable,
      "re-shooting our walks in Embree's fastest way" + (isSmall ? which : " (paper: 5.9)"),
      "time / verification and repair",
      *std::min_element(embree.begin(), embree.end()) / time.whole,
      isSmall ? Goal{ 25, 45 } : Goal{ 12, 25 });
    report(kTable, "walks that change in a frame" + which, "share of all walks",
      static_cast<double>(engine.statistics().invalidWalks) / settings.numberOfWalks);
  }
}

/// The teapot swings over the head and back with the same step in every frame, so that what it hides
/// in one frame it sets free in another.
void timeCache(const MovingScene& scene, const EngineSettings& settings, int frames)
{
  constexpr int kSwing = 5;         // frames in one direction
  constexpr int kFill = 2 * kSwing; // the cache begins empty
  const char* const overWithout = "time / without the cache of static hits";
  EngineSettings without = settings;
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
      report(kTable, "verification and repair, swinging teapot", overWithout,
        cached.whole / uncached.whole);
    }
  }
}

/// The same updates with one thread and with two, in turns, by the clock on the wall.
void timeThreads(const MovingScene& scene, const EngineSettings& settings, int rounds, int frames)
{
  Execution one;
  test::ThreadExecution two(2);
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine alone, together;
    for (int frame = 0; frame <= frames; ++frame)
    {
      const SceneObjects objects = scene.inFrame(frame);
      const double slow = timeUpdate(alone, objects, settings, one).whole;
      const double fast = timeUpdate(together, objects, settings, two).whole;
      const std::string phase = frame == 0 ? kShooting : "verification and repair";
      report(kTable, phase + ", two threads", "speed / one thread", slow / fast, { 1.7, 1.9 });
    }
  }
}

}

void run(const Arguments& arguments)
{
  constexpr double kSmallTeapot = 0.5; // about a hundredth of the walks changes in a frame
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  const int frames = arguments.number(2, 59);
  const std::string head = arguments.text(3, VTKIRRADIANCE_HEAD);
  flushDenormals();
  const MovingScene scene = makeMovingTeapot(head), small = makeMovingTeapot(head, kSmallTeapot);
  for (const bool isSmall : { false, true })
  {
    for (int round = 0; round < rounds; ++round)
    {
      timeRound(isSmall ? small : scene, settings, frames, isSmall);
    }
  }
  timeCache(scene, settings, frames);
  timeThreads(scene, settings, rounds, std::min(frames, 10));
}
