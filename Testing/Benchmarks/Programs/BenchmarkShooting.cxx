// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shooting and frames beside a plain tracer with Embree (Rivals/PlainTracer.h), at equal error.
 *
 * The efficiency of a shooting is 1 / (squared RMS error over the area x CPU time). A frame is compared
 * with the time in which the tracer, shooting anew, would reach the error that our update has: its own
 * time x (its error / ours)^2. Building Embree's scene is not counted, which favours the tracer. Answers
 * are compared before any time counts. One thread, CPU time, in turns; two threads by the clock on the
 * wall.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 8] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/SharedReference.h"
#include "Measuring/Shot.h"
#include "Rivals/EmbreeScene.h"
#include "Scenes/DragonRoom.h"
#include "Scenes/PlainRoom.h"
#include "Simd/SimdLevel.h"

#include <optional>

using namespace irradiance;

namespace
{

const std::string kTable = "PlainTracer";
const std::string kSegments = "PlainTracerSegments";
const std::string kAnswers = "PlainTracerAnswers";

/// While it lives the engine uses AVX2 at most.
struct Avx2Alone
{
  Avx2Alone() { limitSimd(SimdLevel::Avx2); }
  ~Avx2Alone() { limitSimd(SimdLevel::Avx512); }
};

std::string instructionSet()
{
  const SimdLevel level = simdLevel();
  return level == SimdLevel::Avx512 ? "AVX-512" : level == SimdLevel::Avx2 ? "AVX2" : "plain";
}

std::string callOf(const PlainTracer& tracer)
{
  return "rtcIntersect" + std::to_string(tracer.width());
}

EngineSettings withSeed(EngineSettings settings, std::uint64_t seed)
{
  settings.seed = seed;
  return settings;
}

Shot shootNew(const SceneObjects& objects, const EngineSettings& settings)
{
  IrradianceEngine engine;
  return shoot(engine, objects, settings);
}

/// The mean of what was added.
class Mean
{
public:
  void add(double value)
  {
    sum_ += value;
    ++count_;
  }
  double value() const { return sum_ / count_; }

private:
  double sum_ = 0;
  int count_ = 0;
};

/// A still scene that both shoot, and how wrong they are.
class Contest
{
public:
  Contest(const SceneObjects& objects, const EngineSettings& settings)
    : objects_(objects)
    , settings_(settings)
    , plain_(makePlainScene(objects))
    , tracer_(plain_)
    , reference_(
        areasOf(objects), [this](std::uint64_t seed) { return ours(seed).irradiance; },
        [this](std::uint64_t seed) { return theirs(tracer_, seed).irradiance; })
  {
  }

  /// Nothing is stored.
  Shot ours(std::uint64_t seed) const
  {
    EngineSettings settings = withSeed(settings_, seed);
    settings.verify = false;
    return shootNew(objects_, settings);
  }
  Shot oursStored(std::uint64_t seed) const
  {
    return shootNew(objects_, withSeed(settings_, seed));
  }
  Shot theirs(const PlainTracer& tracer, std::uint64_t seed) const
  {
    return shoot(tracer, objects_, plain_, withSeed(settings_, seed));
  }

  const PlainScene& plain() const { return plain_; }
  const PlainTracer& tracer() const { return tracer_; }
  const SharedReference& reference() const { return reference_; }

private:
  SceneObjects objects_;
  EngineSettings settings_;
  PlainScene plain_;
  PlainTracer tracer_;
  SharedReference reference_;
};

/// Squared errors, the means of all rounds: that of a single run varies.
struct Errors
{
  /// For the same time, how much more efficient ours is.
  double gain() const { return theirs.value() / ours.value(); }

