// SPDX-License-Identifier: BSD-3-Clause
/**
 * What changes of lamps cost as updates, by light groups, and what a sheet of glass costs. CPU time
 * of the one thread; each update must have the bits of a fresh start before it counts.
 *
 * A room of 4 x 4 x 3 m with 14 x 14 cells a side, which reflects half of the light, and a ball of
 * .6 m and 3,000 cells:
 * - the factor of one of four lamps changes, beside a frame in which the ball moves so far that
 *   some 3 % of the walks change; how many walks and rays are cast;
 * - one of 16 lamps moves, beside the first frame;
 * - a lamp on a robot moves in each frame and three lamps rest, beside the first frame;
 * - a pane of clear glass hangs below the only lamp, from wall to wall, so that all light passes it,
 *   beside the same scene without it: time x squared noise, each beside its own mean;
 * each with Method Walks and with what a user gets who chooses nothing.
 *
 * Arguments: [walks of all groups = 800000] [rounds = 5]
 */
#include "../../PhotonWalks/Sheets.h"
#include "LightGroups.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"

#include <stdexcept>

using namespace irradiance;
using namespace irradiance::test;

namespace
{

const std::string kTable = "Changes";
const std::string kFigures = "ChangesFigures";

/// How all groups are computed.
struct Way
{
  std::string name;
  LeftToScene left;
  bool mayGather;
};

const std::vector<Way> kWays{ { "Walks", {}, false }, { "default", { true, true }, true } };

/// A scene with some lamps, each of them a group.
struct LampScene
{
  SceneObjects objects;
  std::vector<LampGroup> groups;

  /// `first`: of the dynamic objects that are lamps.
  LampScene(int lamps, bool areDynamic)
  {
    ObjectBuilder room = plainRoom({ 4, 4, 3 }, 14, grey(0.5));
    std::vector<std::uint32_t> ofCells(room.material().reflectance.size(), 0);
    const int rows = lamps > 4 ? 4 : 2;
    for (int i = 0; i < lamps; ++i)
    {
      groups.push_back({ "lamp " + std::to_string(10 + i), true });
      const Vector3 place(4.0 * (i % rows + 0.5) / rows, 4.0 * (i / rows + 0.5) / rows, 2.8);
      if (areDynamic)
      {
        ObjectBuilder lamp;
        addPanel(lamp, { -0.2, -0.2, 0 }, 0.4, 0.4, 100);
        objects.dynamicObjects.push_back(lamp.build(shift(place)));
        auto emission = std::make_shared<Emission>(*objects.dynamicObjects.back().emission);
        emission->group = static_cast<std::uint32_t>(i);
        objects.dynamicObjects.back().emission = emission;
      }
      else
      {
        addPanel(room, place - Vector3(0.2, 0.2, 0), 0.4, 0.4, 100);
        ofCells.push_back(static_cast<std::uint32_t>(i));
      }
    }
    objects.staticObject = room.build();
    if (!areDynamic)
    {
      auto emission = std::make_shared<Emission>(*objects.staticObject.emission);
      emission->groups = ofCells;
      objects.staticObject.emission = emission;
    }
    objects.dynamicObjects.push_back(ball({ 1, 2, 1 }, 0.3, 38));
  }
  SceneObject& thing() { return objects.dynamicObjects.back(); }
};

class Run
{
public:
  Run(const Way& way, std::uint32_t walks, std::uint64_t seed = 1)
    : way_(way)
  {
    settings_.seed = seed;
    settings_.numberOfWalks = walks;
    settings_.gathersDirectLight = way.mayGather;
  }

