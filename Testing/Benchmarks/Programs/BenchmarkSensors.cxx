// SPDX-License-Identifier: BSD-3-Clause
/**
 * What sensors in the air cost: 2,500 little sheets with two sides, so 5,000 sensors, at random
 * places and turns in rooms. The rival is the plain program with Embree that gathers
 * (Rivals/PlainGatherer.h): for it the sheets are black triangles of half a millimetre in the room,
 * which hide nothing that matters. Both find the sum of both sides; ours must agree with what the
 * rival finds with many paths, twice, before any time counts, but for the bias of cells as patches
 * that rays read. Few sheets near the lamp have most of the rival's noise, so it cannot tell how
 * small our errors are: for these the truth is found, twice, by our paths alone, which read no
 * sums; and that must agree with the rival, too. Ours reads the sums of walks, which are shot once
 * for all sensors: their time is reported by itself.
 *
 * Then the ring moves, frame by frame: sensors whose rays are kept are brought up to date
 * (StoredSensors), beside sensors that gather anew, on the same engine. Both must have the same
 * bits.
 *
 * One thread, CPU time, in turns. "To 2 %": times the square of the error over .02. Building
 * Embree's scene is not counted.
 *
 * Arguments: [walks = 100000] [rounds = 3] [sheets = 2500] [paths of half the truth = 512]
 * [rooms = 4]
 */
#include "../../PhotonWalks/TestScenes.h"
#include "../../RayCasting/RandomVectors.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/HalvedTruth.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Measuring/Shot.h"
#include "Photons/NearestPhotons.h"
#include "Rivals/PlainGatherer.h"
#include "Scenes/PlainRoom.h"
#include "Scenes/SurfaceSensors.h"
#include "Views/SensorFinalGather.h"
#include "Views/StoredSensors.h"

#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>

using namespace irradiance;

