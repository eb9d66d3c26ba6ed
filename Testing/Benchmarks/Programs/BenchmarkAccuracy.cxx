// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the error of the irradiance falls with time: by the number of walks, by the size of cells,
 * with error bars, and with a target. The truth is 1 W/m2 in the furnace and a much longer run with
 * another seed elsewhere. Errors are over the area and in units of the mean irradiance; times are
 * the CPU time of the one thread. There is a value for each of some seeds.
 *
 * Arguments: [walks of the reference = 16777216] [seeds = 3] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/CellField.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Scenes/TradeScene.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace irradiance;

namespace
{

constexpr int kLevels = 2;
constexpr std::uint64_t kReferenceSeed = 1000;
constexpr std::uint32_t kReplicates = 16;
constexpr std::uint32_t kUsualWalks = 1u << 18;

/// A scene, and what is right in it.
struct Truth
{
  Truth(const SceneObjects& ownObjects, const CellField& right)
    : objects(ownObjects)
    , areas(areasOf(ownObjects))
    , irradiance(right)
  {
  }

  /// The root of the mean square difference over the area, in units of the mean irradiance.
  double rmsError(const CellField& field) const
  {
    return std::sqrt(meanOf((field - irradiance).square(), areas)) / meanOf(irradiance, areas);
  }
  double rmsError(const IrradianceEngine& engine) const
  {
    return rmsError(irradianceOf(engine, objects));
  }

  SceneObjects objects;
  CellField areas, irradiance;
};

EngineSettings settingsWith(std::uint32_t walks, std::uint64_t seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  settings.verify = false;
  return settings;
}

/// From cells cut into four to the cells they were cut from: the pieces have the same area.
CellField coarsened(const CellField& field)
{
  return field.reshaped(4, field.size() / 4).colwise().mean();
}

/// The same values on smaller cells.
CellField refined(const CellField& field, Eigen::Index size)
{
  return field.transpose().replicate(size / field.size(), 1).reshaped();
}

/// The truth by level: cells are cut into four again and again.
std::vector<Truth> truthsOf(const TradeScene& scene, std::uint32_t walks)
{
  constexpr double kTime = 0.4;
  const SceneObjects finest = subdivided(scene.at(kTime), kLevels);
  CellField right = CellField::Ones(areasOf(finest).size());
  if (!scene.isFurnace)
  {
    test::ThreadExecution threads(2);
    IrradianceEngine engine;
    engine.update(finest, settingsWith(walks, kReferenceSeed), threads);
    right = irradianceOf(engine, finest);
  }
  std::vector<Truth> levels;
  for (int level = kLevels; level >= 0; --level)
  {
    levels.insert(levels.begin(), { subdivided(scene.at(kTime), level), right });
    right = coarsened(right);
  }
  return levels;
}

double secondsOf(IrradianceEngine& engine, const Truth& scene, const EngineSettings& settings)
{
  return timeUpdate(engine, scene.objects, settings).whole;
}

void measureConvergence(const std::string& name, const Truth& scene, std::uint64_t seed)
{
  for (std::uint32_t number = 1u << 12; number <= 1u << 20; number *= 4)
  {
    IrradianceEngine engine;
    const double time = secondsOf(engine, scene, settingsWith(number, seed));
    const double error = scene.rmsError(engine);
    const std::string row = name + ", " + std::to_string(number) + " walks";
    report("Convergence", row, "time, s", time);
    report("Convergence", row, "RMS error", error);
    report("Convergence", row, "efficiency 1/(error² x time), 1/s", 1 / (error * error * time));
  }
}

void measureCellSizes(const std::string& name, const std::vector<Truth>& levels, std::uint64_t seed)
{
  const Truth& finest = levels.back();
  for (const Truth& scene : levels)
  {
    IrradianceEngine engine;
    const double seconds = secondsOf(engine, scene, settingsWith(kUsualWalks, seed));
    const std::string row = name + ", " + std::to_string(scene.areas.size()) + " cells";
    report("CellSizes", row, "time, s", seconds);
    report("CellSizes", row, "RMS error of cells", scene.rmsError(engine));
    report("CellSizes", row, "what the cells blur",
      finest.rmsError(refined(scene.irradiance, finest.irradiance.size())));
  }
}

void measureErrorBars(const std::string& name, const Truth& scene, std::uint64_t seed)
{
  EngineSettings settings = settingsWith(kUsualWalks, seed);
  IrradianceEngine plain, barred;
  const double without = secondsOf(plain, scene, settings);
  settings.replicates = kReplicates;
  const double with = secondsOf(barred, scene, settings);
  const auto bytesPerCell = [&](const IrradianceEngine& engine) {
    return static_cast<double>(engine.sums().bytes()) / static_cast<double>(scene.areas.size());
  };
  report("ErrorBars", name, "time / without", with / without);
  report("ErrorBars", name, "RMS error / without", scene.rmsError(barred) / scene.rmsError(plain));
  report("ErrorBars", name, "bytes a cell", bytesPerCell(barred));
  report("ErrorBars", name, "bytes a cell without", bytesPerCell(plain));
}

/// The least error that is not exceeded on a share of the area.
double quantileOf(const CellField& errors, const CellField& areas, double share)
{
  std::vector<Eigen::Index> order(static_cast<std::size_t>(errors.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{ 0 });
  std::sort(order.begin(), order.end(),
    [&](Eigen::Index a, Eigen::Index b) { return errors[a] < errors[b]; });
  double left = share * areas.sum();
  const auto found = std::find_if(
    order.begin(), order.end() - 1, [&](Eigen::Index i) { return (left -= areas[i]) <= 0; });
  return errors[*found];
}

void measureTargets(const std::string& name, const Truth& scene, std::uint64_t seed)
{
  for (const int percent : { 40, 20, 10 })
  {
    EngineSettings settings = settingsWith(1u << 13, seed);
    settings.replicates = kReplicates;
    settings.targetRelativeError = 0.01 * percent;
    settings.maximumNumberOfWalks = 1u << 22;
    IrradianceEngine engine;
    const double seconds = secondsOf(engine, scene, settings);
    // Of each cell in units of its own irradiance, or of the mean where it has received nothing.
    const CellField field = irradianceOf(engine, scene.objects);
    const CellField errors = (field - scene.irradiance).abs() /
      (field > 0).select(field, CellField::Constant(field.size(), meanOf(field, scene.areas)));
    const CellField isWithin = (errors <= settings.targetRelativeError).cast<double>();
    const std::string row = name + ", target " + std::to_string(percent) + " %";
    report("Targets", row, "stated, %", 100 * engine.reachedRelativeError());
    report("Targets", row, "true error of 95 % of the area, %",
      100 * quantileOf(errors, scene.areas, ErrorEstimate::kConfidence));
    report("Targets", row, "area within the target, %", 100 * meanOf(isWithin, scene.areas));
    report("Targets", row, "walks", engine.numberOfWalks());
    report("Targets", row, "time, s", seconds);
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 1u << 24);
  const auto seeds = arguments.number<std::uint64_t>(1, 3);
  for (const TradeScene& trade : makeTradeScenes(arguments.text(2, VTKIRRADIANCE_HEAD)))
  {
    const std::vector<Truth> levels = truthsOf(trade, walks);
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    {
      measureConvergence(trade.name, levels[0], seed);
      measureCellSizes(trade.name, levels, seed);
      measureErrorBars(trade.name, levels[0], seed);
      measureTargets(trade.name, levels[0], seed);
    }
  }
}
