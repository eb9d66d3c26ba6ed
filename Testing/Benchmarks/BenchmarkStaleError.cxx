/**
 * What a budget of time for the repair leaves undone: a scene moves on, frame by frame, without a
 * pause, and the error is the difference from the full update, which is repaired to the end. Budgets
 * are parts of the time that the full repair of the frame takes, in CPU time of the one thread. The
 * bounds of what is stale are checked in every frame; when the motion stops, calls with the same
 * budget have to lead to the full update, to the bit.
 *
 * Arguments: [walks = 262144] [frames = 8] [head.off]
 */
#include "CellField.h"
#include "CpuTime.h"
#include "Program.h"
#include "Results.h"
#include "TradeScene.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

using namespace irradiance;

namespace
{

const char* const kTable = "StaleError";
constexpr double kStep = 1 / 60.0; ///< of time from frame to frame
constexpr double kStarts[] = { 0.2, 0.4, 0.6 };

/// What is right in a frame.
struct Truth
{
  SceneObjects objects;
  double seconds; ///< of the repair
  CellField irradiance;
};

/// The full update of every frame after the first.
std::vector<Truth> truthsOf(
  const TradeScene& scene, double first, int frames, const EngineSettings& settings)
{
  CpuTime execution;
  IrradianceEngine engine;
  std::vector<Truth> truths;
  for (int frame = 0; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.at(first + frame * kStep);
    const double start = execution.seconds();
    engine.update(objects, settings, execution);
    const EngineStatistics& cost = engine.statistics();
    const double repair = (execution.seconds() - start) * cost.repairSeconds /
      (cost.repairSeconds + cost.verifySeconds + cost.shootSeconds);
    truths.push_back({ objects, repair, irradianceOf(engine, objects) });
  }
  return truths;
}

CellField staleOf(const IrradianceEngine& engine, const SceneObjects& objects)
{
  CellField stale;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      stale.push_back(engine.staleIrradiance(object, cell, 0, 0, areas[cell]));
    }
  }
  return stale;
}

/// How much of the bounds the full update uses up.
struct BoundsUse
{
  double loss; ///< of the cell where it is most
  double gain; ///< of all cells together; NaN where no bound is known
};

/// Throws std::runtime_error when it is more than all.
BoundsUse boundsUse(const IrradianceEngine& engine, const Truth& truth)
{
  const CellField areas = areasOf(truth.objects), stale = staleOf(engine, truth.objects),
                  now = irradianceOf(engine, truth.objects);
  const double rounding = 1e-12 * meanOf(truth.irradiance, areas);
  BoundsUse use{ 0, 0 };
  double gain = 0;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const double loss = now[i] - truth.irradiance[i];
    if (loss > stale[i] + rounding)
    {
      throw std::runtime_error("cell " + std::to_string(i) + " loses more than its stale part");
    }
    use.loss = stale[i] > 0 ? std::max(use.loss, loss / stale[i]) : use.loss;
    gain += areas[i] * (stale[i] - loss);
  }
  const double bound = engine.staleGainBound(0);
  if (gain > bound * (1 + 1e-9) + 1e-9 * rounding)
  {
    throw std::runtime_error("the cells gain more than the stale walks can carry");
  }
  use.gain = std::isinf(bound) ? std::nan("") : bound > 0 ? gain / bound : 0;
  return use;
}

/// Values for each start.
struct Figures
{
  std::vector<double> first, last, stale, loss, gain, calls;

  void give(const std::string& row, int percent, Results& results) const
  {
    results.add(kTable, row, "budget, % of the full repair", { double(percent) });
    results.add(kTable, row, "RMS error after the first frame", first);
    results.add(kTable, row, "RMS error at the end", last);
    results.add(kTable, row, "StalePower at the end, % of the emitted", stale);
    results.add(kTable, row, "largest loss / StaleIrradiance", loss);
    results.add(kTable, row, "gain / StaleGainBound", gain);
    if (!calls.empty())
    {
      results.add(kTable, row, "calls to be exact", calls);
    }
  }
};

/// Calls without motion until nothing is stale.
int finish(IrradianceEngine& engine, const Truth& truth, const EngineSettings& settings)
{
  CpuTime execution;
  int calls = 0;
  while (!engine.stale()->isEmpty())
  {
    engine.update(truth.objects, settings, execution);
    ++calls;
  }
  if (irradianceOf(engine, truth.objects) != truth.irradiance)
  {
    throw std::runtime_error("many repairs within a budget and the full update differ");
  }
  return calls;
}

void measure(
  const std::vector<Truth>& truths, const EngineSettings& settings, double part, Figures& figures)
{
  constexpr double kLeast = 1e-6; // s: only the first few walks
  CpuTime execution;
  EngineSettings own = settings;
  own.repairTimeBudget = 1;
  IrradianceEngine engine;
  engine.update(truths[0].objects, own, execution);
  BoundsUse most{ 0, 0 };
  for (std::size_t frame = 1; frame < truths.size(); ++frame)
  {
    const Truth& truth = truths[frame];
    own.repairTimeBudget = std::max(part * truth.seconds, kLeast);
    engine.update(truth.objects, own, execution);
    const BoundsUse use = boundsUse(engine, truth);
    most.loss = std::max(most.loss, use.loss);
    most.gain = std::isnan(use.gain) ? use.gain : std::max(most.gain, use.gain);
    if (frame == 1 || frame + 1 == truths.size())
    {
      (frame == 1 ? figures.first : figures.last)
        .push_back(
          rmsError(irradianceOf(engine, truth.objects), truth.irradiance, areasOf(truth.objects)));
    }
  }
  figures.loss.push_back(most.loss);
  figures.gain.push_back(most.gain);
  figures.stale.push_back(
    100 * double(engine.stale()->power()[0]) / double(engine.balance().emitted[0]));
  if (part > 0)
  {
    figures.calls.push_back(finish(engine, truths.back(), own));
  }
}

void run(int argc, char* argv[])
{
  EngineSettings settings;
  settings.numberOfWalks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1u << 18;
  const int frames = argc > 2 ? std::atoi(argv[2]) : 8;
  Results results("BenchmarkStaleError");
  for (const TradeScene& scene : makeTradeScenes(argc > 3 ? argv[3] : VTKIRRADIANCE_HEAD))
  {
    std::vector<std::vector<Truth>> truths;
    for (const double start : kStarts)
    {
      truths.push_back(truthsOf(scene, start, frames, settings));
    }
    for (const int percent : { 0, 10, 25, 50, 75, 100, 150 })
    {
      Figures figures;
      for (const std::vector<Truth>& truth : truths)
      {
        measure(truth, settings, 0.01 * percent, figures);
      }
      figures.give(scene.name + ", budget " + std::to_string(percent) + " %", percent, results);
    }
  }
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