namespace
{

const std::string kTable = "Sensors";
const std::string kRatios = "SensorsRatios";
constexpr double kError = 0.02;

struct Sizes
{
  std::uint32_t walks, truthPaths;
  int rounds, sheets;
};

struct Sheet
{
  Vector3 place, normal;
};

std::vector<Sheet> makeSheets(int count)
{
  test::RandomVectors random(11);
  std::vector<Sheet> sheets;
  for (int i = 0; i < count; ++i)
  {
    const Vector3 place = Vector3(2, 2, 1.5) + random.inCube().cwiseProduct(Vector3(1.9, 1.9, 1.4));
    sheets.push_back({ place, random.inCube().normalized() });
  }
  return sheets;
}

SceneObject sheetsAsObject(const std::vector<Sheet>& sheets)
{
  constexpr double kEdge = 5e-4;
  test::ObjectBuilder builder;
  for (const Sheet& sheet : sheets)
  {
    const Vector3 u = kEdge * sheet.normal.unitOrthogonal(), v = sheet.normal.cross(u);
    const Vector3 corner = sheet.place - (u + v) / 3;
    builder.addCell({ { corner, corner + u, corner + v } }, test::grey(0));
  }
  return builder.build();
}

/// Of walks so few that no sums are read.
EngineSettings fewWalks(std::uint64_t seed)
{
  EngineSettings few;
  few.numberOfWalks = 100;
  few.separateSides = true;
  few.seed = seed;
  return few;
}

/// What is found, and the time for it without that of the walks.
struct Run
{
  CellField values;
  double seconds, walks = 0;
};

struct Contestant
{
  std::string name;
  std::function<Run(std::uint64_t seed)> run;
  std::vector<Run> runs = {};
};

/// In the first band.
CellField valuesAt(const SensorFinalGather& gather, const std::vector<Sensor>& sensors)
{
  constexpr std::size_t kUnit = 64;
  CellField values(sensors.size());
  for (std::size_t first = 0; first < sensors.size(); first += kUnit)
  {
    std::vector<std::size_t> unit(std::min(kUnit, sensors.size() - first));
    std::iota(unit.begin(), unit.end(), first);
    SensorFinalGather::Rays rays;
    std::int64_t cast = 0;
    const auto found = gather.update(sensors, unit, nullptr, rays, cast);
    for (std::size_t i = 0; i < unit.size(); ++i)
    {
      values[static_cast<Eigen::Index>(unit[i])] = SensorFinalGather::lightOf(found[i]).value[0];
    }
  }
  return values;
}

/// `measure(engine, execution)` finds the values of an engine's walks.
template <class Measure>
Run measured(const SceneObjects& objects, const EngineSettings& settings, const Measure& measure)
{
  IrradianceEngine engine;
  CpuTime execution;
  Run run{ {}, 0, timeUpdate(engine, objects, settings).whole };
  run.seconds = threadCpuSecondsOf([&] { run.values = measure(engine, execution); });
  return run;
}

Run gatherAt(const SceneObjects& objects, const EngineSettings& settings,
  const std::vector<Sensor>& sensors, std::uint32_t rays)
{
  return measured(objects, settings, [&](IrradianceEngine& engine, Execution& execution) {
    return valuesAt(SensorFinalGather(engine, rays, execution), sensors);
  });
}

/// With the direct light that the cells of their feet gather.
Run findNearest(const SceneObjects& objects, EngineSettings settings,
  const std::vector<Sensor>& sensors, std::uint32_t photons)
{
  settings.keepPhotons = true;
  return measured(objects, settings, [&](IrradianceEngine& engine, Execution& execution) {
    CellField values(sensors.size());
    engine.collectPhotons(execution);
    engine.prepareSurfaces(execution);
    const NearestPhotons nearest = engine.nearestPhotons();
    const std::deque<PointDirectLight> lights = gatheredLightsOf(engine);
    for (std::size_t i = 0; i < sensors.size(); ++i)
    {
      const std::optional<Foot> foot = nearest.footOf(sensors[i], usualDistance(nearest));
      const NearestEstimate estimate =
        nearestEstimate(nearest, foot.value(), photons, usualRadius(nearest, photons));
      values[static_cast<Eigen::Index>(i)] = engine.watts(estimate.power[0]) / estimate.area +
        directLightAt(*foot, i, lights, engine.scene())[0];
    }
    return values;
  });
}

class Room
{
public:
  Room(const SceneObjects& objects, const std::vector<Sheet>& sheets)
    : objects_(objects)
    , sheets_(sheets)
    , gatherer_(makePlainScene(withSheets(objects, sheets)))
    , firstSheet_(static_cast<std::uint32_t>(areasOf(objects).size()))
  {
  }

  Run gatherPlain(std::uint32_t paths, std::uint64_t seed) const
  {
    PlainGatherer::Tally tally;
    const double seconds = threadCpuSecondsOf([&] {
      tally = gatherer_.gather(
        firstSheet_, firstSheet_ + static_cast<std::uint32_t>(sheets_.size()), paths, seed);
    });
    return { Eigen::Map<const CellField>(
               tally.irradiance.data(), static_cast<Eigen::Index>(sheets_.size())),
      seconds };
  }
  std::vector<Sensor> sensors() const
  {
    std::vector<Sensor> sensors;
    for (const Sheet& sheet : sheets_)
    {
      sensors.push_back({ sheet.place, sheet.normal });
      sensors.push_back({ sheet.place, -sheet.normal });
    }
    return sensors;
  }
  /// Of both sides together.
  Run gatherOurs(const EngineSettings& settings, std::uint32_t rays) const
  {
    Run run = gatherAt(objects_, settings, sensors(), rays);
    run.values = run.values.reshaped(2, run.values.size() / 2).colwise().sum().transpose().eval();
    return run;
  }

private:
  static SceneObjects withSheets(SceneObjects objects, const std::vector<Sheet>& sheets)
  {
    objects.dynamicObjects.push_back(sheetsAsObject(sheets));
    return objects;
  }

