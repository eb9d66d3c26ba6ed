// SPDX-License-Identifier: BSD-3-Clause
/**
 * What each estimate of the irradiance of cells makes of the same walks: its error on what stands
 * and on what moves, how much of it is blur, what becomes of a sharp edge of a shadow, and the time
 * of a frame. The rival is the classic photon map, built again in each frame from walks that are
 * not stored.
 *
 * Errors are RMS over the area of a part of a scene, in units of that part's mean irradiance. The
 * truth comes from two long runs r and s: the mean of (x - r)(x - s) is the squared error of x,
 * however noisy r and s are. Blur is measured likewise, by the estimate of the long runs' own
 * photons, as wide as with the largest number of walks. Times are CPU time of one thread.
 *
 * Arguments: [most walks = 1000000] [seeds = 3] [walks of the truth = 32000000] [head.off]
 * ["refinement": that alone]
 */
#include "../../PhotonWalks/TestScenes.h"
#include "../../PhotonWalks/ThreadExecution.h"
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Rivals/PhotonMapField.h"
#include "Scenes/PlainRoom.h"
#include "Scenes/TradeScene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

constexpr double kTime = 0.25;
constexpr double kFrame = MovingScene::kFrame;

/// What makes an irradiance of photons.
struct Estimate
{
  std::string name;
  CellEstimate kind;
  double photons;
  bool isMap = false; ///< Rivals/PhotonMap, instead of `kind`
};

const std::vector<Estimate> kEstimates = { { "sums", CellEstimate::Sums, 1 },
  { "spread over 50", CellEstimate::Spread, 50 }, { "spread over 250", CellEstimate::Spread, 250 },
  { "photon map 50", CellEstimate::Sums, 50, true },
  { "photon map 250", CellEstimate::Sums, 250, true } };

/// `photonsOfOne`: in place of one.
EngineSettings settingsFor(
  const Estimate& estimate, std::uint32_t walks, std::uint64_t seed, double photonsOfOne = 1)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  settings.cellEstimate = estimate.kind;
  settings.spreadPhotons = estimate.photons * photonsOfOne;
  settings.keepPhotons = true;
  return settings;
}

CellField fieldBy(const Estimate& estimate, const IrradianceEngine& engine, double photonsOfOne = 1)
{
  return estimate.isMap ? irradianceOf(PhotonMap(mapPhotonsOf(engine)), engine.objects(),
                            static_cast<std::size_t>(estimate.photons * photonsOfOne))
                        : irradianceOf(engine, engine.objects());
}

/// By each estimate, the mean of several long runs, as wide as the estimates of `walks`. Few of
/// them tell what is blurred.
std::vector<CellField> longRun(
  const SceneObjects& objects, std::uint32_t walks, double allWalks, std::uint64_t firstSeed)
{
  constexpr double kPhotonsOfOne = 2; // more walks, as long as their history fits into the memory
  constexpr int kRunsOfBlur = 2;
  const auto walksOfARun = static_cast<std::uint32_t>(kPhotonsOfOne * walks);
  const int allRuns = std::max(1, static_cast<int>(allWalks / walksOfARun));
  test::ThreadExecution threads(2);
  std::vector<CellField> means(kEstimates.size(), CellField::Zero(areasOf(objects).size()));
  for (int run = 0; run < allRuns; ++run)
  {
    IrradianceEngine engine;
    for (std::size_t i = 0; i < kEstimates.size(); ++i)
    {
      const int runs = i == 0 ? allRuns : std::min(allRuns, kRunsOfBlur);
      if (run < runs)
      {
        engine.update(objects,
          settingsFor(kEstimates[i], walksOfARun, firstSeed + std::uint64_t(run), kPhotonsOfOne),
          threads);
        means[i] += fieldBy(kEstimates[i], engine, kPhotonsOfOne) / runs;
      }
    }
  }
  return means;
}

/// An estimate in a frame that changed a little.
struct Frame
{
  double seconds;
  CellField irradiance;
};

Frame frameByEngine(const MovingScene& scene, const EngineSettings& settings)
{
  IrradianceEngine engine;
  timeUpdate(engine, scene.at(kTime - kFrame), settings);
  const double seconds = timeUpdate(engine, scene.at(kTime), settings).whole;
  return { seconds, irradianceOf(engine, engine.objects()) };
}

