// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a budget of time for the repair leaves undone: a scene moves on without a pause, and the
 * error is the difference from the full update. Budgets are parts of the time that the full repair
 * of the frame takes, in CPU time of the one thread. The bounds of what is stale are checked in
 * every frame; when the motion stops, calls with the same budget have to lead to the full update,
 * to the bit. There is a value for each of some starts.
 *
 * Arguments: [walks = 262144] [frames = 8] [head.off]
 */
#include "../../PhotonWalks/OnlySet.h"
#include "Measuring/CellField.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Scenes/TradeScene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

struct Frame
{
  Truth truth;
  double seconds; ///< of the repair
};

/// The full update of the first frame, at this time, and of every frame after it.
std::vector<Frame> framesOf(
  const TradeScene& scene, double first, int frames, const EngineSettings& settings)
{
  IrradianceEngine engine;
  std::vector<Frame> steps;
  for (int frame = 0; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.at(first + frame * MovingScene::kFrame);
    const double repair = timeUpdate(engine, objects, settings).repair;
    steps.push_back({ { objects, irradianceOf(engine, objects) }, repair });
  }
  return steps;
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
  const CellField stale =
    fieldOf(truth.objects, [&](std::uint32_t object, std::size_t cell, double area) {
      return engine.staleIrradiance({ object, cell }, 0);
    });
  const CellField loss = irradianceOf(engine, truth.objects) - truth.irradiance;
  const double rounding = 1e-12 * meanOf(truth.irradiance, truth.areas);
  if ((loss > stale + rounding).any())
  {
    throw std::runtime_error("a cell loses more than its stale part");
  }
  const double gain = (truth.areas * (stale - loss)).sum(), bound = engine.staleGainBound(0);
  if (gain > bound * (1 + 1e-9) + 1e-9 * rounding)
  {
    throw std::runtime_error("the cells gain more than the stale walks can carry");
  }
  const CellField used = (stale > 0).select(loss / stale, 0);
  return { std::max(0.0, used.maxCoeff()),
    std::isinf(bound) ? std::nan("")
      : bound > 0     ? gain / bound
                      : 0 };
}

/// Calls without motion until nothing is stale.
int finish(IrradianceEngine& engine, const Truth& truth, const EngineSettings& settings)
{
  int calls = 0;
  while (!test::onlySet(engine).stale()->isEmpty())
  {
    timeUpdate(engine, truth.objects, settings);
    ++calls;
  }
  truth.require(irradianceOf(engine, truth.objects), "many repairs within a budget");
  return calls;
}

void measure(
  const std::vector<Frame>& steps, EngineSettings settings, int percent, const std::string& row)
{
  constexpr double kLeast = 1e-6; // s: only the first few walks
  const auto reportValue = [&](const char* quantity, double value) {
    report("StaleError", row, quantity, value);
  };
  reportValue("budget, % of the full repair", percent);
  settings.repairTimeBudget = 1;
  IrradianceEngine engine;
  timeUpdate(engine, steps[0].truth.objects, settings);
  BoundsUse most{ 0, 0 };
  for (std::size_t frame = 1; frame < steps.size(); ++frame)
  {
    const Truth& truth = steps[frame].truth;
    settings.repairTimeBudget = std::max(0.01 * percent * steps[frame].seconds, kLeast);
    timeUpdate(engine, truth.objects, settings);
    const BoundsUse use = boundsUse(engine, truth);
    most.loss = std::max(most.loss, use.loss);
    most.gain = std::isnan(use.gain) ? use.gain : std::max(most.gain, use.gain);
    const double error = truth.rmsError(engine);
    if (frame == 1)
    {
      reportValue("RMS error after the first frame", error);
    }
    if (frame + 1 == steps.size())
    {
      reportValue("RMS error at the end", error);
    }
  }
  reportValue("StalePower at the end, % of the emitted",
    100 * double(test::onlySet(engine).stale()->power()[0]) / double(engine.balance().emitted[0]));
  reportValue("largest loss / StaleIrradiance", most.loss);
  reportValue("gain / StaleGainBound", most.gain);
  if (percent > 0)
  {
    reportValue("calls to be exact", finish(engine, steps.back().truth, settings));
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1u << 18);
  const int frames = arguments.number(1, 8);
  for (const TradeScene& scene : makeTradeScenes(arguments.text(2, VTKIRRADIANCE_HEAD)))
  {
    for (const double start : { 0.2, 0.4, 0.6 })
    {
      const std::vector<Frame> steps = framesOf(scene, start, frames, settings);
      for (const int percent : { 0, 10, 25, 50, 75, 100, 150 })
      {
        measure(
          steps, settings, percent, scene.name + ", budget " + std::to_string(percent) + " %");
      }
    }
  }
}
