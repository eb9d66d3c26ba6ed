/**
 * Whether a repair keeps to its budget of time, and what it gets done, on the scene of
 * Examples/MovingTeapot. Each frame is repaired in full by one engine, and by another one with a part
 * of that time as its budget, which then repairs the rest; the answers have to be equal. One thread
 * goes by its CPU time, two by the clock on the wall.
 *
 * Arguments: [walks = 1000000] [frames = 59] [head.off]
 */
#include "CpuTime.h"
#include "IrradianceEngine.h"
#include "MovingTeapotScene.h"
#include "Program.h"
#include "Results.h"
#include "TwoThreads.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

using namespace irradiance;

namespace
{

const char* const kTable = "RepairBudget";

void compareAnswers(
  const IrradianceEngine& a, const IrradianceEngine& b, const SceneObjects& objects)
{
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      if (a.sums().sum(object, cell, 0, 0) != b.sums().sum(object, cell, 0, 0))
      {
        throw std::runtime_error("The answers differ on object " + std::to_string(object) +
          ", cell " + std::to_string(cell));
      }
    }
  }
}

double meanPercent(const std::vector<double>& shares)
{
  return 100 * std::accumulate(shares.begin(), shares.end(), 0.0) /
    static_cast<double>(shares.size());
}

/// Without a budget the engine's own clocks are those on the wall: only their ratio is used.
double secondsOfRepair(IrradianceEngine& engine, const SceneObjects& objects,
  const EngineSettings& settings, Execution& execution)
{
  const double start = execution.seconds();
  engine.update(objects, settings, execution);
  const EngineStatistics& cost = engine.statistics();
  return (execution.seconds() - start) * cost.repairSeconds /
    (cost.repairSeconds + cost.verifySeconds);
}

/// Values for each frame.
struct Figures
{
  std::vector<double> overBudget; ///< time / budget
  std::vector<double> excess;     ///< ms
  std::vector<double> isKept;     ///< within 20 % or 2 ms: 1, else 0
  std::vector<double> done;       ///< share of the segments of the full repair
  std::vector<double> inParts;    ///< time for both parts / for all at once
};

Figures timeBudget(const MovingTeapotScene& scene, const EngineSettings& settings, int frames,
  double part, Execution& execution)
{
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  IrradianceEngine full, timed;
  full.update(scene.objectsAt(0), settings, execution);
  timed.update(scene.objectsAt(0), settings, execution);
  Figures figures;
  for (int frame = 1; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.objectsAt(frame * MovingTeapotScene::kFrame);
    const double whole = secondsOfRepair(full, objects, settings, execution);
    EngineSettings own = settings;
    own.repairTimeBudget = part < 1 ? part * whole : kEndless;
    timed.update(objects, own, execution);
    const double taken = timed.statistics().repairSeconds;
    const double excess = taken - part * whole;
    const auto shot = static_cast<double>(timed.statistics().repairedSegments);
    timed.update(objects, settings, execution);
    compareAnswers(timed, full, objects);
    figures.overBudget.push_back(taken / (part * whole));
    figures.excess.push_back(1000 * excess);
    figures.isKept.push_back(excess <= std::max(0.2 * part * whole, 0.002) ? 1 : 0);
    figures.inParts.push_back((taken + timed.statistics().repairSeconds) / whole);
    figures.done.push_back(shot / static_cast<double>(full.statistics().repairedSegments));
  }
  return figures;
}

void addRows(const MovingTeapotScene& scene, const EngineSettings& settings, int frames,
  Execution& execution, const std::string& threads, Results& results)
{
  for (const int percent : { 10, 50 })
  {
    const Figures figures = timeBudget(scene, settings, frames, 0.01 * percent, execution);
    const std::string row = threads + ", budget " + std::to_string(percent) + " % of the repair";
    results.add(kTable, row, "time / budget", figures.overBudget);
    results.add(kTable, row, "beyond the budget, ms", figures.excess);
    results.add(kTable, row, "frames within 20 % or 2 ms, %", { meanPercent(figures.isKept) });
    results.add(kTable, row, "segments shot, share of the full repair", figures.done);
    results.add(kTable, row, "time with the rest / repair at once", figures.inParts);
  }
  results.add(kTable, threads + ", endless budget", "time with the rest / repair at once",
    timeBudget(scene, settings, frames, 1, execution).inParts);
}

void run(int argc, char* argv[])
{
  EngineSettings settings;
  settings.numberOfWalks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1000000;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 59;
  const MovingTeapotScene scene(argc > 3 ? argv[3] : VTKIRRADIANCE_HEAD);
  Results results("BenchmarkRepairBudget");
  CpuTime one;
  TwoThreads two;
  addRows(scene, settings, frames, one, "one thread", results);
  addRows(scene, settings, frames, two, "two threads", results);
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