/// Walks are shot, and not stored; the map is built; each cell asks it.
Frame frameByMap(const SceneObjects& objects, EngineSettings settings, std::size_t count)
{
  IrradianceEngine keeping, plain;
  timeUpdate(keeping, objects, settings);
  std::vector<PhotonMap::Photon> photons = mapPhotonsOf(keeping);
  settings.verify = settings.keepPhotons = false;
  Frame frame{ timeUpdate(plain, objects, settings).whole, {} };
  frame.seconds += threadCpuSecondsOf(
    [&] { frame.irradiance = irradianceOf(PhotonMap(std::move(photons)), objects, count); });
  return frame;
}

Frame frameBy(
  const Estimate& estimate, const MovingScene& scene, std::uint32_t walks, std::uint64_t seed)
{
  const EngineSettings settings = settingsFor(estimate, walks, seed);
  return estimate.isMap
    ? frameByMap(scene.at(kTime), settings, static_cast<std::size_t>(estimate.photons))
    : frameByEngine(scene, settings);
}

void measureErrors(const std::string& name, const MovingScene& scene, std::uint32_t mostWalks,
  std::uint64_t seeds, double walksOfTruth)
{
  constexpr std::uint64_t kSeedsOfTruth = 1000;
  constexpr int kLevels = 3; // each with four times the walks
  const std::string table = "CellEstimates" + name;
  const SceneObjects objects = scene.at(kTime);
  const CellField areas = areasOf(objects);
  const std::vector<CellSet> parts = cellSetsOf(objects);
  const std::vector<CellField> r = longRun(objects, mostWalks, 0.5 * walksOfTruth, kSeedsOfTruth),
                               s =
                                 longRun(objects, mostWalks, 0.5 * walksOfTruth, 2 * kSeedsOfTruth);
  const HalvedTruth truth{ r[0], s[0] };
  const auto percent = [](double square) { return 100 * std::sqrt(std::max(0.0, square)); };
  for (std::size_t i = 0; i < kEstimates.size(); ++i)
  {
    for (int level = 0; level < kLevels; ++level)
    {
      const std::uint32_t walks = mostWalks >> 2 * (kLevels - 1 - level);
      std::vector<double> seconds;
      std::vector<CellField> fields;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed)
      {
        const Frame frame = frameBy(kEstimates[i], scene, walks, seed);
        seconds.push_back(frame.seconds);
        fields.push_back(frame.irradiance);
      }
      for (const CellSet& part : { parts[1], parts[2] })
      {
        const std::string row =
          kEstimates[i].name + ", " + part.name + ", " + std::to_string(walks);
        Mean error;
        for (const CellField& field : fields)
        {
          error.add(truth.squaredError(field, areas, part));
        }
        report(table, row, "frame, s", seconds);
        report(table, row, "RMS error, %", percent(error.value()));
        if (level == kLevels - 1)
        {
          const double mean = meanOf(part.of(0.5 * (r[0] + s[0])), part.of(areas));
          const CellField blur = (r[i] - r[0]) * (s[i] - s[0]) / (mean * mean);
          report(table, row, "of it blur, %", percent(meanOf(part.of(blur), part.of(areas))));
        }
      }
    }
  }
}

/// A black floor of 2 x 2 m, across which stands a wall. The light falls up to it, and not beyond
/// it.
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
  Execution execution;
  double height = 0; // W/m2, before the wall
  for (const Estimate& each : kEstimates)
  {
    engine.update(objects, settingsFor(each, walks, 1), execution);
    const CellField cells = fieldBy(each, engine).head(kCells * kCells);
    const CellField profile = cells.reshaped(kCells, kCells).rowwise().mean();
    // Of a step, a Gaussian brings the height x its standard deviation / sqrt(2 pi) into the dark.
    height = each.name == "sums" ? profile.segment(kCells / 2 - 3, 3).mean() : height;
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
  const auto seeds = arguments.number<std::uint64_t>(1, 3);
  const auto walksOfTruth = arguments.number(2, 32e6);
  constexpr int kCuts = 2; // of the box's cells, which are large
  const std::vector<TradeScene> scenes = makeTradeScenes(arguments.text(3, VTKIRRADIANCE_HEAD));
  MovingScene box = scenes[1];
  box.objects = subdivided(box.objects, kCuts);
  measureErrors("Room", makePlainRoom(), walks, seeds, walksOfTruth);
  measureErrors("Teapot", scenes[0], walks, seeds, walksOfTruth);
  measureErrors("Box", box, walks, seeds, walksOfTruth);
  measureShadow(walks);
}
