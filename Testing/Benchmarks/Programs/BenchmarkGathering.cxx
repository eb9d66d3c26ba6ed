// SPDX-License-Identifier: BSD-3-Clause
/**
 * The first shooting beside two plain programs with Embree, one that shoots (Rivals/PlainTracer.h)
 * and one that gathers (Rivals/PlainGatherer.h), in rooms that favour the one or the other.
 *
 * The efficiency is 1 / (squared RMS error over the area x CPU time) on all cells, on walls and on
 * what moves. Who shoots has the same time for each of them. Who gathers has the time of those
 * cells alone, as a user would not bake others. Building Embree's scene is not counted, nor is
 * finding which backs are dark, which favours the rivals. The truth is what both rivals find
 * together, twice, and all must agree with it before any time counts. One thread, in turns. Where
 * small cells gather, with fewer walks, the sums that they read are means over cells: this bias is
 * allowed, and reported.
 *
 * Arguments: [walks = 1000000] [rounds = 6] [paths of a cell = 64] [those of half the truth = 1024]
 * [rooms = all]
 */
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Rivals/PlainGatherer.h"
#include "Scenes/PlainRoom.h"

#include <algorithm>
#include <cmath>
#include <utility>

using namespace irradiance;

namespace
{

const std::string kTable = "Gathering";
const std::string kAnswers = "GatheringAnswers";
const std::string kErrors = "GatheringErrors";

struct Sizes
{
  std::uint32_t walks, paths, truthPaths;
  int rounds;
};

/// What a contestant has found, and the time for each set of cells.
struct Run
{
  CellField irradiance;
  std::vector<double> seconds;
};

struct Contestant
{
  std::string name;
  std::function<Run(std::uint64_t seed)> run;
  double bias = 1e-3;         ///< that is allowed, of the mean irradiance
  std::vector<Run> runs = {}; ///< by round
};

/// A still room, and how all find its irradiance.
class Room
{
public:
  explicit Room(const SceneObjects& objects)
    : objects_(objects)
    , areas_(areasOf(objects))
    , sets_(cellSetsOf(objects))
    , plain_(makePlainScene(objects))
    , tracer_(plain_)
    , gatherer_(plain_)
  {
  }

  const std::vector<CellSet>& sets() const { return sets_; }
  const CellField& areas() const { return areas_; }

  Run shootOurs(const EngineSettings& settings) const
  {
    return alike(shootNew(objects_, settings));
  }
  Run shootPlain(const EngineSettings& settings) const
  {
    return alike(shoot(tracer_, objects_, plain_, settings));
  }
  /// First walls, then movers.
  Run gatherPlain(std::uint32_t paths, std::uint64_t seed) const
  {
    Run run{ CellField(areas_.size()), { 0, 0, 0 } };
    for (const std::size_t i : { 1, 2 })
    {
      const CellSet& set = sets_[i];
      const double start = threadCpuSeconds();
      const PlainGatherer::Tally tally = gatherer_.gather(static_cast<std::uint32_t>(set.first),
        static_cast<std::uint32_t>(set.end()), paths, seed + 1000 * i);
      run.seconds[i] = threadCpuSeconds() - start;
      run.irradiance.segment(set.first, set.count) =
        Eigen::Map<const CellField>(tally.irradiance.data(), set.count);
    }
    run.seconds[0] = run.seconds[1] + run.seconds[2];
    return run;
  }

private:
  Run alike(const Shot& shot) const
  {
    return { shot.irradiance, std::vector<double>(sets_.size(), shot.seconds) };
  }

