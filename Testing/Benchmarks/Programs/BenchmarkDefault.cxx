// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a user gets who chooses nothing, beside each way that could be chosen, wherever light may
 * come from (Scenes/LightingScenes.h).
 *
 * The efficiency is 1 / (squared RMS error over the area x CPU time), the geometric mean of that on
 * the walls and that on the mover, of a first frame and of an update after the mover went on; an
 * update's error is a first frame's, as it equals a fresh start. The truth is what long runs of
 * shot walks, and of unbiased rays for small cells, find together, twice, and the ways' means are
 * told beside it. Coverage is how much of the area, and of the cells, has the truth in its 95 %
 * interval; the truth's own noise counts. The plain tracer (Rivals/PlainTracer.h) shoots as many
 * walks, anew in each frame. One thread, in turns.
 *
 * In rooms with tubes and a panel, the dose of the mover over 30 steps: its noise, from two seeds,
 * and its time.
 *
 * Arguments: [walks = 400000] [rounds = 3] [scenes = all: from which] [to which]
 */
#include "Estimates/AutomaticChoice.h"
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Scenes/LightingScenes.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace irradiance;

namespace
{

const std::string kTable = "Default";
const std::string kErrors = "DefaultErrors";
const std::string kCoverage = "DefaultCoverage";
const std::string kPlain = "DefaultPlain";
const std::string kDose = "DefaultDose";

/// A way to know the light of a scene.
struct Way
{
  std::string name;
  EngineSettings settings;
  LeftToScene left = {};
};

std::vector<Way> makeWays(std::uint32_t walks)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.separateSides = false;
  EngineSettings spread = settings;
  spread.cellEstimate = CellEstimate::Spread;
  EngineSettings sums = settings;
  sums.gathersDirectLight = true;
  EngineSettings gatheredSpread = sums;
  gatheredSpread.cellEstimate = CellEstimate::Spread;
  EngineSettings gathered = sums;
  gathered.cellEstimate = CellEstimate::Gathered;
  return { { "default", sums, { true, true } }, { "walks", settings }, { "walks spread", spread },
    { "gathered", sums }, { "gathered, spread", gatheredSpread },
    { "gathered, small cells too", gathered } };
}

CellField shootField(const SceneObjects& objects, EngineSettings settings, std::uint64_t seed)
{
  settings.verify = false;
  return shootNew(objects, withSeed(settings, seed)).irradiance;
}

HalvedTruth findTruth(const LightingScene& scene, std::uint32_t walks)
{
  constexpr std::uint64_t kSeed = 100000;
  SceneObjects objects = scene.at(0);
  if (scene.truthIn)
  {
    objects.staticObject = *scene.truthIn;
  }
  EngineSettings shot;
  shot.numberOfWalks = 16 * walks;
  EngineSettings gathered;
  gathered.numberOfWalks = walks;
  gathered.gathersDirectLight = true;
  gathered.cellEstimate = CellEstimate::Gathered;
  gathered.unbiasedGather = true;
  gathered.gatherRays = 64;
  const std::vector<CellSet> sets = cellSetsOf(objects);
  return combined({ shootField(objects, shot, kSeed), shootField(objects, shot, kSeed + 1) },
    { shootField(objects, gathered, kSeed), shootField(objects, gathered, kSeed + 1) },
    areasOf(objects), { sets[1], sets[2] });
}

/// What a way costs in a scene: seconds, and squared errors of walls and mover.
struct Found
{
  std::vector<double> first, update;
  Mean walls, small, meanOfWalls, meanOfSmall;

  double cost(const std::vector<double>& seconds) const
  {
    return std::sqrt(walls.value() * small.value()) * medianOf(seconds);
  }
};

class Contestants
{
public:
  Contestants(const LightingScene& scene, std::uint32_t walks)
    : scene_(scene)
    , truth_(findTruth(scene, walks))
    , areas_(areasOf(scene.at(0)))
    , sets_(cellSetsOf(scene.at(0)))
    , ways_(makeWays(walks))
    , plainScene_(makePlainScene(scene.inFrame(0)))
    , tracer_(plainScene_)
  {
    found_.resize(ways_.size());
    if (scene.truthIn)
    {
      sets_[1].count = 6 * 10 * 10; // in the hut
    }
    Found warmUp;
    add(ways_[0], 0, warmUp);
  }

  void addRound(std::uint64_t seed)
  {
    for (std::size_t i = 0; i < ways_.size(); ++i)
    {
      add(ways_[i], seed, found_[i]);
    }
    const Shot shot =
      shoot(tracer_, scene_.inFrame(0), plainScene_, withSeed(ways_[0].settings, seed));
    plain_.first.push_back(shot.seconds);
    addErrors(shot.irradiance, plain_);
  }

