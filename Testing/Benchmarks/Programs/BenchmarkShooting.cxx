// SPDX-License-Identifier: BSD-3-Clause
/**
 * Shooting and frames beside a plain tracer with Embree (Rivals/PlainTracer.h), at equal error.
 *
 * The efficiency of a shooting is 1 / (squared RMS error over the area x CPU time). A frame is
 * compared with the time in which the tracer, shooting everything again, would reach the error that
 * our update has: its own time x (its error / ours)^2. Building Embree's scene is not counted,
 * which favours the tracer. Answers are compared before any time counts. One thread, CPU time, in
 * turns; two threads by the clock on the wall.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [frames = 8] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Scenes/BenchmarkScene.h"
#include "Scenes/PlainRoom.h"
#include "Simd/SimdLevel.h"

#include <algorithm>
#include <cmath>
#include <optional>

using namespace irradiance;

namespace
{

const std::string kTable = "PlainTracer";
const std::string kSegments = "PlainTracerSegments";

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

void reportSegments(const std::string& who, const Shot& shot)
{
  report(kSegments, who, "ns a segment", shot.nsPerSegment());
  report(kSegments, who, "segments, millions", 1e-6 * static_cast<double>(shot.segments));
}

/// A still scene that both shoot, and what is right in it: by both together, so it favours neither.
class Contest
{
public:
  /// Throws std::runtime_error if the programs differ by more than their noise explains.
  Contest(const SceneObjects& objects, const EngineSettings& settings)
    : objects_(objects)
    , settings_(settings)
    , areas_(areasOf(objects))
    , all_(cellSetsOf(objects)[0])
    , plain_(makePlainScene(objects))
    , tracer_(plain_)
  {
    const HalvedTruth byUs = halvesOf([&](std::uint64_t seed) { return ours(seed); }),
                      byThem = halvesOf([&](std::uint64_t seed) { return theirs(tracer_, seed); });
    requireAgreement("Our mean", { byUs.first, byUs.second }, byThem, areas_, all_);
    truth_ = combined(byUs, byThem, areas_, { all_ });
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
  double squaredError(const Shot& shot) const
  {
    return truth_.squaredError(shot.irradiance, areas_, all_);
  }

private:
  /// Each the mean of four runs.
  HalvedTruth halvesOf(const std::function<Shot(std::uint64_t)>& shoot) const
  {
    constexpr int kRuns = 8;
    constexpr std::uint64_t kFirstSeed = 1000; // those that are measured are smaller
    HalvedTruth halves{ CellField::Zero(areas_.size()), CellField::Zero(areas_.size()) };
    for (int run = 0; run < kRuns; ++run)
    {
      CellField& half = run < kRuns / 2 ? halves.first : halves.second;
      half += shoot(kFirstSeed + static_cast<std::uint64_t>(run)).irradiance / (kRuns / 2);
    }
    return halves;
  }

  SceneObjects objects_;
  EngineSettings settings_;
  CellField areas_;
  CellSet all_;
  PlainScene plain_;
  PlainTracer tracer_;
  HalvedTruth truth_;
};

/// Squared errors, the means of all rounds: the error of a single run varies.
struct Errors
{
  /// For the same time, how much more efficient ours is.
  double gain() const { return theirs.value() / ours.value(); }

  Mean ours, theirs;
};

void reportEfficiency(const std::string& row, const PlainTracer& tracer, double gain,
  double plainSeconds, double seconds, const Goal& goal)
{
  report(kTable, row, "efficiency / plain tracer's with " + callOf(tracer),
    gain * plainSeconds / seconds, goal);
}

/// The first shooting of a scene, with its history. Returns the gain of its errors.
double timeShooting(const std::string& scene, const Contest& contest, int rounds, const Goal& goal)
{
  const std::string plain = "plain tracer, " + callOf(contest.tracer()) + ", " + scene,
                    own = "ours, " + instructionSet() + ", " + scene;
  Errors errors;
  std::vector<Shot> theirs, ours;
  for (int round = 0; round < rounds; ++round)
  {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    theirs.push_back(contest.theirs(contest.tracer(), seed));
    ours.push_back(contest.oursStored(seed));
    errors.theirs.add(contest.squaredError(theirs.back()));
    errors.ours.add(contest.squaredError(ours.back()));
    reportSegments(plain, theirs.back());
    reportSegments(own, ours.back());
  }
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    reportEfficiency("first shooting, " + scene, contest.tracer(), errors.gain(), theirs[i].seconds,
      ours[i].seconds, goal);
  }
  report(kSegments, plain, "RMS error", std::sqrt(errors.theirs.value()));
  report(kSegments, own, "RMS error", std::sqrt(errors.ours.value()));
  return errors.gain();
}

/// Without a history, and with narrow instructions in both, which do not change our answer.
void timeOtherWays(const std::string& scene, const Contest& contest, double gain, int rounds)
{
  const PlainTracer tracerOf8(contest.plain(), PlainTracer::Packets::Of8);
  for (int round = 0; round < rounds; ++round)
  {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    reportEfficiency("nothing stored, " + scene, contest.tracer(), gain,
      contest.theirs(contest.tracer(), seed).seconds, contest.ours(seed).seconds, { 1.05, 1.4 });
    const Avx2Alone narrow;
    reportEfficiency("AVX2 alone, first shooting, " + scene, tracerOf8, gain,
      contest.theirs(tracerOf8, seed).seconds, contest.oursStored(seed).seconds, { 0.8, 1 });
  }
}

/// Of all walks, those that change in a frame, on the average of a few.
double shareChanged(const MovingScene& scene, const EngineSettings& settings)
{
  constexpr int kFrames = 3;
  IrradianceEngine engine;
  timeUpdate(engine, scene.at(0), settings);
  double changed = 0;
  for (int frame = 1; frame <= kFrames; ++frame)
  {
    timeUpdate(engine, scene.inFrame(frame), settings);
    changed += static_cast<double>(engine.statistics().invalidWalks);
  }
  return changed / kFrames / settings.numberOfWalks;
}

/// The size of the ring, in m, with which about that share of the walks changes in a frame. It
/// depends on how far walks go.
double findRingSize(double share, EngineSettings settings)
{
  constexpr int kHalvings = 7;
  settings.numberOfWalks = std::min(settings.numberOfWalks, 100000u);
  double small = 0.1, large = 1.8;
  for (int i = 0; i < kHalvings; ++i)
  {
    const double middle = std::sqrt(small * large);
    (shareChanged(makePlainRoom(middle), settings) < share ? small : large) = middle;
  }
  return std::sqrt(small * large);
}

struct FrameCase
{
  const char* name;
  double share; ///< of the walks that change
  Goal goal;
};

/// Every frame is shot by the tracer too, which is given the scene as it is then.
void timeFrames(const std::string& name, const MovingScene& scene, const EngineSettings& settings,
  int rounds, int frames, const Goal& goal)
{
  const Contest contest(scene.at(0), settings);
  const std::string row = "frame, " + name;
  Errors errors;
  std::vector<double> quotients;
  for (int round = 0; round < rounds; ++round)
  {
    const EngineSettings own = withSeed(settings, static_cast<std::uint64_t>(round) + 1);
    IrradianceEngine engine;
    const Shot first = shoot(engine, scene.at(0), own);
    errors.ours.add(contest.squaredError(first));
    errors.theirs.add(contest.squaredError(contest.theirs(contest.tracer(), own.seed)));
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
    report(
      kTable, row, "plain tracer's time at equal error / update", errors.gain() * quotient, goal);
  }
}

void timeFramesOfRing(
  const FrameCase& which, const EngineSettings& settings, int rounds, int frames)
{
  const double size = findRingSize(which.share, settings);
  const std::string name = std::string(which.name) + " of the walks changed";
  report(kTable, "frame, " + name, "ring, m", size);
  timeFrames(name, makePlainRoom(size), settings, rounds, frames, which.goal);
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
  const Contest inRoom(room.at(0), settings);
  const double gain = timeShooting(room.name, inRoom, rounds, { 0.95, 1.25 });
  timeOtherWays(room.name, inRoom, gain, rounds);
  timeShooting("moving teapot", { teapot.at(0), settings }, rounds, { 0.95, 1.25 });
  if (const std::optional<SceneObjects> dragon = makeDragonRoom())
  {
    timeShooting("room with the dragon", { *dragon, settings }, rounds, { 0.95, 1.25 });
  }
  for (const FrameCase& which : { FrameCase{ "3.5 %", 0.035, { 9, 12 } },
         FrameCase{ "2 %", 0.02, { 12, 16 } }, FrameCase{ "1 %", 0.01, { 18, 26 } } })
  {
    timeFramesOfRing(which, settings, rounds, frames);
  }
  EngineSettings gathering = settings;
  gathering.gathersDirectLight = true;
  timeFrames("2 % of the walks changed, direct light gathered",
    makePlainRoom(findRingSize(0.02, settings)), gathering, rounds, frames, { 15, 28 });
  timeFrames("64 movers", makeRoomOfMovers(64, 0.13), settings, rounds, frames, { 3, 5 });
  timeFrames("200 movers", makeRoomOfMovers(200, 0.085), settings, rounds, frames, { 2.5, 4 });
  IrradianceEngine engine;
  timeUpdate(engine, room.at(0), settings);
  report(kTable, "history, plain room", "bytes a segment",
    static_cast<double>(engine.statistics().historyBytes) /
      static_cast<double>(engine.balance().segments),
    { 38, 34 });
  timeThreads(room, settings, rounds, frames);
}
