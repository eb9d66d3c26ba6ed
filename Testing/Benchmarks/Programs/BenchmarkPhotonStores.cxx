// SPDX-License-Identifier: BSD-3-Clause
/**
 * What it costs to keep photons, and to find the nearest of them. One thread, CPU time.
 *
 * CellPhotonSets: section 4.2 of the paper, a room with specular cells, whose photons are in a set
 * for each, beside the same room without any. LeafPhotons: all photons of a room, in the leaf cells
 * of its trees, beside the same frames without. In every round all have to hold the right photons.
 *
 * NearestPhotons: the 50 nearest to places at random on the surfaces of a room, by locators that
 * are built again in each frame, and by our leaf photons, of which only those of changed walks are
 * moved. Before any time counts, all have to find what a search of all photons finds. Ours takes
 * only photons on sides that face as the sensor does, from a flattened world. A frame asks once for
 * each of 640 x 480 pixels. A program with a photon map shoots walks without storing them, and
 * builds the map; ours verifies and repairs them, and moves photons.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [searches = 30000]
 */
#include "../../PhotonWalks/HistoryPhotons.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Photons/LeafPhotons.h"
#include "Rivals/CellPhotonSets.h"
#include "Rivals/PhotonLocator.h"
#include "Scenes/PlainRoom.h"
#include "Scenes/SurfaceSensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

using namespace irradiance;

namespace
{

void require(bool isRight, const std::string& what)
{
  if (!isRight)
  {
    throw std::runtime_error(what);
  }
}

const WalkHistory& historyOf(const IrradianceEngine& engine)
{
  return test::onlySet(engine).history();
}

/// In each place, in order.
using Contents = std::vector<std::vector<SegmentRef>>;

Contents contentsOf(const CellPhotonSets& sets, const SceneObjects& objects)
{
  Contents contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      contents.push_back(sets.sorted({ object, cell }));
    }
  }
  return contents;
}

Contents contentsOf(const LeafPhotons& photons, const SceneObjects& objects)
{
  Contents contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::uint32_t leaf = 0; leaf < photons.tree(object).numberOfBlocks(); ++leaf)
    {
      contents.emplace_back();
      for (const LeafPhoton& photon : photons.leaf(object, leaf).photons())
      {
        contents.back().push_back(photon.reference());
      }
      std::sort(contents.back().begin(), contents.back().end());
    }
  }
  return contents;
}

/// Throws unless photons that were kept up to date are where new ones are.
template <class Photons>
void checkAndReportMemory(const std::string& table, const std::string& row, const Photons& photons,
  const Photons& fresh, const SceneObjects& objects)
{
  const Contents contents = contentsOf(photons, objects);
  require(contents == contentsOf(fresh, objects), table + ": updated photons differ from new ones");
  double count = 0;
  for (const auto& each : contents)
  {
    count += static_cast<double>(each.size());
  }
  report(table, row, "bytes a photon", static_cast<double>(photons.bytes()) / count);
}

template <class Photons>
Photons collected(const IrradianceEngine& engine, Execution& execution)
{
  Photons photons(engine.objects());
  photons.add(historyOf(engine), 0, historyOf(engine).size(), execution);
  return photons;
}

constexpr int kFrames = 4;

/// A room with specular cells beside the same room without any. Its walks are longer.
void timeSpecularPhotons(const EngineSettings& settings, const EngineSettings& kept, int rounds)
{
  const std::string table = "CellPhotonSets", row = "20 % of the cells";
  const MovingScene matte = makePlainRoom(), glossy = makeGlossyRoom(0.2);
  CpuTime execution;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine plain, engine;
    CellPhotonSets sets;
    const double plainFirst = timeUpdate(plain, matte.at(0), settings).whole;
    const double first = timeUpdate(engine, glossy.at(0), kept).whole +
      threadCpuSecondsOf([&] { sets = collected<CellPhotonSets>(engine, execution); });
    report(table, row, "first shooting / without", first / plainFirst, { 1.35, 1.15 });
    report(table, row, "segments / without",
      static_cast<double>(engine.balance().segments) /
        static_cast<double>(plain.balance().segments));
    std::vector<Photon> photons = test::photonsOf(historyOf(engine));
    double frames = 0, plainFrames = 0;
    for (int frame = 1; frame <= kFrames; ++frame)
    {
      plainFrames += timeUpdate(plain, matte.inFrame(frame), settings).whole;
      frames += timeUpdate(engine, glossy.inFrame(frame), kept).whole;
      // Without the time to find what has changed, which the engine knows.
      std::vector<Photon> now = test::photonsOf(historyOf(engine));
      const PhotonChanges changes = test::changesBetween(photons, now);
      photons = std::move(now);
      frames += threadCpuSecondsOf([&] { sets.apply(changes, execution); });
    }
    report(table, row, "frame / without", frames / plainFrames, { 1.35, 1.15 });
    checkAndReportMemory(
      table, row, sets, collected<CellPhotonSets>(engine, execution), engine.objects());
  }
}