  void report(int rounds) const
  {
    double leastFirst = std::numeric_limits<double>::infinity(), leastUpdate = leastFirst;
    for (std::size_t i = 0; i < ways_.size(); ++i)
    {
      const Found& its = found_[i];
      const std::string row = scene_.name + ", " + ways_[i].name;
      ::report(kErrors, row, "RMS error on walls", std::sqrt(its.walls.value()));
      ::report(kErrors, row, "RMS error on small cells", std::sqrt(its.small.value()));
      ::report(kErrors, row, "mean of walls / truth", its.meanOfWalls.value());
      ::report(kErrors, row, "mean of small cells / truth", its.meanOfSmall.value());
      ::report(kErrors, row, "first frame, s", its.first);
      ::report(kErrors, row, "update, s", its.update);
      leastFirst = std::min(leastFirst, its.cost(its.first));
      leastUpdate = std::min(leastUpdate, its.cost(its.update));
    }
    ::report(kTable, scene_.name, "default / best, first",
      leastFirst / found_[0].cost(found_[0].first), { 0.7, 1 });
    ::report(kTable, scene_.name, "default / best, update",
      leastUpdate / found_[0].cost(found_[0].update), { 0.5, 1 });
    reportBesidePlain();
    reportCoverage(5 * rounds);
  }

private:
  void add(const Way& way, std::uint64_t seed, Found& found) const
  {
    IrradianceEngine engine;
    const SceneObjects start = scene_.inFrame(0);
    const auto secondsOf = [&](const SceneObjects& objects) {
      CpuTime execution;
      const double before = execution.seconds();
      const EngineSettings settings =
        engine.chosen(way.left, objects, withSeed(way.settings, seed), execution);
      const double choosing = execution.seconds() - before;
      return choosing + timeUpdate(engine, objects, settings).whole;
    };
    found.first.push_back(secondsOf(start));
    addErrors(irradianceOf(engine, start), found);
    for (int frame = 1; frame <= 2; ++frame)
    {
      found.update.push_back(secondsOf(scene_.inFrame(frame)));
    }
  }

  void addErrors(const CellField& field, Found& found) const
  {
    const CellField right = 0.5 * (truth_.first + truth_.second);
    const auto ratio = [&](const CellSet& set) {
      return meanOf(set.of(field), set.of(areas_)) / meanOf(set.of(right), set.of(areas_));
    };
    found.walls.add(truth_.squaredError(field, areas_, sets_[1]));
    found.small.add(truth_.squaredError(field, areas_, sets_[2]));
    found.meanOfWalls.add(ratio(sets_[1]));
    found.meanOfSmall.add(ratio(sets_[2]));
  }

  /// How much more efficient the default is.
  void reportBesidePlain() const
  {
    for (const auto& [name, error] :
      { std::pair{ "walls", &Found::walls }, { "small cells", &Found::small } })
    {
      const Found& ours = found_[0];
      const double plain = (plain_.*error).value() * medianOf(plain_.first);
      const auto add = [&, error = error](
                         const std::string& what, const std::vector<double>& seconds) {
        ::report(kPlain, scene_.name, what, plain / ((ours.*error).value() * medianOf(seconds)));
      };
      add(std::string(name) + ", first", ours.first);
      add(std::string(name) + ", update", ours.update);
    }
  }

  /// Of the default's intervals, over many seeds: the cells of a part share what they draw on.
  void reportCoverage(int seeds) const
  {
    std::array<Coverage, 2> sums; // walls, small cells
    for (int seed = 1; seed <= seeds; ++seed)
    {
      addIntervals(static_cast<std::uint64_t>(seed), sums);
    }
    for (std::size_t i = 0; i < 2; ++i)
    {
      const Coverage& sum = sums[i];
      const std::string name = i == 0 ? "walls" : "small cells";
      ::report(kCoverage, scene_.name, name + ": held, of the area", sum.heldArea / sum.knownArea,
        { 0.93, 0.94 });
      ::report(kCoverage, scene_.name, name + ": held, of the cells",
        sum.heldCells / sum.knownCells, { 0.93, 0.94 });
      ::report(kCoverage, scene_.name, name + ": known, of the area", sum.knownArea / sum.area);
    }
  }

  struct Coverage
  {
    double area = 0, knownArea = 0, heldArea = 0; ///< m2
    double knownCells = 0, heldCells = 0;
  };

