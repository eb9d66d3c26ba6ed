// SPDX-License-Identifier: BSD-3-Clause
/**
 * What each estimate of the irradiance of cells makes of the same walks: its error on walls and on finely
 * meshed things, and its time.
 *
 * Errors are RMS over the area of a part of the scene, in units of that part's mean irradiance, blur
 * included. The truth comes from two long runs r and s with seeds of their own: the mean of (x - r)(x - s) is
 * the squared error of x, whatever the noise of r and s. Times are CPU time of one thread, for spreading the
 * sums of a frame in which the objects have moved.
 *
 * Arguments: [walks = 1000000] [seeds = 5] [walks of the reference = 64000000] [head.off]
 */
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/CellField.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Scenes/PlainRoom.h"

#include <cmath>
#include <cstdint>

using namespace irradiance;

namespace
{

struct Estimate
{
  std::string name;
  CellEstimate kind;
  double photons;
};

const std::vector<Estimate> kEstimates = { { "sums", CellEstimate::Sums, 1 },
  { "spread, 50 photons", CellEstimate::Spread, 50 },
  { "spread, 100 photons", CellEstimate::Spread, 100 },
  { "spread, 200 photons", CellEstimate::Spread, 200 },
  { "spread, 400 photons", CellEstimate::Spread, 400 } };

EngineSettings settingsWith(std::uint32_t walks, std::uint64_t seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  return settings;
}

/// By each estimate, the mean of several long runs. Photons are spread as far as those of `walks`.
std::vector<CellField> longRun(
  const SceneObjects& objects, std::uint32_t walks, double allWalks, std::uint64_t firstSeed)
{
  constexpr std::uint32_t kWalksOfARun = 2000000; // their history fits into the memory
  const int runs = std::max(1, static_cast<int>(allWalks / kWalksOfARun));
  test::ThreadExecution threads(2);
  std::vector<CellField> means(kEstimates.size(), CellField::Zero(areasOf(objects).size()));
  for (int run = 0; run < runs; ++run)
  {
    EngineSettings settings =
      settingsWith(kWalksOfARun, firstSeed + static_cast<std::uint64_t>(run));
    IrradianceEngine engine;
    for (std::size_t i = 0; i < kEstimates.size(); ++i)
    {
      settings.cellEstimate = kEstimates[i].kind;
      settings.spreadPhotons = kEstimates[i].photons * kWalksOfARun / walks;
      engine.update(objects, settings, threads);
      means[i] += irradianceOf(engine, objects) / runs;
    }
  }
  return means;
}

/// A part of a scene: 1 for its cells, 0 for others.
struct Part
{
  std::string name;
  CellField isIn;
};

std::vector<Part> partsOf(const SceneObjects& objects)
{
  const auto part = [&](const std::string& name, const auto& isIn) {
    return Part{ name, fieldOf(objects, [&](std::uint32_t object, std::size_t, double) {
                  return isIn(object) ? 1.0 : 0.0;
                }) };
  };
  std::vector<Part> parts = { part("all", [](std::uint32_t) { return true; }),
    part("static", [](std::uint32_t object) { return object == 0; }),
    part("dynamic", [](std::uint32_t object) { return object > 0; }) };
  for (std::uint32_t i = 1; i < objects.size() && objects.size() > 2; ++i)
  {
    parts.push_back(
      part("dynamic " + std::to_string(i), [i](std::uint32_t object) { return object == i; }));
  }
  return parts;
}

void measure(const MovingScene& scene, std::uint32_t walks, std::uint64_t seeds, double reference)
{
  constexpr std::uint64_t kSeedsOfTruth = 1000;
  const SceneObjects objects = scene.at(0.25), before = scene.at(0.25 - MovingScene::kFrame);
  const std::vector<CellField> longOnes = longRun(objects, walks, 0.5 * reference, kSeedsOfTruth),
                               others = longRun(objects, walks, 0.5 * reference, 2 * kSeedsOfTruth);
  const CellField areas = areasOf(objects), &r = longOnes[0], &s = others[0];
  const std::vector<Part> parts = partsOf(objects);
  std::vector<std::vector<double>> squares(
    kEstimates.size(), std::vector<double>(parts.size(), 0.0));
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    IrradianceEngine engine;
    Execution execution;
    EngineSettings settings = settingsWith(walks, seed);
    engine.update(before, settings, execution);
    engine.update(objects, settings, execution);
    for (std::size_t i = 0; i < kEstimates.size(); ++i)
    {
      settings.cellEstimate = kEstimates[i].kind;
      settings.spreadPhotons = kEstimates[i].photons;
      const auto update = [&](const SceneObjects& frame) { // without a motion: nothing is shot
        const double start = threadCpuSeconds();
        engine.update(frame, settings, execution);
        return threadCpuSeconds() - start;
      };
      report("CellEstimateTimes", scene.name + ", " + kEstimates[i].name, "first time, ms",
        1e3 * update(objects));
      report("CellEstimateTimes", scene.name + ", " + kEstimates[i].name, "again, ms",
        1e3 * update(objects));
      const CellField x = irradianceOf(engine, objects);
      for (std::size_t k = 0; k < parts.size(); ++k)
      {
        const CellField weights = areas * parts[k].isIn;
        const double mean = meanOf(0.5 * (r + s), weights);
        squares[i][k] +=
          meanOf((x - r) * (x - s), weights) / (mean * mean) / static_cast<double>(seeds);
      }
    }
  }
  for (std::size_t i = 0; i < kEstimates.size(); ++i)
  {
    for (std::size_t k = 0; k < parts.size(); ++k)
    {
      const CellField weights = areas * parts[k].isIn;
      const double mean = meanOf(0.5 * (r + s), weights);
      report("CellEstimates", scene.name + ", " + parts[k].name, "blur of " + kEstimates[i].name + ", %",
        100 * std::sqrt(std::max(0.0,meanOf((longOnes[i] - r) * (others[i] - s), weights))) / mean);
      report("CellEstimates", scene.name + ", " + parts[k].name, kEstimates[i].name + ", %",
        100 * std::sqrt(std::max(0.0, squares[i][k])));
    }
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 1000000u);
  const auto seeds = arguments.number<std::uint64_t>(1, 5);
  const auto reference = arguments.number(2, 64e6);
  measure(makePlainRoom(), walks, seeds, reference);
}
