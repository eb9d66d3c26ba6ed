/**
 * The bars of the main job on the scene of Examples/MovingTeapot: how shooting compares with Embree
 * doing the same walks in its fastest way, what a frame costs beside the first shooting, and what a
 * cache and a second thread are good for. The answers are compared before any time counts; the rivals
 * are timed in turns in one process by the thread's CPU time (two threads by the clock on the wall),
 * and the medians of the ratios are given. 59 frames after the first are the teapot's whole way.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 59] [head.off]
 */
#include "CacheContest.h"
#include "EmbreeCaster.h"
#include "Goals.h"
#include "Program.h"
#include "Results.h"
#include "ThreadContest.h"
#include "UpdateContest.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

using namespace irradiance;

namespace
{

const char* const kTable = "MovingTeapot";
const char* const kOverShooting = "time / first shooting";
const char* const kOverFrame = "time / verification and repair";
/// At this size the teapot's motion changes about a hundredth of the walks in a frame.
constexpr double kSmallTeapot = 0.5;

std::vector<UpdateTimes> timeRounds(
  const MovingTeapotScene& scene, const EngineSettings& settings, int rounds, int frames)
{
  std::vector<UpdateTimes> times;
  for (int round = 0; round < rounds; ++round)
  {
    times.push_back(timeUpdates(scene, settings, frames));
  }
  return times;
}

/// A value for each round.
template <class Value>
std::vector<double> perRound(const std::vector<UpdateTimes>& rounds, const Value& value)
{
  std::vector<double> values;
  for (const UpdateTimes& round : rounds)
  {
    values.push_back(value(round));
  }
  return values;
}

/// A value for each frame of each round.
template <class Value>
std::vector<double> perFrame(const std::vector<UpdateTimes>& rounds, const Value& value)
{
  std::vector<double> values;
  for (const UpdateTimes& round : rounds)
  {
    for (std::size_t frame = 0; frame < round.verifying.size(); ++frame)
    {
      values.push_back(value(round, frame));
    }
  }
  return values;
}

void addShooting(const std::vector<UpdateTimes>& rounds, Results& results)
{
  const auto add = [&](EmbreeForm form, const std::string& rival, const Goal& goal) {
    results.add(kTable, "first shooting", "speed / " + rival,
      perRound(rounds, [=](const UpdateTimes& t) { return t.embree.at(form) / t.shooting; }), goal);
  };
  add(fastestForm(rounds), "Embree's fastest way", goals::kFirstShooting);
  for (const EmbreeForm form : kEmbreeForms)
  {
    add(form, nameOf(form), {});
  }
}

void addPhases(const std::vector<UpdateTimes>& rounds, Results& results)
{
  const auto add = [&](const char* row, const Goal& goal, const auto& seconds) {
    results.add(kTable, row, kOverShooting,
      perFrame(
        rounds, [&](const UpdateTimes& t, std::size_t i) { return seconds(t, i) / t.shooting; }),
      goal);
  };
  using Times = const UpdateTimes&;
  add("verification (paper: 0.14)", goals::kVerification,
    [](Times t, std::size_t i) { return t.verifying[i]; });
  add("repair (paper: 0.029)", {}, [](Times t, std::size_t i) { return t.repairing[i]; });
  add("verification and repair (paper: 0.17)", {},
    [](Times t, std::size_t i) { return t.verifying[i] + t.repairing[i]; });
  results.add(kTable, "frame in which nothing moved", kOverShooting,
    perRound(rounds, [](Times t) { return t.unchanged / t.shooting; }), goals::kNothingMoved);
}

void addReshooting(const std::vector<UpdateTimes>& rounds, const std::string& which,
  const std::string& paper, const Goal& goal, Results& results)
{
  const EmbreeForm form = fastestForm(rounds);
  results.add(kTable, "re-shooting in Embree's fastest way" + which + paper, kOverFrame,
    perFrame(rounds,
      [form](const UpdateTimes& t, std::size_t i) {
        return t.embree.at(form) / (t.verifying[i] + t.repairing[i]);
      }),
    goal);
  results.add(kTable, "walks that change in a frame" + which, "share of all walks",
    perFrame(rounds, [](const UpdateTimes& t, std::size_t i) { return t.changed[i]; }));
}

void addCache(const CacheGain& gain, Results& results)
{
  const char* const overWithout = "time / without the cache of static hits";
  results.add(kTable, "repair, swinging teapot (paper: 0.69)", overWithout, gain.repair,
    goals::kStaticHitCache);
  results.add(kTable, "verification, swinging teapot", overWithout, gain.verification);
  results.add(kTable, "verification and repair, swinging teapot", overWithout, gain.frame);
}

void addThreads(const ThreadSpeeds& speeds, Results& results)
{
  const char* const overOne = "speed / one thread";
  results.add(kTable, "first shooting, two threads", overOne, speeds.shooting, goals::kTwoThreads);
  results.add(
    kTable, "verification and repair, two threads", overOne, speeds.frame, goals::kTwoThreads);
}

void run(int argc, char* argv[])
{
  EngineSettings settings;
  settings.numberOfWalks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1000000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const int frames = argc > 3 ? std::atoi(argv[3]) : 59;
  const std::string head = argc > 4 ? argv[4] : VTKIRRADIANCE_HEAD;
  flushDenormals();
  Results results("BenchmarkMovingTeapot");
  const MovingTeapotScene scene(head);
  const std::vector<UpdateTimes> times = timeRounds(scene, settings, rounds, frames);
  addShooting(times, results);
  addPhases(times, results);
  addReshooting(times, "", " (paper: 5.9)", goals::kReshooting, results);
  addReshooting(timeRounds(MovingTeapotScene(head, kSmallTeapot), settings, rounds, frames),
    ", small teapot", "", goals::kReshootingSmall, results);
  addCache(timeCache(scene, settings, frames), results);
  addThreads(timeThreads(scene, settings, rounds, std::min(frames, 10)), results);
  results.add(kTable, "history", "bytes a hit",
    perRound(times, [](const UpdateTimes& t) { return t.bytesPerHit; }), goals::kBytesPerHit);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
