// SPDX-License-Identifier: BSD-3-Clause
/**
 * What each estimate of the irradiance of cells makes of the same walks: its error on walls and on finely
 * meshed things, how much of it is blur, what becomes of a sharp edge of a shadow, and its time.
 *
 * Errors are RMS over the area of a part of a scene, in units of that part's mean irradiance. The truth
 * comes from two long runs r and s: the mean of (x - r)(x - s) is the squared error of x, however noisy r and
 * s are. Blur is measured likewise, by the estimate of the long runs' own photons, as wide as that of `walks`.
 * Times are CPU time of one thread.
 *
 * Arguments: [walks = 1000000] [seeds = 5] [walks of the truth = 64000000] [head.off]
 */
#include "../../PhotonWalks/TestScenes.h"
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/CellField.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Rounds.h"
#include "Scenes/PlainRoom.h"

#include <algorithm>
#include <cmath>

using namespace irradiance;

namespace
{

constexpr double kTime = 0.25;

struct Estimate
{
  std::string name;
  CellEstimate kind;
  double photons;
};

const std::vector<Estimate> kEstimates = { { "sums", CellEstimate::Sums, 1 },
  { "spread, 50 photons", CellEstimate::Spread, 50 },
  { "spread, 100 photons", CellEstimate::Spread, 100 },
  { "spread, 250 photons", CellEstimate::Spread, 250 },
  { "spread, 400 photons", CellEstimate::Spread, 400 } };

EngineSettings settingsWith(std::uint32_t walks, std::uint64_t seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  return settings;
}

void choose(EngineSettings& settings, const Estimate& estimate, double photonsOfOne = 1)
{
  settings.cellEstimate = estimate.kind;
  settings.spreadPhotons = estimate.photons * photonsOfOne;
}

/// By each estimate, the mean of several long runs, as wide as the estimates of `walks`.
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
      choose(settings, kEstimates[i], double(kWalksOfARun) / walks);
      engine.update(objects, settings, threads);
      means[i] += irradianceOf(engine, objects) / runs;
    }
  }
  return means;
}

/// A part of a scene.
struct Part
{
  std::string name;
  CellField weights; ///< the areas of its cells, 0 for others
};

std::vector<Part> partsOf(const SceneObjects& objects)
{
  const auto part = [&](const std::string& name, const auto& isIn) {
    return Part{ name, fieldOf(objects, [&](std::uint32_t object, std::size_t, double area) {
                  return isIn(object) ? area : 0.0;
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

/// CPU seconds of an update.
double secondsOf(
  IrradianceEngine& engine, const SceneObjects& objects, const EngineSettings& settings)
{
  Execution execution;
  const double start = threadCpuSeconds();
  engine.update(objects, settings, execution);
  return threadCpuSeconds() - start;
}

/// Of the same walks, by each estimate. Nothing is shot, so the time is that of the estimate.
std::vector<CellField> estimate(const MovingScene& scene, std::uint32_t walks, std::uint64_t seed)
{
  const SceneObjects objects = scene.at(kTime);
  IrradianceEngine engine;
  EngineSettings settings = settingsWith(walks, seed);
  secondsOf(engine, scene.at(kTime - MovingScene::kFrame), settings);
  report("CellEstimateTimes", scene.name + ", update of the sums", "ms",
    1e3 * secondsOf(engine, objects, settings));
  std::vector<CellField> fields;
  for (const Estimate& each : kEstimates)
  {
    choose(settings, each);
    const std::string row = scene.name + ", " + each.name;
    report("CellEstimateTimes", row, "first, ms", 1e3 * secondsOf(engine, objects, settings));
    report("CellEstimateTimes", row, "again, ms", 1e3 * secondsOf(engine, objects, settings));
    fields.push_back(irradianceOf(engine, objects));
  }
  return fields;
}

void measureErrors(
  const MovingScene& scene, std::uint32_t walks, std::uint64_t seeds, double walksOfTruth)
{
  constexpr std::uint64_t kSeedsOfTruth = 1000;
  const SceneObjects objects = scene.at(kTime);
  const std::vector<CellField> r = longRun(objects, walks, 0.5 * walksOfTruth, kSeedsOfTruth),
                               s = longRun(objects, walks, 0.5 * walksOfTruth, 2 * kSeedsOfTruth);
  std::vector<std::vector<CellField>> estimates;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    estimates.push_back(estimate(scene, walks, seed));
  }
  for (const Part& part : partsOf(objects))
  {
    const double mean = meanOf(0.5 * (r[0] + s[0]), part.weights);
    const auto root = [&](const CellField& squares) {
      return 100 * std::sqrt(std::max(0.0, meanOf(squares, part.weights))) / mean;
    };
    for (std::size_t i = 0; i < kEstimates.size(); ++i)
    {
      CellField squares = CellField::Zero(r[0].size());
      for (const std::vector<CellField>& fields : estimates)
      {
        squares += (fields[i] - r[0]) * (fields[i] - s[0]) / static_cast<double>(seeds);
      }
      const std::string row = scene.name + ", " + part.name + ", " + kEstimates[i].name;
      report("CellEstimates", row, "RMS error, %", root(squares));
      report("CellEstimates", row, "of it blur, %", root((r[i] - r[0]) * (s[i] - s[0])));
    }
  }
}

/// A black floor of 2 x 2 m, across which stands a wall. The light falls up to it, and not beyond it.
void measureShadow(std::uint32_t walks)
{
  constexpr int kCells = 100; // along each side
  constexpr double kCell = 2.0 / kCells;
  test::ObjectBuilder floor, wall;
  floor.addQuad({ -1, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, kCells, kCells, test::grey(0));
  floor.addPointLight({ -0.5, 1, 1 }, 1);
  wall.addQuad({ 0, -9, 0 }, { 0, 20, 0 }, { 0, 0, 9 }, 1, 1, test::grey(0));
  const SceneObjects objects{ floor.build(), { wall.build() } };
  IrradianceEngine engine;
  EngineSettings settings = settingsWith(walks, 1);
  double height = 0; // W/m2, before the wall
  for (const Estimate& each : kEstimates)
  {
    choose(settings, each);
    secondsOf(engine, objects, settings);
    const CellField cells = irradianceOf(engine, objects).head(kCells * kCells);
    const CellField profile = cells.reshaped(kCells, kCells).rowwise().mean();
    // Of a step, a Gaussian brings the height x its standard deviation / sqrt(2 pi) into the dark.
    height = each.kind == CellEstimate::Sums ? profile.segment(kCells / 2 - 3, 3).mean() : height;
    const double deviation = profile.tail(kCells / 2).sum() / height * std::sqrt(2 * M_PI);
    report("CellEstimateShadows", each.name, "cells from 10 % to 90 %", 2.563 * deviation);
    report(
      "CellEstimateShadows", each.name, "photons a cell", cells.mean() * kCell * kCell * walks);
  }
}

}

void run(const Arguments& arguments)
{
  const auto walks = arguments.number(0, 1000000u);
  const auto seeds = arguments.number<std::uint64_t>(1, 5);
  const auto walksOfTruth = arguments.number(2, 64e6);
  measureErrors(makePlainRoom(), walks, seeds, walksOfTruth);
  measureErrors(
    makeMovingTeapot(arguments.text(3, VTKIRRADIANCE_HEAD)), walks, seeds, walksOfTruth);
  measureShadow(walks);
}
