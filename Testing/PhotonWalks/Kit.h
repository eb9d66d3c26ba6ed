// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What most tests need: scenes, engines, executions, and what an engine answers.

#include "EngineRun.h"
#include "HistoryPhotons.h"
#include "Scenes.h"
#include "TestScenes.h"
#include "ThreadExecution.h"
#include "Views/OutgoingRadiance.h"
#include "Views/SensorFinalGather.h"
#include "Walks/LightSurvey.h"

#include "../RayCasting/RandomVectors.h"
#include "../RayCasting/TestSimdLevels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace irradiance::test
{

/// As many walks with sanitizers: they decide which cells are small.
inline EngineSettings gathering(std::uint32_t walks, std::uint64_t seed = 1)
{
  EngineSettings settings = Shoot(walks).seeded(seed).gathered();
  settings.cellEstimate = CellEstimate::Gathered;
  return settings;
}

/// What an engine shoots and gathers.
inline std::vector<WalkSource> gatheredOf(const SceneObjects& objects, const WalkPlan& plan)
{
  const std::vector<WalkSource> sources = sourcesOf(objects, plan);
  return directSourcesOf(objects, sources, LightSurvey(objects, sources), {});
}

/// Of what the walks of a source bring.
inline double quantaPerWatt(const WalkSource& source)
{
  return static_cast<double>(source.lights.quantaPerWalk()) * source.plan.walksAfter(1) /
    source.lights.flux();
}

/// What seeds find of each cell, in one band.
class SeedMeans
{
public:
  void add(const IrradianceEngine& engine, int band = 0)
  {
    std::size_t i = 0;
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      means_.resize(std::max(means_.size(), i + 1));
      means_[i++].add(engine.irradiance({ cell }, band));
    });
  }
  const std::vector<ReplicateMean>& cells() const { return means_; }

private:
  std::vector<ReplicateMean> means_;
};

/// W on the cells of an object, as estimated.
inline double estimatedWattsOn(const IrradianceEngine& engine, std::uint32_t object, int band)
{
  double watts = 0;
  for (std::size_t cell = 0; cell < engine.cells().numbers().sizeOf(object); ++cell)
  {
    watts += engine.irradiance({ { object, cell } }, band) * engine.cells().area({ object, cell });
  }
  return watts;
}

/// Cells of two engines agree to 5.5 standard errors of both; returns how many have an error bar.
inline int expectAgreement(const IrradianceEngine& a, const IrradianceEngine& b)
{
  const ErrorEstimate ofA = a.errorEstimate(), ofB = b.errorEstimate();
  int compared = 0;
  a.cells().numbers().forEach([&](const SceneCell& cell) {
    const CellSide side{ cell };
    const double bar =
      std::hypot(a.watts(ofA.standardError(side, 0)), b.watts(ofB.standardError(side, 0))) /
      a.cells().area(cell);
    if (a.cells().area(cell) > 0 && !std::isnan(bar))
    {
      EXPECT_NEAR(b.irradiance(side, 0), a.irradiance(side, 0), 5.5 * bar)
        << "cell " << cell.cell << " of object " << cell.object;
      ++compared;
    }
  });
  return compared;
}

/// From so many seeds.
inline SeedMeans meansOf(
  const SceneObjects& objects, int seeds, EngineSettings settings, std::uint64_t firstSeed = 1)
{
  SeedMeans means;
  settings.seed = firstSeed;
  overSeeds(
    objects, seeds, settings, [&](const IrradianceEngine& engine) { means.add(engine); },
    ThreadExecution(2));
  return means;
}

/// Of the cells from `first` on: chi-square of the differences of two means.
inline double chiSquareOf(const SeedMeans& a, const SeedMeans& b, std::size_t first)
{
  double sum = 0;
  for (std::size_t i = first; i < a.cells().size(); ++i)
  {
    const ReplicateMean &x = a.cells()[i], &y = b.cells()[i];
    sum += std::pow(x.mean() - y.mean(), 2) /
      (std::pow(x.standardError(), 2) + std::pow(y.standardError(), 2));
  }
  return sum;
}

/// What sensors and eyes find in the present frame of an engine, or of a new one.

/// Bit for bit.
template <class Light>
bool areSame(const std::vector<Light>& a, const std::vector<Light>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

/// Of a sensor, where another number would do.
constexpr std::uint32_t kRays = 64;

/// At the sensors of these numbers.
inline std::vector<SensorFinalGather::Light> lightsAt(const SensorFinalGather& gather,
  const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers)
{
  SensorFinalGather::Rays rays;
  std::int64_t cast = 0;
  const auto found = gather.update(sensors, numbers, nullptr, rays, cast);
  std::vector<SensorFinalGather::Light> lights(found.size());
  std::transform(found.begin(), found.end(), lights.begin(), SensorFinalGather::lightOf);
  return lights;
}

inline std::vector<SensorFinalGather::Light> gathered(
  const IrradianceEngine& engine, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  Execution serial;
  std::vector<std::size_t> numbers(sensors.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{ 0 });
  return lightsAt(SensorFinalGather(engine, rays, serial), sensors, numbers);
}

inline std::vector<SensorFinalGather::Light> gathered(const SceneObjects& objects,
  const EngineSettings& settings, const std::vector<Sensor>& sensors, std::uint32_t rays = kRays)
{
  return gathered(UpdatedEngine(objects, settings), sensors, rays);
}

/// In and around a room of 4 m; a third of them receive from all directions.
inline std::vector<Sensor> randomSensors(int count)
{
  RandomVectors random(5);
  std::vector<Sensor> sensors;
  for (int i = 0; i < count; ++i)
  {
    sensors.push_back({ Vector3(2, 2, 2) + 2.2 * random.inCube(),
      i % 3 == 0 ? Vector3(0, 0, 0) : Vector3(random.inCube().normalized()) });
  }
  return sensors;
}

using SeenLights = std::vector<OutgoingRadiance::Light>;

inline SeenLights seen(const IrradianceEngine& engine, const std::vector<SceneCell>& cells,
  const Eye& eye, std::uint32_t samples = 16)
{
  Execution serial;
  return OutgoingRadiance(engine, samples, serial).at(cells, eye);
}

inline SeenLights seen(const SceneObjects& objects, const EngineSettings& settings,
  const std::vector<SceneCell>& cells, const Eye& eye, std::uint32_t samples = 16)
{
  return seen(UpdatedEngine(objects, settings), cells, eye, samples);
}

inline std::vector<SceneCell> cellsOf(const SceneObjects& objects)
{
  std::vector<SceneCell> cells;
  CellNumbers(objects).forEach([&](const SceneCell& cell) { cells.push_back(cell); });
  return cells;
}

}