  /// Returns its CPU time.
  double update(const LampScene& scene)
  {
    return threadCpuSecondsOf([&] {
      groups_.update(
        { scene.objects, scene.groups, 0, way_.left, settings_, [](const auto&, const auto&) {} },
        execution_);
    });
  }
  /// Compares with a fresh start, and returns the CPU time of that.
  double checked(const LampScene& scene) const
  {
    Run fresh(way_, settings_.numberOfWalks);
    const double seconds = fresh.update(scene);
    groups_.any().cells().numbers().forEach([&](const SceneCell& cell) {
      if (groups_.irradiance({ cell }, 0) != fresh.groups_.irradiance({ cell }, 0))
      {
        throw std::runtime_error(way_.name + ": an update differs from a fresh start in cell " +
          std::to_string(cell.cell) + " of object " + std::to_string(cell.object));
      }
    });
    return seconds;
  }
  const LightGroups& groups() const { return groups_; }

private:
  Way way_;
  EngineSettings settings_;
  Execution execution_;
  LightGroups groups_;
};

void compareFactor(const Way& way, std::uint32_t walks, int rounds)
{
  LampScene scene(4, false);
  Run run(way, walks / 4);
  run.update(scene);
  std::vector<double> factors, frames, changed, cast;
  for (int round = 0; round < rounds; ++round)
  {
    scene.thing().worldFromObject = shift({ 1 + 0.15 * (round + 1), 2, 1 });
    frames.push_back(run.update(scene));
    changed.push_back(run.groups().count([](const IrradianceEngine& engine) {
      return static_cast<double>(engine.statistics().invalidWalks);
    }) /
      walks);
    scene.groups[1].factor = { { 0.5 + round, 0, 0 } };
    factors.push_back(run.update(scene));
    cast.push_back(run.groups().count([](const IrradianceEngine& engine) {
      const EngineStatistics& statistics = engine.statistics();
      return static_cast<double>(statistics.suspectSegments + statistics.repairedSegments +
        statistics.followedPaths + (statistics.shootSeconds > 0 ? 1 : 0));
    }));
    run.checked(scene);
  }
  const std::string row = "a factor changes, " + way.name;
  report(kTable, row, "time / a frame's", ratios(factors, frames), { 0.2, 0.01 });
  report(kTable, row, "walks and rays cast", cast, { 0, 0 });
  report(kFigures, row, "walks that change in that frame", changed);
  report(kFigures, row, "s", factors);
}

/// `lamps`: of which one moves in each frame.
void compareMotion(const std::string& what, int lamps, const Goal& goal, const Way& way,
  std::uint32_t walks, int rounds)
{
  LampScene scene(lamps, true);
  Run run(way, walks / static_cast<std::uint32_t>(lamps));
  run.update(scene);
  std::vector<double> updates, starts;
  for (int round = 0; round < rounds; ++round)
  {
    scene.objects.dynamicObjects[0].worldFromObject = shift({ 1 + 0.1 * round, 1.2, 2.5 });
    updates.push_back(run.update(scene));
    starts.push_back(run.checked(scene));
  }
  const std::string row = what + ", " + way.name;
  report(kTable, row, "time / first frame's", ratios(updates, starts), goal);
  report(kFigures, row, "s", updates);
  report(kFigures, row, "s of a first frame", starts);
}

struct Cost
{
  double seconds, noise; ///< the square of it beside that of the mean
  double mean;
};

Cost costOf(const LampScene& scene, const Way& way, std::uint32_t walks, int rounds)
{
  std::vector<double> seconds, sums, squares;
  for (int round = 0; round < rounds; ++round)
  {
    Run run(way, walks, static_cast<std::uint64_t>(round) + 1);
    seconds.push_back(run.update(scene));
    std::size_t cell = 0;
    run.groups().any().cells().numbers().forEach([&](const SceneCell& at) {
      if (sums.size() == cell)
      {
        sums.push_back(0);
        squares.push_back(0);
      }
      const double light = run.groups().irradiance({ at }, 0);
      sums[cell] += light / rounds;
      squares[cell++] += light * light / rounds;
    });
  }
  double mean = 0, variance = 0;
  for (std::size_t cell = 0; cell < sums.size(); ++cell)
  {
    mean += sums[cell] / static_cast<double>(sums.size());
    variance += (squares[cell] - sums[cell] * sums[cell]) * rounds / (rounds - 1.0) /
      static_cast<double>(sums.size());
  }
  return { medianOf(seconds), variance / (mean * mean), mean };
}

void comparePane(const Way& way, std::uint32_t walks, int rounds)
{
  LampScene open(1, true), glazed = open;
  SceneObject pane =
    sheet(3.999, 1, grey(0), { 0, {}, 1.52, 0.95842 }); // .88 goes straight down through it
  pane.worldFromObject = shift({ 2, 2, 2.5 });
  glazed.objects.dynamicObjects.push_back(pane);
  const Cost without = costOf(open, way, walks, rounds), with = costOf(glazed, way, walks, rounds);
  const double time = with.seconds / without.seconds, noise = with.noise / without.noise;
  const std::string row = "a pane that all light passes, " + way.name;
  report(kTable, row, "time x squared noise / without it", time * noise, { 1.6, 1.3 });
  report(kFigures, row, "time / without it", time);
  report(kFigures, row, "mean irradiance / without it", with.mean / without.mean);
}

}

void run(const Arguments& arguments)
{
  const std::uint32_t walks = arguments.number(0, 800000u);
  const int rounds = arguments.number(1, 5);
  flushDenormals();
  for (const Way& way : kWays)
  {
    compareFactor(way, walks, rounds);
    compareMotion("one of 16 lamps moves", 16, { 0.15, 0.08 }, way, walks, rounds);
    compareMotion("a robot's lamp, three rest", 4, { 0.4, 0.25 }, way, walks, rounds);
    comparePane(way, walks / 4, 2 * rounds);
  }
}
