// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether a repair keeps to its budget of time, and what it gets done, on the scene of
 * Examples/MovingTeapot. Each frame is repaired in full by one engine, and by another one with a
 * part of that time as its budget, which then repairs the rest; the answers have to be equal. One
 * thread goes by its CPU time, two by the clock on the wall.
 *
 * Arguments: [walks = 1000000] [frames = 59] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Scenes/MovingTeapotScene.h"

#include <algorithm>
#include <limits>

using namespace irradiance;

namespace
{

const char* const kTable = "RepairBudget";
const char* const kInParts = "time with the rest / repair at once";

/// `percent`: the budget as a part of the time of the full repair; 100: endless.
void timeBudget(const MovingScene& scene, const EngineSettings& settings, int frames, int percent,
  Execution& execution, const std::string& threads)
{
  const bool isEndless = percent == 100;
  const std::string row = threads +
    (isEndless ? ", endless budget" : ", budget " + std::to_string(percent) + " % of the repair");
  IrradianceEngine full, timed;
  full.update(scene.at(0), settings, execution);
  timed.update(scene.at(0), settings, execution);
  double kept = 0;
  for (int frame = 1; frame <= frames; ++frame)
  {
    const SceneObjects objects = scene.inFrame(frame);
    const double whole = timeUpdate(full, objects, settings, execution).repair;
    const double budget = 0.01 * percent * whole;
    EngineSettings own = settings;
    own.repairTimeBudget = isEndless ? std::numeric_limits<double>::infinity() : budget;
    timed.update(objects, own, execution);
    const double taken = timed.statistics().repairSeconds;
    const auto shot = static_cast<double>(timed.statistics().repairedSegments);
    timed.update(objects, settings, execution);
    requireEqualAnswers(timed, full, objects);
    if (!isEndless)
    {
      const double excess = taken - budget;
      kept += excess <= std::max(0.2 * budget, 0.002) ? 1 : 0;
      report(kTable, row, "time / budget", taken / budget);
      report(kTable, row, "beyond the budget, ms", 1000 * excess);
      report(kTable, row, "segments shot, share of the full repair",
        shot / static_cast<double>(full.statistics().repairedSegments));
    }
    report(kTable, row, kInParts, (taken + timed.statistics().repairSeconds) / whole);
  }
  if (!isEndless)
  {
    report(kTable, row, "frames within 20 % or 2 ms, %", 100 * kept / frames);
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int frames = arguments.number(1, 59);
  const MovingScene scene = makeMovingTeapot(arguments.text(2, VTKIRRADIANCE_HEAD));
  CpuTime one;
  test::ThreadExecution two(2);
  for (const int percent : { 10, 50, 100 })
  {
    timeBudget(scene, settings, frames, percent, one, "one thread");
    timeBudget(scene, settings, frames, percent, two, "two threads");
  }
}
