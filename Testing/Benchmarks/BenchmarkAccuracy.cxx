/**
 * How the error of the irradiance falls with time: by the number of walks, by the size of cells, with
 * error bars, and with a target. The truth is 1 W/m2 in the furnace and a much longer run with another
 * seed elsewhere. Errors are over the area and in units of the mean irradiance; times are the CPU time
 * of the one thread. Every figure is the median over some seeds.
 *
 * Arguments: [walks of the reference = 16777216] [seeds = 3] [head.off]
 */
#include "CellField.h"
#include "Program.h"
#include "Results.h"
#include "Timing.h"
#include "TradeScene.h"
#include "TwoThreads.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

using namespace irradiance;

namespace
{

constexpr int kLevels = 2;
constexpr std::uint64_t kReferenceSeed = 1000;
constexpr std::uint32_t kReplicates = 16;
constexpr std::uint32_t kUsualWalks = 1u << 18;

/// A scene that stands, cut into cells of several sizes, with the truth.
struct KnownScene
{
  std::string name;
  std::vector<SceneObjects> objects; ///< by level
  std::vector<CellField> areas;
  std::vector<CellField> truth;
};

KnownScene known(const TradeScene& scene, std::uint32_t walks)
{
  constexpr double kTime = 0.4;
  KnownScene known;
  known.name = scene.name;
  for (int level = 0; level <= kLevels; ++level)
  {
    known.objects.push_back(subdivided(scene.at(kTime), level));
    known.areas.push_back(areasOf(known.objects.back()));
  }
  CellField finest(known.areas.back().size(), 1.0);
  if (!scene.isFurnace)
  {
    EngineSettings settings;
    settings.numberOfWalks = walks;
    settings.seed = kReferenceSeed;
    settings.verify = false;
    TwoThreads threads;
    IrradianceEngine engine;
    engine.update(known.objects.back(), settings, threads);
    finest = irradianceOf(engine, known.objects.back());
  }
  for (int level = 0; level <= kLevels; ++level)
  {
    known.truth.push_back(coarsened(finest, kLevels - level));
  }
  return known;
}

double secondsOf(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Execution serial;
  const double start = threadCpuSeconds();
  engine.update(objects, settings, serial);
  return threadCpuSeconds() - start;
}

EngineSettings settingsWith(std::uint32_t walks, int seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = static_cast<std::uint64_t>(seed);
  settings.verify = false;
  return settings;
}

/// Of the straight line through (log x, log y), by least squares.
double slopeOf(const std::vector<double>& x, const std::vector<double>& y)
{
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Values of rows and quantities, one for each seed, in the order in which they first came.
class Gathered
{
public:
  std::vector<double>& of(const std::string& row, const std::string& quantity)
  {
    const auto [place, isNew] = values_.try_emplace({ row, quantity });
    if (isNew)
    {
      order_.push_back(place->first);
    }
    return place->second;
  }
  void give(const std::string& benchmark, Results& results) const
  {
    for (const auto& key : order_)
    {
      results.add(benchmark, key.first, key.second, values_.at(key));
    }
  }

private:
  std::map<std::pair<std::string, std::string>, std::vector<double>> values_;
  std::vector<std::pair<std::string, std::string>> order_;
};

std::string counted(double number, const char* what)
{
  return std::to_string(static_cast<std::int64_t>(number)) + ' ' + what;
}

void measureConvergence(const KnownScene& scene, int seeds, Results& results)
{
  Gathered points, slopes;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    std::vector<double> walks, seconds, errors;
    for (std::uint32_t number = 1u << 12; number <= 1u << 20; number *= 4)
    {
      IrradianceEngine engine;
      seconds.push_back(secondsOf(engine, scene.objects[0], settingsWith(number, seed)));
      errors.push_back(
        rmsError(irradianceOf(engine, scene.objects[0]), scene.truth[0], scene.areas[0]));
      walks.push_back(number);
      const std::string row = scene.name + ", " + counted(number, "walks");
      points.of(row, "time, s").push_back(seconds.back());
      points.of(row, "RMS error").push_back(errors.back());
      points.of(row, "efficiency 1/(error² x time), 1/s")
        .push_back(1 / (errors.back() * errors.back() * seconds.back()));
    }
    slopes.of(scene.name, "slope over walks").push_back(slopeOf(walks, errors));
    slopes.of(scene.name, "slope over time").push_back(slopeOf(seconds, errors));
  }
  points.give("Convergence", results);
  slopes.give("ConvergenceSlopes", results);
}

/// Each level's values over the finest cells.
CellField refined(const CellField& coarse, std::size_t size)
{
  CellField fine;
  for (const double value : coarse)
  {
    fine.insert(fine.end(), size / coarse.size(), value);
  }
  return fine;
}

void measureCellSizes(const KnownScene& scene, int seeds, Results& results)
{
  Gathered points;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    for (std::size_t level = 0; level < scene.objects.size(); ++level)
    {
      IrradianceEngine engine;
      const double seconds =
        secondsOf(engine, scene.objects[level], settingsWith(kUsualWalks, seed));
      const CellField field = irradianceOf(engine, scene.objects[level]);
      const std::string row =
        scene.name + ", " + counted(static_cast<double>(field.size()), "cells");
      const auto& areas = scene.areas[level];
      points.of(row, "time, s").push_back(seconds);
      points.of(row, "RMS error of cells").push_back(rmsError(field, scene.truth[level], areas));
      points.of(row, "what the cells blur")
        .push_back(rmsError(refined(scene.truth[level], scene.truth.back().size()),
          scene.truth.back(), scene.areas.back()));
    }
  }
  points.give("CellSizes", results);
}

