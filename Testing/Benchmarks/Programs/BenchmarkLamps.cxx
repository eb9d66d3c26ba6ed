// SPDX-License-Identifier: BSD-3-Clause
/**
 * What lamps with a table of radiant intensity, a sky and a sun cost (Scenes/LampScenes.h), by what
 * a user gets who chooses nothing. CPU time of the one thread.
 *
 * - A first frame with a table, beside the same with a diffuse lamp of the same flux, at equal
 *   error: squared RMS error over the area, from all rounds, x time. The default must agree with
 *   shot walks.
 * - An office: the fewest walks, by powers of two, with which 95 % of the area is within 5 % of a
 *   long run with another seed, and the time that they take; four times the walks at most.
 * - A street below a sky: the efficiency, 1 / (squared RMS error x time), beside a plain gatherer
 *   (Rivals/PlainGatherer.h): of the default, and of Method GatheredEverywhere with few walks. The
 *   truth is what both programs find together, twice, and all must agree with it.
 * - A day with trackers: updates, as the sun moves and the modules turn, beside fresh starts with
 *   the same settings. All answers must have the same bits.
 *
 * Arguments: [walks = 1000000] [rounds = 6] [steps of the day = 96] [paths of a cell = 64] [those
 * of half the truth = 4096]
 */
#include "../../PhotonWalks/Skies.h"
#include "Estimates/AutomaticChoice.h"
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Rivals/PlainGatherer.h"
#include "Scenes/LampScenes.h"

#include <algorithm>
#include <cmath>

using namespace irradiance;

namespace
{

const std::string kTable = "Lamps";
const std::string kFigures = "LampsFigures";

/// Of the mean irradiance; that is allowed where small cells read sums: those of few walks are
/// means over cells that are less alike.
double biasOf(std::uint32_t walks)
{
  return 0.03 * std::sqrt(std::max(1.0, 1e6 / walks));
}

struct Sizes
{
  std::uint32_t walks, paths, truthPaths;
  int rounds, steps;
};

/// By the default, with the time of the choice.
Shot shootDefault(
  IrradianceEngine& engine, const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.seed = seed;
  settings.gathersDirectLight = true; // it may
  CpuTime execution;
  const double start = execution.seconds();
  settings = engine.chosen({ true, true }, objects, settings, execution);
  engine.update(objects, settings, execution);
  return { execution.seconds() - start, engine.balance().segments, irradianceOf(engine, objects) };
}

Shot shootDefault(const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed)
{
  IrradianceEngine engine;
  return shootDefault(engine, objects, walks, seed);
}

Shot shootWalks(const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  return shootNew(objects, withSeed(settings, seed));
}

/// By Method Gathered, or GatheredEverywhere.
Shot shootGathered(
  const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed, bool everywhere)
{
  EngineSettings settings;
  settings.numberOfWalks = walks;
  settings.gathersDirectLight = true;
  settings.cellEstimate = CellEstimate::Gathered;
  settings.gathersEverywhere = everywhere;
  return shootNew(objects, withSeed(settings, seed));
}

using Way = Shot (*)(const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed);

/// Of all rounds: the square of the noise in units of the mean, the median time, the irradiance.
struct Noise
{
  Noise(const std::vector<Shot>& shots, const CellField& areas)
    : mean(CellField::Zero(areas.size()))
  {
    const auto rounds = static_cast<double>(shots.size());
    for (const Shot& shot : shots)
    {
      mean += shot.irradiance / rounds;
      seconds.push_back(shot.seconds);
    }
    for (const Shot& shot : shots)
    {
      square += meanOf((shot.irradiance - mean).square(), areas) / (rounds - 1);
    }
    square /= std::pow(meanOf(mean, areas), 2);
  }
  double cost() const { return square * medianOf(seconds); }