  SceneObjects objects_;
  CellField areas_;
  std::vector<CellSet> sets_;
  PlainScene plain_;
  PlainTracer tracer_;
  PlainGatherer gatherer_;
};

/// The two rivals, then ours with each of its settings.
std::vector<Contestant> makeContestants(const Room& room, const Sizes& sizes)
{
  EngineSettings settings;
  settings.numberOfWalks = sizes.walks;
  std::vector<Contestant> contestants{
    { "plain tracer",
      [&room, settings](std::uint64_t seed) { return room.shootPlain(withSeed(settings, seed)); } },
    { "plain gatherer",
      [&room, sizes](std::uint64_t seed) { return room.gatherPlain(sizes.paths, seed); } }
  };
  const auto addOurs = [&](const std::string& name, double bias) {
    const auto run = [&room, settings](
                       std::uint64_t seed) { return room.shootOurs(withSeed(settings, seed)); };
    contestants.push_back({ "ours, " + name, run, bias });
  };
  addOurs("shot", 1e-3);
  settings.gathersDirectLight = true;
  addOurs("gathered", 1e-3);
  settings.cellEstimate = CellEstimate::Gathered;
  for (const std::uint32_t part : { 5u, 10u })
  {
    settings.numberOfWalks = std::max(1u, sizes.walks / part);
    addOurs("1/" + std::to_string(part) + ", small cells too", 0.03);
  }
  settings.gathersEverywhere = true;
  addOurs("1/10, all cells", 0.03);
  return contestants;
}

void compareAnswers(const std::string& scene, const Room& room,
  const std::vector<Contestant>& contestants, const HalvedTruth& truth)
{
  for (const Contestant& contestant : contestants)
  {
    std::vector<CellField> fields;
    for (const Run& run : contestant.runs)
    {
      fields.push_back(run.irradiance);
    }
    for (const CellSet& set : room.sets())
    {
      const Agreement agreement = requireAgreement(
        contestant.name + ", " + scene, fields, truth, room.areas(), set, contestant.bias);
      const std::string row = scene + ", " + set.name;
      report(kAnswers, row, contestant.name + ": mean / truth", agreement.ratio);
      report(kAnswers, row, contestant.name + ": systematic RMS", agreement.systematic);
    }
  }
}

/// Squared error x time, with the mean error of all rounds: that of a single run varies.
double costOf(const Contestant& contestant, const Room& room, const HalvedTruth& truth,
  std::size_t set, const std::string& row)
{
  Mean error;
  std::vector<double> seconds;
  for (const Run& run : contestant.runs)
  {
    error.add(truth.squaredError(run.irradiance, room.areas(), room.sets()[set]));
    seconds.push_back(run.seconds[set]);
  }
  report(kErrors, row, contestant.name + ": RMS error", std::sqrt(error.value()));
  report(kErrors, row, contestant.name + ": s", seconds);
  return error.value() * medianOf(seconds);
}

/// With the plain tracer's as the unit, and with that of the better of the two.
void reportEfficiencies(const std::string& scene, const Room& room,
  const std::vector<Contestant>& contestants, const HalvedTruth& truth)
{
  for (std::size_t set = 0; set < room.sets().size(); ++set)
  {
    const std::string row = scene + ", " + room.sets()[set].name;
    std::vector<double> costs;
    for (const Contestant& contestant : contestants)
    {
      costs.push_back(costOf(contestant, room, truth, set, row));
    }
    for (std::size_t i = 1; i < costs.size(); ++i)
    {
      report(kTable, row, contestants[i].name + " / plain tracer", costs[0] / costs[i]);
    }
    const double better = std::min(costs[0], costs[1]);
    for (std::size_t i = 2; i < costs.size(); ++i)
    {
      report(kTable, row, contestants[i].name + " / better of the two rivals", better / costs[i]);
    }
  }
}

/// By both rivals, so that it favours neither.
HalvedTruth findTruth(const Room& room, const Sizes& sizes)
{
  constexpr std::uint64_t kSeed = 100000; // those of rounds are smaller
  constexpr int kRuns = 16;               // as many walks as in so many runs
  EngineSettings settings;
  settings.numberOfWalks = kRuns * sizes.walks;
  const auto gathered = [&](std::uint64_t seed) {
    return room.gatherPlain(sizes.truthPaths, seed).irradiance;
  };
  const auto shot = [&](std::uint64_t seed) {
    return room.shootPlain(withSeed(settings, seed)).irradiance;
  };
  return combined({ gathered(kSeed), gathered(kSeed + 1) }, { shot(kSeed), shot(kSeed + 1) },
    room.areas(), { room.sets()[1], room.sets()[2] });
}

void compare(const MovingScene& scene, const Sizes& sizes)
{
  const Room room(scene.at(0));
  std::vector<Contestant> contestants = makeContestants(room, sizes);
  const HalvedTruth truth = findTruth(room, sizes);
  for (int round = 0; round < sizes.rounds; ++round)
  {
    for (Contestant& contestant : contestants)
    {
      contestant.runs.push_back(contestant.run(static_cast<std::uint64_t>(round) + 1));
    }
  }
  compareAnswers(scene.name, room, contestants, truth);
  reportEfficiencies(scene.name, room, contestants, truth);
}

}

void run(const Arguments& arguments)
{
  Sizes sizes{};
  sizes.walks = arguments.number(0, 1000000u);
  sizes.rounds = std::max(2, arguments.number(1, 6));
  sizes.paths = arguments.number(2, 64u);
  sizes.truthPaths = arguments.number(3, 1024u);
  flushDenormals();
  const std::vector<MovingScene> rooms = makeGatheringRooms();
  const std::size_t count = std::min(rooms.size(), arguments.number(4, rooms.size()));
  for (std::size_t i = 0; i < count; ++i)
  {
    compare(rooms[i], sizes);
  }
}