  SceneObjects objects_;
  std::vector<Sheet> sheets_;
  PlainGatherer gatherer_;
  std::uint32_t firstSheet_;
};

double medianOfSeconds(const Contestant& contestant)
{
  std::vector<double> seconds;
  for (const Run& run : contestant.runs)
  {
    seconds.push_back(run.seconds);
  }
  return medianOf(seconds);
}

void reportError(const std::string& row, const Contestant& contestant, double squaredError)
{
  std::vector<double> seconds, walks;
  for (const Run& run : contestant.runs)
  {
    seconds.push_back(run.seconds);
    walks.push_back(run.walks);
  }
  const std::string who = row + ", " + contestant.name;
  report(kTable, who, "RMS error, %", 100 * std::sqrt(squaredError));
  report(kTable, who, "s", seconds);
  report(kTable, who, "walks, s", walks);
  report(kTable, who, "s to 2 %", medianOfSeconds(contestant) * squaredError / (kError * kError));
}

/// By seeds, in turns.
void runRounds(std::vector<Contestant>& contestants, int rounds)
{
  for (int round = 0; round < rounds; ++round)
  {
    for (Contestant& contestant : contestants)
    {
      contestant.runs.push_back(contestant.run(static_cast<std::uint64_t>(round) + 1));
    }
  }
}

double meanSquaredError(const Contestant& contestant, const HalvedTruth& truth)
{
  const Eigen::Index count = truth.first.size();
  Mean error;
  for (const Run& run : contestant.runs)
  {
    error.add(truth.squaredError(run.values, CellField::Ones(count), { "sensors", 0, count }));
  }
  return error.value();
}

/// Sensors on surfaces, which the nearest photons know, too. The truth is gathered by paths alone:
/// of so few walks no sums are read.
void compareOnSurfaces(const std::string& name, const SceneObjects& objects, const Sizes& sizes)
{
  const std::vector<Sensor> sensors =
    makeSurfaceSensors(objects, static_cast<std::size_t>(sizes.sheets));
  const HalvedTruth truth{ gatherAt(objects, fewWalks(100000), sensors, sizes.truthPaths).values,
    gatherAt(objects, fewWalks(100001), sensors, sizes.truthPaths).values };
  EngineSettings settings;
  settings.separateSides = true;
  std::vector<Contestant> contestants;
  for (const bool gathersDirectLight : { false, true })
  {
    settings.gathersDirectLight = gathersDirectLight;
    settings.numberOfWalks = 10 * sizes.walks;
    const std::string light = gathersDirectLight ? ", direct light gathered" : ", shot";
    contestants.push_back({ "nearest 50" + light, [&, settings](std::uint64_t seed) {
                             return findNearest(objects, withSeed(settings, seed), sensors, 50);
                           } });
    settings.numberOfWalks = sizes.walks;
    contestants.push_back({ "gathered, 64 rays" + light, [&, settings](std::uint64_t seed) {
                             return gatherAt(objects, withSeed(settings, seed), sensors, 64);
                           } });
  }
  runRounds(contestants, sizes.rounds);
  for (const Contestant& contestant : contestants)
  {
    reportError(name + ", on surfaces", contestant, meanSquaredError(contestant, truth));
  }
}

void compare(const std::string& name, const Room& room, const Sizes& sizes)
{
  EngineSettings settings;
  settings.numberOfWalks = sizes.walks;
  settings.separateSides = settings.gathersDirectLight = true;
  std::vector<Contestant> contestants{ { "plain gatherer, 32 paths",
    [&](std::uint64_t seed) { return room.gatherPlain(32, seed); } } };
  for (const std::uint32_t rays : { 16u, 32u, 64u, 128u })
  {
    contestants.push_back({ "ours, " + std::to_string(rays) + " rays",
      [&, rays](std::uint64_t seed) { return room.gatherOurs(withSeed(settings, seed), rays); } });
  }
  const std::uint64_t truthSeed = 100000;
  const HalvedTruth check{ room.gatherPlain(sizes.truthPaths, truthSeed).values,
    room.gatherPlain(sizes.truthPaths, truthSeed + 1).values };
  const HalvedTruth truth{ room.gatherOurs(fewWalks(truthSeed), sizes.truthPaths / 2).values,
    room.gatherOurs(fewWalks(truthSeed + 1), sizes.truthPaths / 2).values };
  runRounds(contestants, sizes.rounds);
  const CellField even = CellField::Ones(truth.first.size());
  const CellSet all{ "sensors", 0, truth.first.size() };
  requireAgreement("paths alone, " + name, { truth.first, truth.second }, check, even, all, 0.03);
  std::vector<double> costs;
  for (const Contestant& contestant : contestants)
  {
    std::vector<CellField> fields;
    for (const Run& run : contestant.runs)
    {
      fields.push_back(run.values);
    }
    const Agreement agreement =
      requireAgreement(contestant.name + ", " + name, fields, check, even, all, 0.03);
    report(kTable, name + ", " + contestant.name, "mean / truth", agreement.ratio);
    report(kTable, name + ", " + contestant.name, "systematic RMS, %", 100 * agreement.systematic);
    const double error = meanSquaredError(contestant, truth);
    reportError(name, contestant, error);
    costs.push_back(medianOfSeconds(contestant) * error);
  }
  for (std::size_t i = 1; i < costs.size(); ++i)
  {
    const std::string row = name + ", " + contestants[i].name;
    report(kRatios, row, "efficiency / plain gatherer", costs[0] / costs[i]);
    const double sensors = 2 * static_cast<double>(truth.first.size());
    for (const Run& run : contestants[i].runs)
    {
      const double share = costs[i] / medianOfSeconds(contestants[i]) / (kError * kError);
      report(kRatios, row, "10,000 sensors to 2 %, with the walks, s",
        run.walks + share * run.seconds * 10000 / sensors, { 0.5, 0.2 });
    }
  }
}

void compareUpdates(const MovingScene& scene, const Room& room, const Sizes& sizes)
{
  constexpr std::uint32_t kRays = 64;
  EngineSettings settings;
  settings.numberOfWalks = sizes.walks;
  settings.separateSides = settings.gathersDirectLight = true;
  const auto engine = std::make_shared<IrradianceEngine>();
  const std::vector<Sensor> sensors = room.sensors();
  CpuTime execution;
  StoredSensors stored;
  for (int frame = 0; frame <= 5 * sizes.rounds; ++frame)
  {
    engine->update(scene.inFrame(frame), settings, execution);
    const double update =
      threadCpuSecondsOf([&] { stored.update(engine, sensors, kRays, true, execution); });
    StoredSensors fresh;
    const double anew =
      threadCpuSecondsOf([&] { fresh.update(engine, sensors, kRays, false, execution); });
    if (std::memcmp(stored.lights().data(), fresh.lights().data(),
          sensors.size() * sizeof(SensorFinalGather::Light)) != 0)
    {
      throw std::runtime_error("The bits of sensors differ");
    }
    if (frame > 0)
    {
      report(kRatios, scene.name + ", a frame", "update / anew", update / anew);
      report(kRatios, scene.name + ", a frame", "rays cast, %",
        100 * static_cast<double>(stored.numberCast()) / static_cast<double>(fresh.numberCast()));
      report(kRatios, scene.name + ", a frame", "kB / sensor",
        1e-3 * static_cast<double>(stored.bytes()) / static_cast<double>(sensors.size()));
    }
  }
}

}

void run(const Arguments& arguments)
{
  Sizes sizes{};
  sizes.walks = arguments.number(0, 100000u);
  sizes.rounds = std::max(2, arguments.number(1, 3));
  sizes.sheets = arguments.number(2, 2500);
  sizes.truthPaths = arguments.number(3, 512u);
  flushDenormals();
  const std::vector<MovingScene> rooms = makeGatheringRooms();
  const std::size_t count = std::min(rooms.size(), arguments.number(4, std::size_t{ 4 }));
  for (std::size_t i = 0; i < count; ++i)
  {
    const Room room(rooms[i].at(0), makeSheets(sizes.sheets));
    compareUpdates(rooms[i], room, sizes);
    compare(rooms[i].name, room, sizes);
    compareOnSurfaces(rooms[i].name, rooms[i].at(0), sizes);
  }
}