/// Shares of the cells and of the area in which the stated interval holds the truth.
void addCoverage(const std::string& row, const CellField& field, const CellField& errors,
  const CellField& truth, const CellField& areas, Gathered& points)
{
  const double factor = ErrorEstimate::confidenceFactor(kReplicates);
  double known = 0, held = 0, area = 0, knownArea = 0, heldArea = 0;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    area += areas[i];
    if (!std::isnan(errors[i]))
    {
      const bool holds = std::abs(field[i] - truth[i]) <= factor * errors[i];
      known += 1;
      knownArea += areas[i];
      held += holds ? 1 : 0;
      heldArea += holds ? areas[i] : 0;
    }
  }
  points.of(row, "area with an interval, %").push_back(100 * knownArea / area);
  points.of(row, "intervals that hold the truth, %").push_back(100 * held / known);
  points.of(row, "the same by area, %").push_back(100 * heldArea / knownArea);
}

void measureErrorBars(const KnownScene& scene, int seeds, Results& results)
{
  Gathered costs, coverage;
  const auto cells = static_cast<double>(scene.areas[0].size());
  for (int seed = 1; seed <= seeds; ++seed)
  {
    EngineSettings settings = settingsWith(kUsualWalks, seed);
    IrradianceEngine plain, barred;
    const double without = secondsOf(plain, scene.objects[0], settings);
    settings.replicates = kReplicates;
    const double with = secondsOf(barred, scene.objects[0], settings);
    const CellField field = irradianceOf(barred, scene.objects[0]);
    costs.of(scene.name, "time / without").push_back(with / without);
    costs.of(scene.name, "RMS error / without")
      .push_back(rmsError(field, scene.truth[0], scene.areas[0]) /
        rmsError(irradianceOf(plain, scene.objects[0]), scene.truth[0], scene.areas[0]));
    costs.of(scene.name, "bytes a cell")
      .push_back(static_cast<double>(barred.sums().bytes()) / cells);
    costs.of(scene.name, "bytes a cell without")
      .push_back(static_cast<double>(plain.sums().bytes()) / cells);
    addCoverage(scene.name, field, standardErrorOf(barred, scene.objects[0]), scene.truth[0],
      scene.areas[0], coverage);
  }
  costs.give("ErrorBars", results);
  coverage.give("Coverage", results);
}

/// Truly, of each cell, in units of its own irradiance, or of the mean where it has received nothing.
CellField relativeErrors(const CellField& field, const CellField& truth, const CellField& areas)
{
  const double mean = meanOf(field, areas);
  CellField errors;
  for (std::size_t i = 0; i < field.size(); ++i)
  {
    errors.push_back(std::abs(field[i] - truth[i]) / (field[i] > 0 ? field[i] : mean));
  }
  return errors;
}

void measureTargets(const KnownScene& scene, int seeds, Results& results)
{
  Gathered points;
  for (int seed = 1; seed <= seeds; ++seed)
  {
    for (const int percent : { 40, 20, 10 })
    {
      EngineSettings settings = settingsWith(1u << 13, seed);
      settings.replicates = kReplicates;
      settings.targetRelativeError = 0.01 * percent;
      settings.maximumNumberOfWalks = 1u << 22;
      IrradianceEngine engine;
      const double seconds = secondsOf(engine, scene.objects[0], settings);
      const CellField errors =
        relativeErrors(irradianceOf(engine, scene.objects[0]), scene.truth[0], scene.areas[0]);
      CellField isWithin;
      for (const double error : errors)
      {
        isWithin.push_back(error <= settings.targetRelativeError ? 1 : 0);
      }
      const std::string row = scene.name + ", target " + std::to_string(percent) + " %";
      points.of(row, "stated, %").push_back(100 * engine.reachedRelativeError());
      points.of(row, "true error of 95 % of the area, %")
        .push_back(100 * quantileOf(errors, scene.areas[0], ErrorEstimate::kConfidence));
      points.of(row, "area within the target, %").push_back(100 * meanOf(isWithin, scene.areas[0]));
      points.of(row, "walks").push_back(engine.numberOfWalks());
      points.of(row, "time, s").push_back(seconds);
    }
  }
  points.give("Targets", results);
}

void run(int argc, char* argv[])
{
  const auto walks =
    argc > 1 ? static_cast<std::uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 1u << 24;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 3;
  Results results("BenchmarkAccuracy");
  for (const TradeScene& trade : makeTradeScenes(argc > 3 ? argv[3] : VTKIRRADIANCE_HEAD))
  {
    const KnownScene scene = known(trade, walks);
    measureConvergence(scene, seeds, results);
    measureCellSizes(scene, seeds, results);
    measureErrorBars(scene, seeds, results);
    measureTargets(scene, seeds, results);
  }
  results.finish();
}

}

int main(int argc, char* argv[])
{
  return runProgram(run, argc, argv);
}