  CellField mean;
  double square = 0;
  std::vector<double> seconds;
};

void compareWithDiffuse(const Sizes& sizes)
{
  const std::vector<SceneObjects> rooms{ makePanelRoom(false), makePanelRoom(true) };
  const std::vector<CellSet> sets = cellSetsOf(rooms[0]);
  const CellField areas = areasOf(rooms[0]);
  const std::vector<std::pair<std::string, Way>> ways{ { "walks", shootWalks },
    { "default", static_cast<Way>(shootDefault) },
    { "Gathered", [](const SceneObjects& objects, std::uint32_t walks, std::uint64_t seed) {
       return shootGathered(objects, walks, seed, false);
     } } };
  std::vector<std::vector<std::vector<Shot>>> shots(
    rooms.size(), std::vector<std::vector<Shot>>(ways.size()));
  for (int round = -1; round < sizes.rounds; ++round)
  {
    for (std::size_t room = 0; room < rooms.size(); ++room)
    {
      for (std::size_t way = 0; way < ways.size(); ++way)
      {
        Shot shot =
          ways[way].second(rooms[room], sizes.walks, static_cast<std::uint64_t>(round) + 2);
        if (round >= 0)
        {
          shots[room][way].push_back(std::move(shot));
        }
      }
    }
  }
  for (std::size_t room = 0; room < rooms.size(); ++room)
  {
    std::vector<std::vector<CellField>> fields(ways.size());
    for (std::size_t way = 0; way < ways.size(); ++way)
    {
      for (const Shot& shot : shots[room][way])
      {
        fields[way].push_back(shot.irradiance);
      }
    }
    const HalvedTruth byWalks{ fields[0][0], fields[0][1] };
    requireAgreement("The default", fields[1], byWalks, areas, sets[0], biasOf(sizes.walks));
  }
  for (std::size_t way = 0; way < ways.size(); ++way)
  {
    const Noise diffuse(shots[0][way], areas), table(shots[1][way], areas);
    const std::string row = "a table of 181 x 73 values, " + ways[way].first;
    report(kTable, row, "time x squared error / diffuse lamp's", table.cost() / diffuse.cost(),
      { 1.2, 1.02 });
    report(kFigures, row, "time / diffuse lamp's", ratios(table.seconds, diffuse.seconds));
    report(kFigures, row, "RMS error / diffuse lamp's", std::sqrt(table.square / diffuse.square));
    report(kFigures, row, "RMS error", std::sqrt(table.square));
    report(kFigures, row, "s", table.seconds);
  }
}

void findWalksOfOffice(const Sizes& sizes)
{
  constexpr double kWithin = 0.05, kShare = 0.95;
  constexpr std::uint64_t kReferenceSeed = 1000;
  const SceneObjects office = makeOffice();
  const CellField areas = areasOf(office),
                  right = shootDefault(office, 16 * sizes.walks, kReferenceSeed).irradiance;
  report(kFigures, "office", "cells", static_cast<double>(areas.size()));
  for (std::uint32_t walks = 1u << 14; walks <= 4 * sizes.walks; walks *= 2)
  {
    std::vector<double> shares, seconds;
    for (int round = 0; round < sizes.rounds; ++round)
    {
      const Shot shot = shootDefault(office, walks, static_cast<std::uint64_t>(round) + 1);
      const CellField isWithin =
        ((shot.irradiance - right).abs() <= kWithin * right).cast<double>();
      shares.push_back(meanOf(isWithin, areas));
      seconds.push_back(shot.seconds);
    }
    const std::string row = "office, " + std::to_string(walks) + " walks";
    report(kFigures, row, "area within 5 %", shares);
    report(kFigures, row, "s", seconds);
    if (medianOf(shares) >= kShare)
    {
      const std::string found = "office, 95 % of the area within 5 %";
      report(kTable, found, "s", seconds, { 0.5, 0.2 });
      report(kFigures, found, "walks", walks);
      return;
    }
  }
}

float plainOvercast(const PlainScene::Vector& from)
{
  return from[2] > 0 ? (1 + 2 * from[2]) / 3 : 0;
}

/// CIE's type 12, as test::cieSky() has it.
float plainClear(const PlainScene::Vector& from)
{
  if (from[2] <= 0)
  {
    return 0;
  }
  const auto indicatrix = [](float cosine) {
    return 1 + 10 * (std::exp(-3 * std::acos(std::min(cosine, 1.f))) - 0.00898329f) +
      0.45f * cosine * cosine;
  };
  static const float height = std::sqrt(0.75f),
                     zenith = (1 - std::exp(-0.32f)) * indicatrix(height);
  return (1 - std::exp(-0.32f / from[2])) * indicatrix(0.5f * from[1] + height * from[2]) / zenith;
}

void compareStreet(const std::string& name, const test::RadianceOf& radiance,
  float (*plainSky)(const PlainScene::Vector&), const Sizes& sizes)
{
  constexpr std::uint64_t kTruthSeed = 100000;
  const SceneObjects street = makeStreet(test::skyOf({}, radiance));
  const CellField areas = areasOf(street);
  const CellSet all = cellSetsOf(street)[0];
  PlainScene plain = makePlainScene(street);
  plain.sky = plainSky;
  const PlainGatherer gatherer(plain);
  const auto gather = [&](std::uint32_t paths, std::uint64_t seed) {
    const double start = threadCpuSeconds();
    const PlainGatherer::Tally tally =
      gatherer.gather(0, static_cast<std::uint32_t>(areas.size()), paths, seed);
    return Shot{ threadCpuSeconds() - start, tally.rays,
      Eigen::Map<const CellField>(tally.irradiance.data(), areas.size()) };
  };
  const auto halves = [&](const auto& shot) {
    return HalvedTruth{ shot(kTruthSeed).irradiance, shot(kTruthSeed + 1).irradiance };
  };
  const HalvedTruth truth =
    combined(halves([&](std::uint64_t seed) { return gather(sizes.truthPaths, seed); }),
      halves([&](std::uint64_t seed) { return shootWalks(street, 16 * sizes.walks, seed); }), areas,
      { all });
  report(kFigures, name, "cells", static_cast<double>(areas.size()));
  const std::vector<std::pair<std::string, std::function<Shot(std::uint64_t)>>> contestants{
    { "plain gatherer", [&](std::uint64_t seed) { return gather(sizes.paths, seed); } },
    { "default", [&](std::uint64_t seed) { return shootDefault(street, sizes.walks, seed); } },
    { "a tenth of the walks",
      [&](std::uint64_t seed) { return shootDefault(street, sizes.walks / 10, seed); } },
    { "GatheredEverywhere",
      [&](std::uint64_t seed) { return shootGathered(street, sizes.walks / 40, seed, true); } }
  };
  std::vector<double> costs;
  for (const auto& [who, shoot] : contestants)
  {
    std::vector<CellField> fields;
    std::vector<double> seconds;
    Mean error;
    for (int round = 0; round < sizes.rounds; ++round)
    {
      const Shot shot = shoot(static_cast<std::uint64_t>(round) + 1);
      fields.push_back(shot.irradiance);
      seconds.push_back(shot.seconds);
      error.add(truth.squaredError(shot.irradiance, areas, all));
    }
    const std::string row = name + ", " + who;
    const Agreement agreement =
      requireAgreement(row, fields, truth, areas, all, biasOf(sizes.walks / 10));
    report(kFigures, row, "RMS error", std::sqrt(error.value()));
    report(kFigures, row, "s", seconds);
    report(kFigures, row, "mean / truth", agreement.ratio);
    report(kFigures, row, "systematic RMS", agreement.systematic);
    costs.push_back(error.value() * medianOf(seconds));
    if (costs.size() > 1)
    {
      report(kTable, row, "efficiency / plain gatherer's", costs[0] / costs.back(), { 3, 10 });
    }
  }
}

void compareDay(const Sizes& sizes)
{
  IrradianceEngine engine;
  double updates = 0, starts = 0;
  for (int step = 0; step < sizes.steps; ++step)
  {
    const SceneObjects objects = makeTrackers(24.0 * step / sizes.steps);
    const Shot update = shootDefault(engine, objects, sizes.walks / 10, 1);
    IrradianceEngine fresh;
    const Shot start = shootDefault(fresh, objects, sizes.walks / 10, 1);
    requireEqualAnswers(engine, fresh, objects);
    if (!(update.irradiance == start.irradiance).all())
    {
      throw std::runtime_error(
        "An update differs from a fresh start in step " + std::to_string(step));
    }
    updates += update.seconds;
    starts += start.seconds;
  }
  const std::string row = "a day of " + std::to_string(sizes.steps) + " steps";
  report(kTable, row, "updates / fresh starts", updates / starts, { 0.5, 0.2 });
  report(kFigures, row, "s of all updates", updates);
  report(kFigures, row, "s of all fresh starts", starts);
}

}

void run(const Arguments& arguments)
{
  Sizes sizes{};
  sizes.walks = arguments.number(0, 1000000u);
  sizes.rounds = std::max(2, arguments.number(1, 6));
  sizes.steps = arguments.number(2, 96);
  sizes.paths = arguments.number(3, 64u);
  sizes.truthPaths = arguments.number(4, 4096u);
  flushDenormals();
  compareWithDiffuse(sizes);
  findWalksOfOffice(sizes);
  compareStreet("street, overcast", test::overcastSky, plainOvercast, sizes);
  compareStreet("street, clear", test::cieSky(12), plainClear, sizes);
  compareDay(sizes);
}