  Mean ours, theirs;
};

void reportSegments(const std::string& who, const Shot& shot)
{
  report(kSegments, who, "ns a segment", shot.nsPerSegment());
  report(kSegments, who, "segments, millions", 1e-6 * static_cast<double>(shot.segments));
}

void reportAnswers(const std::string& scene, const SharedReference& reference)
{
  report(kAnswers, scene, "mean irradiance, ours / the tracer's", reference.ratio());
  report(kAnswers, scene, "RMS difference / what noise explains", reference.overNoise());
}

/// The first shooting of a scene, with its history. `isWhole`: and in other ways too.
void timeShooting(const std::string& scene, const SceneObjects& objects,
  const EngineSettings& settings, int rounds, bool isWhole, const Goal& goal)
{
  const Contest contest(objects, settings);
  const PlainTracer tracerOf8(contest.plain(), PlainTracer::Packets::Of8);
  const std::string with = "efficiency / plain tracer's with ";
  reportAnswers(scene, contest.reference());
  Errors errors;
  std::vector<double> theirs, theirsOf8, stored, unstored, avx2;
  for (int round = 0; round < rounds; ++round)
  {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    const Shot plain = contest.theirs(contest.tracer(), seed), own = contest.oursStored(seed);
    theirs.push_back(plain.seconds);
    stored.push_back(own.seconds);
    errors.theirs.add(contest.reference().squaredError(plain.irradiance));
    errors.ours.add(contest.reference().squaredError(own.irradiance));
    reportSegments("plain tracer, " + callOf(contest.tracer()) + ", " + scene, plain);
    reportSegments("ours, " + instructionSet() + ", " + scene, own);
    if (isWhole)
    {
      unstored.push_back(contest.ours(seed).seconds);
      theirsOf8.push_back(contest.theirs(tracerOf8, seed).seconds);
      const Avx2Alone narrow;
      avx2.push_back(contest.oursStored(seed).seconds);
    }
  }
  const auto reportEfficiency = [&](const std::string& row, const PlainTracer& tracer,
                                  const std::vector<double>& rival, const std::vector<double>& own,
                                  const Goal& bars) {
    for (const double speed : ratios(rival, own))
    {
      report(kTable, row + scene, with + callOf(tracer), errors.gain() * speed, bars);
    }
  };
  reportEfficiency("first shooting, ", contest.tracer(), theirs, stored, goal);
  reportEfficiency("nothing stored, ", contest.tracer(), theirs, unstored, { 0.9, 1.25 });
  reportEfficiency("AVX2 alone, first shooting, ", tracerOf8, theirsOf8, avx2, { 0.6, 0.9 });
  report(kSegments, "plain tracer, " + callOf(contest.tracer()) + ", " + scene, "RMS error",
    std::sqrt(errors.theirs.value()));
  report(kSegments, "ours, " + instructionSet() + ", " + scene, "RMS error",
    std::sqrt(errors.ours.value()));
}

/// Frames in which about that share of the walks changes.
struct FrameCase
{
  const char* share;
  double ringSize; ///< m, which leads to it
  Goal goal;
};

/// Every frame is shot by the tracer too, which is given the scene as it is then.
void timeFrames(const FrameCase& which, const EngineSettings& settings, int rounds, int frames)
{
  const MovingScene scene = makePlainRoom(which.ringSize);
  const Contest contest(scene.at(0), settings);
  const std::string row = std::string("frame, ") + which.share + " of the walks changed";
  reportAnswers(scene.name + ", ring of " + std::to_string(which.ringSize).substr(0, 4) + " m",
    contest.reference());
  Errors errors;
  std::vector<double> quotients;
  for (int round = 0; round < rounds; ++round)
  {
    const EngineSettings own = withSeed(settings, static_cast<std::uint64_t>(round) + 1);
    IrradianceEngine engine;
    const Shot first = shoot(engine, scene.at(0), own);
    errors.ours.add(contest.reference().squaredError(first.irradiance));
    errors.theirs.add(
      contest.reference().squaredError(contest.theirs(contest.tracer(), own.seed).irradiance));
    for (int frame = 1; frame <= frames; ++frame)
    {
      const SceneObjects objects = scene.inFrame(frame);
      const UpdateTime time = timeUpdate(engine, objects, own);
      const PlainScene plain = makePlainScene(objects);
      const Shot theirs = shoot(PlainTracer(plain), objects, plain, own);
      const EngineStatistics& cost = engine.statistics();
      quotients.push_back(theirs.seconds / time.whole);
      report(kTable, row, "changed, %", 100.0 * cost.invalidWalks / settings.numberOfWalks);
      report(kTable, row, "repair, ns a segment / first shooting's",
        1e9 * time.repair / static_cast<double>(cost.repairedSegments) / first.nsPerSegment(),
        { 1.3, 1.0 });
      report(kTable, row, "ms", 1e3 * time.whole);
    }
  }
  for (const double quotient : quotients)
  {
    report(kTable, row, "plain tracer's time at equal error / update", errors.gain() * quotient,
      which.goal);
  }
}

/// What is stored, and what an update costs in which nothing has moved.
void measureHistory(const SceneObjects& objects, const EngineSettings& settings, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    constexpr int kRepetitions = 20;
    IrradianceEngine engine;
    const Shot first = shoot(engine, objects, settings);
    report(kTable, "history, plain room", "bytes a segment",
      static_cast<double>(engine.statistics().historyBytes) / static_cast<double>(first.segments),
      { 50, 40 });
    const std::vector<double> still =
      timeInTurns({ [&] { timeUpdate(engine, objects, settings); } }, kRepetitions)[0];
    report(kTable, "frame in which nothing moved", "time / first shooting",
      medianOf(still) / first.seconds, { 1e-5, 0 });
  }
}

/// Beside what a million walks took when Russian roulette began at a quarter of the power.
void measureHistoryOfTeapot(const SceneObjects& objects, const EngineSettings& settings)
{
  constexpr double kBytesOfWalk = 175.6;
  IrradianceEngine engine;
  timeUpdate(engine, objects, settings);
  report(kTable, "history, moving teapot", "bytes / with roulette at a quarter of the power",
    static_cast<double>(engine.statistics().historyBytes) / (kBytesOfWalk * settings.numberOfWalks),
    { 0.6, 0.5 });
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
      report(kTable, frame == 0 ? "two threads, first shooting" : "two threads, frame",
        "speed / one thread", slow / fast, { frame == 0 ? 1.85 : 1.8, 1.95 });
    }
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  const int frames = arguments.number(2, 8);
  const MovingScene room = makePlainRoom();
  const MovingScene teapot = makeMovingTeapot(arguments.text(3, VTKIRRADIANCE_HEAD));
  flushDenormals();
  timeShooting("plain room", room.at(0), settings, rounds, true, { 0.8, 1.1 });
  timeShooting("moving teapot", teapot.at(0), settings, rounds, false, { 0.75, 1.1 });
  if (const std::optional<SceneObjects> dragon = makeDragonRoom())
  {
    timeShooting("room with the dragon", *dragon, settings, rounds, false, { 0.75, 1.1 });
  }
  for (const FrameCase& which : { FrameCase{ "3.5 %", 1.1, { 8, 12 } },
         FrameCase{ "2 %", 0.8, { 11, 15 } }, FrameCase{ "1 %", 0.5, { 18, 26 } } })
  {
    timeFrames(which, settings, rounds, frames);
  }
  measureHistory(room.at(0), settings, rounds);
  measureHistoryOfTeapot(teapot.at(0), settings);
  timeThreads(room, settings, rounds, frames);
}