  void addIntervals(std::uint64_t seed, std::array<Coverage, 2>& sums) const
  {
    IrradianceEngine engine;
    CpuTime execution;
    const SceneObjects objects = scene_.inFrame(0);
    EngineSettings settings = withSeed(ways_[0].settings, seed);
    settings.replicates = 16;
    settings.verify = false;
    settings = engine.chosen(ways_[0].left, objects, settings, execution);
    engine.update(objects, settings, execution);
    const ErrorEstimate errors = engine.errorEstimate();
    const double factor = ErrorEstimate::confidenceFactor(settings.replicates);
    const CellField halfWidths =
      fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double area) {
        return area > 0 ? factor * engine.watts(errors.standardError({ object, cell }, 0)) / area
                        : 0;
      });
    const CellField off =
      (irradianceOf(engine, objects) - 0.5 * (truth_.first + truth_.second)).abs();
    const CellField difference = truth_.first - truth_.second;
    for (std::size_t i = 0; i < 2; ++i)
    {
      const CellSet& set = sets_[i + 1];
      Coverage& sum = sums[i];
      // Of the truth: that of one cell is not known well.
      const double noise = 0.5 * std::sqrt(meanOf(set.of(difference.square()), set.of(areas_)));
      for (Eigen::Index cell = set.first; cell < set.end(); ++cell)
      {
        sum.area += areas_[cell];
        if (!std::isnan(halfWidths[cell]) && areas_[cell] > 0)
        {
          const bool isHeld = off[cell] <= std::hypot(halfWidths[cell], 2 * noise);
          sum.knownArea += areas_[cell];
          sum.knownCells += 1;
          sum.heldArea += isHeld ? areas_[cell] : 0;
          sum.heldCells += isHeld ? 1 : 0;
        }
      }
    }
  }

  const LightingScene& scene_;
  HalvedTruth truth_;
  CellField areas_;
  std::vector<CellSet> sets_;
  std::vector<Way> ways_;
  std::vector<Found> found_;
  PlainScene plainScene_;
  PlainTracer tracer_;
  Found plain_;
};

/// What the mover receives in 30 steps, each of one second.
CellField doseOf(const LightingScene& scene, const Way& way, std::uint64_t seed)
{
  IrradianceEngine engine;
  CpuTime execution;
  CellField dose;
  for (int frame = 0; frame < 30; ++frame)
  {
    const SceneObjects objects = scene.inFrame(frame);
    const EngineSettings settings =
      engine.chosen(way.left, objects, withSeed(way.settings, seed), execution);
    engine.update(objects, settings, execution);
    const CellField field = cellSetsOf(objects)[2].of(irradianceOf(engine, objects));
    dose = frame == 0 ? field : CellField(dose + field);
  }
  return dose;
}

void reportDose(const LightingScene& scene, std::uint32_t walks)
{
  const SceneObjects objects = scene.at(0);
  const CellField areas = cellSetsOf(objects)[2].of(areasOf(objects));
  double least = std::numeric_limits<double>::infinity(), ofDefault = 0;
  for (const Way& way : makeWays(walks))
  {
    const double start = threadCpuSeconds();
    const CellField one = doseOf(scene, way, 1), other = doseOf(scene, way, 2);
    const double seconds = (threadCpuSeconds() - start) / 2;
    const double noise =
      std::sqrt(meanOf((one - other).square().eval(), areas) / 2) / meanOf(one, areas);
    report(kDose, scene.name + ", " + way.name, "noise", noise);
    report(kDose, scene.name + ", " + way.name, "30 steps, s", seconds);
    const double cost = noise * noise * seconds;
    ofDefault = ofDefault == 0 ? cost : ofDefault; // the first way
    least = std::min(least, cost);
  }
  report("DefaultDoseRatios", scene.name, "default / best", least / ofDefault, { 0.8, 1.5 });
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 400000u);
  const int rounds = std::max(1, arguments.number(1, 3));
  flushDenormals();
  const std::vector<LightingScene> scenes = makeLightingScenes();
  const std::size_t end = std::min(scenes.size(), arguments.number(3, scenes.size()));
  for (std::size_t i = arguments.number(2, std::size_t{ 0 }); i < end; ++i)
  {
    Contestants contestants(scenes[i], walks);
    for (int round = 0; round < rounds; ++round)
    {
      contestants.addRound(static_cast<std::uint64_t>(round) + 1);
    }
    contestants.report(rounds);
    if (scenes[i].name.find("tubes") == 0 || scenes[i].name == "panel")
    {
      reportDose(scenes[i], walks);
    }
    std::fflush(stdout);
  }
}