/// All photons in the leaf cells, kept up to date, beside the same frames without them.
void timeLeafPhotons(const EngineSettings& settings, const EngineSettings& kept, int rounds)
{
  constexpr double kSize = 1.05; // some 4 % of the walks change
  const std::string table = "LeafPhotons", row = "plain room";
  const MovingScene room = makePlainRoom(kSize);
  CpuTime execution;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine plain, engine;
    timeUpdate(plain, room.at(0), settings);
    timeUpdate(engine, room.at(0), kept);
    engine.collectPhotons(execution);
    double frames = 0, plainFrames = 0, changed = 0;
    for (int frame = 1; frame <= kFrames; ++frame)
    {
      plainFrames += timeUpdate(plain, room.inFrame(frame), settings).whole;
      frames += timeUpdate(engine, room.inFrame(frame), kept).whole;
      changed += static_cast<double>(engine.statistics().invalidWalks);
    }
    report(table, row, "share of a frame", 1 - plainFrames / frames, { 0.30, 0.10 });
    report(table, row, "walks changed, %", 100 * changed / kFrames / settings.numberOfWalks);
    checkAndReportMemory(
      table, row, engine.photons(), collected<LeafPhotons>(engine, execution), engine.objects());
  }
}

constexpr std::size_t kNearest = 50;

/// Whether a locator finds what a search of all photons, one by one, finds.
bool findsNearest(PhotonLocator& locator, const Sensor& sensor)
{
  locator.find(sensor, kNearest);
  std::vector<double> found = locator.squaredDistances(), all = locator.allSquaredDistances(sensor);
  std::sort(found.begin(), found.end());
  std::partial_sort(all.begin(), all.begin() + kNearest, all.end());
  // The rivals compute in floats: 2e-7 m each for coordinates up to 4 m.
  return std::equal(found.begin(), found.end(), all.begin(), all.begin() + kNearest,
    [](double a, double b) { return std::abs(std::sqrt(a) - std::sqrt(b)) < 2e-6; });
}

struct Contestant
{
  std::string name;
  std::unique_ptr<PhotonLocator> locator;
};

/// `walks`: the seconds that walks take in a frame. Returns searches a second, with the building.
double timeSearches(const Contestant& contestant, const std::vector<Sensor>& sensors, double walks)
{
  constexpr double kPixels = 640 * 480;
  PhotonLocator& locator = *contestant.locator;
  const double building = threadCpuSecondsOf([&] { locator.build(); });
  const double search = threadCpuSecondsOf([&] {
    for (const Sensor& sensor : sensors)
    {
      locator.find(sensor, kNearest);
    }
  }) /
    static_cast<double>(sensors.size());
  const double searches = kPixels * search, frame = walks + building + searches;
  const double perSecond = kPixels / (building + searches);
  const auto add = [&](const std::string& what, double value) {
    report("NearestPhotons", contestant.name, what, value);
  };
  add("built or kept up to date, s", building);
  add("us a search", 1e6 * search);
  add("searches a second, building counted", perSecond);
  add("frame, s", frame);
  add("share of a frame: searches, %", 100 * searches / frame);
  add("share of a frame: building, %", 100 * building / frame);
  return perSecond;
}

void timeNearestPhotons(
  const EngineSettings& settings, const EngineSettings& kept, int rounds, std::size_t searches)
{
  const MovingScene scene = makePlainRoom();
  std::array<IrradianceEngine, 2> engines; // two frames that follow each other
  for (int frame = 0; frame < 2; ++frame)
  {
    timeUpdate(engines[frame], scene.inFrame(frame), kept);
  }
  const std::vector<Sensor> sensors = makeSurfaceSensors(scene.inFrame(0), searches);
  std::vector<Contestant> contestants;
  contestants.push_back({ "photon map", makePhotonMapLocator(engines[0]) });
  contestants.push_back({ "vtkStaticPointLocator", makeVtkLocator(engines[0]) });
  contestants.push_back({ "leaf photons", makeLeafLocator(engines[0], engines[1]) });
  for (const Contestant& contestant : contestants)
  {
    contestant.locator->build();
    require(
      std::all_of(sensors.begin(), sensors.begin() + std::min<std::ptrdiff_t>(100, sensors.size()),
        [&](const Sensor& sensor) { return findsNearest(*contestant.locator, sensor); }),
      "The " + contestant.name + " finds other photons");
  }
  EngineSettings forgetting = settings; // what stores nothing
  forgetting.verify = false;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine shooting, updating;
    const double shot = timeUpdate(shooting, scene.inFrame(0), forgetting).whole;
    timeUpdate(updating, scene.inFrame(0), settings);
    const double updated = timeUpdate(updating, scene.inFrame(1), settings).whole;
    const double theirs[] = { timeSearches(contestants[0], sensors, shot),
      timeSearches(contestants[1], sensors, shot) };
    const double ours = timeSearches(contestants[2], sensors, updated);
    for (std::size_t i = 0; i < std::size(theirs); ++i)
    {
      report("NearestPhotonsRatios", contestants[2].name + " / " + contestants[i].name,
        "searches a second, building counted", ours / theirs[i], { 1, 3 });
    }
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  EngineSettings kept = settings; // as the filter asks for photons
  kept.keepPhotons = true;
  const int rounds = arguments.number(1, 5);
  timeSpecularPhotons(settings, kept, rounds);
  timeLeafPhotons(settings, kept, rounds);
  timeNearestPhotons(settings, kept, rounds, arguments.number(2, std::size_t{ 30000 }));
}
