// SPDX-License-Identifier: BSD-3-Clause
/**
 * What it costs to keep photons, and to find them again. One thread, CPU time.
 *
 * PhotonSets: photons come to sets at random and leave them, beside the standard library's hash table and
 * a vector that is searched from end to end. SpecularPhotons: those of a room with specular cells, made
 * from its walks, and updated with what changes in a frame. NearestPhotons: the 50 nearest to places on
 * the surfaces, by locators that are built anew in each frame. Before any time counts, all have to hold,
 * or to find, the same photons.
 *
 * Arguments: [walks = 1000000] [rounds = 5]
 */
#include "../../PhotonWalks/HistoryChanges.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Photons/SpecularPhotons.h"
#include "Rivals/PhotonBags.h"
#include "Rivals/PhotonLocator.h"
#include "Scenes/PhotonTraffic.h"
#include "Scenes/PlainRoom.h"

#include <cmath>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

using Random = std::mt19937_64;

void require(bool isRight, const std::string& what)
{
  if (!isRight)
  {
    throw std::runtime_error(what);
  }
}

/// Seconds of this thread's CPU time.
template <class Work>
double secondsOf(const Work& work)
{
  const double start = threadCpuSeconds();
  work();
  return threadCpuSeconds() - start;
}

// ---- Photon sets

/// Prefetches what the later steps will need, as SpecularPhotons does.
template <class Bag, class Work>
void forEachStep(
  std::vector<Bag>& bags, const std::vector<PhotonTraffic::Step>& steps, const Work& work)
{
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    prefetchLine(&bags[steps[std::min(i + 2 * kAhead, steps.size() - 1)].set]);
    const PhotonTraffic::Step& later = steps[std::min(i + kAhead, steps.size() - 1)];
    bags[later.set].prefetch(later.photon);
    work(bags[steps[i].set], steps[i].photon);
  }
}

template <class Bag>
void requireContents(const std::vector<Bag>& bags, const std::vector<PhotonTraffic::Photons>& model)
{
  for (std::size_t i = 0; i < bags.size(); ++i)
  {
    PhotonTraffic::Photons expected = model[i], found;
    bags[i].forEach([&](const PhotonReference& photon) { found.push_back(photon); });
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    require(found == expected, std::string(Bag::kName) + " holds other photons");
  }
}

/// After as many changes as there are photons, so that nothing is as new. `size`: photons in a set.
template <class Bag>
void timeSets(std::size_t photons, std::size_t size, int rounds)
{
  const auto insert = [](Bag& bag, const PhotonReference& photon) { bag.insert(photon); };
  const auto remove = [](Bag& bag, const PhotonReference& photon) { bag.remove(photon); };
  constexpr int kRoundsToAge = 10;
  PhotonTraffic traffic(photons / size, size);
  std::vector<Bag> bags(traffic.photons().size());
  forEachStep(bags, traffic.arrived(), insert);
  std::vector<double> removal, insertion;
  for (int round = -kRoundsToAge; round < rounds; ++round)
  {
    traffic.nextRound(photons / kRoundsToAge);
    const double perStep = 1e9 / static_cast<double>(traffic.gone().size());
    const double gone = secondsOf([&] { forEachStep(bags, traffic.gone(), remove); });
    const double arrived = secondsOf([&] { forEachStep(bags, traffic.arrived(), insert); });
    requireContents(bags, traffic.photons());
    if (round >= 0)
    {
      removal.push_back(perStep * gone);
      insertion.push_back(perStep * arrived);
    }
  }
  double bytes = 0;
  for (const Bag& bag : bags)
  {
    bytes += static_cast<double>(bag.memory());
  }
  const std::string row = std::string(Bag::kName) + ", " + std::to_string(size) + " photons each";
  const bool isMain = std::is_same_v<Bag, OurBag> && size == 500;
  if (isMain)
  {
    report("PhotonSets", row, "insertion, ns", insertion, { 60, 25 });
    report("PhotonSets", row, "removal, ns", removal, { 60, 25 });
  }
  report("PhotonSetSizes", row, "insertion, ns", insertion);
  report("PhotonSetSizes", row, "removal, ns", removal);
  report("PhotonSetSizes", row, "bytes a photon", bytes / static_cast<double>(photons));
}

/// The mean over all sizes up to the largest, of a set that grows.
void measureBytes()
{
  constexpr std::uint32_t kMost = 10000;
  OurBag set;
  double sum = 0;
  while (set.size() < kMost)
  {
    set.insert({ static_cast<std::uint32_t>(set.size()), 0 });
    sum += static_cast<double>(set.memory()) / static_cast<double>(set.size());
  }
  report("PhotonSets", "PhotonSet, mean over sizes of 1 to " + std::to_string(kMost),
    "bytes a photon", sum / kMost, { 24, 12 });
}

void timeAllSets(std::size_t photons, int rounds)
{
  for (const std::size_t size : { 5, 50, 500, 5000 })
  {
    timeSets<OurBag>(photons, size, rounds);
    timeSets<StandardBag>(photons, size, rounds);
    timeSets<PlainBag>(photons, size, rounds);
  }
  measureBytes();
}

// ---- Photons on specular cells

/// A share of the cells reflects half of what it absorbed before in a lobe.
std::shared_ptr<const Material> glossy(Material material, double share, Random& random)
{
  std::vector<double> specular;
  for (const double diffuse : material.reflectance)
  {
    specular.push_back(
      std::uniform_real_distribution<double>()(random) < share ? 0.5 * (1 - diffuse) : 0.0);
  }
  material.setSpecular(specular, std::vector<double>(material.numberOfCells, 50.0));
  return std::make_shared<const Material>(std::move(material));
}

MovingScene makeGlossyRoom(double share)
{
  Random random(1);
  MovingScene room = makePlainRoom();
  room.objects.staticObject.material = glossy(*room.objects.staticObject.material, share, random);
  for (SceneObject& object : room.objects.dynamicObjects)
  {
    object.material = glossy(*object.material, share, random);
  }
  return room;
}

/// What is on each cell.
std::vector<PhotonTraffic::Photons> contentsOf(
  const SpecularPhotons& sets, const SceneObjects& objects)
{
  std::vector<PhotonTraffic::Photons> contents;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::size_t cell = 0; cell < objects[object].material->numberOfCells; ++cell)
    {
      contents.push_back(sets.sorted(object, cell));
    }
  }
  return contents;
}

SpecularPhotons specularPhotonsOf(const SceneObjects& objects, const IrradianceEngine& engine)
{
  CpuTime serial;
  SpecularPhotons sets(objects);
  sets.add({ engine.plan(), engine.history() }, 0, engine.history().size(), serial);
  return sets;
}

void timeSpecularPhotons(const EngineSettings& settings, int rounds)
{
  const std::string table = "SpecularPhotons", row = "20 % of the cells";
  const MovingScene scene = makeGlossyRoom(0.2);
  IrradianceEngine engine;
  CpuTime serial;
  const double shooting = timeUpdate(engine, scene.at(0), settings).whole;
  SpecularPhotons sets = specularPhotonsOf(scene.at(0), engine);
  std::vector<Photon> photons = test::photonsOf(engine);
  for (int round = 0; round < rounds; ++round)
  {
    const double building = secondsOf([&] { specularPhotonsOf(scene.at(0), engine); });
    report(table, row, "built, ms", 1e3 * building);
    report(table, row, "built / first shooting", building / shooting);
  }
  for (int frame = 1; frame <= 2 * rounds; ++frame)
  {
    const SceneObjects objects = scene.inFrame(frame);
    const double update = timeUpdate(engine, objects, settings).whole;
    const std::vector<Photon> now = test::photonsOf(engine);
    const PhotonChanges changes = test::changesBetween(photons, now);
    photons = now;
    const double applying = secondsOf([&] { sets.apply(changes, serial); });
    require(contentsOf(sets, objects) == contentsOf(specularPhotonsOf(objects, engine), objects),
      "Updated photons differ from new ones");
    report(table, row, "updated, ms", 1e3 * applying);
    report(table, row, "updated / frame", applying / update);
    report(table, row, "changed walks, %",
      100.0 * static_cast<double>(engine.statistics().invalidWalks) / settings.numberOfWalks);
  }
  std::size_t count = 0;
  for (const PhotonTraffic::Photons& cell : contentsOf(sets, scene.at(0)))
  {
    count += cell.size();
  }
  report(table, row, "photons, millions", 1e-6 * static_cast<double>(count));
  report(
    table, row, "bytes a photon", static_cast<double>(sets.bytes()) / static_cast<double>(count));
}

// ---- Nearest photons

constexpr std::size_t kNearest = 50;
constexpr double kPixels = 640 * 480; ///< searches of a frame

/// Corners in the world.
Triangle triangleOf(const SceneObjects& objects, const TriangleId& id)
{
  const SceneObject& object = objects[id.object];
  return transformed(object.worldFromObject, object.body->mesh().triangles()[id.triangle]);
}

/// To the front, as long as twice the area.
Vector3 normalOf(const Triangle& triangle)
{
  return (triangle.b - triangle.a).cross(triangle.c - triangle.a);
}

Vector3 pointOn(const Triangle& triangle, double b, double c)
{
  return (1 - b - c) * triangle.a + b * triangle.b + c * triangle.c;
}

std::vector<Vector3> photonPoints(const IrradianceEngine& engine, const SceneObjects& objects)
{
  std::vector<Vector3> points;
  for (const Photon& photon : test::photonsOf(engine))
  {
    points.push_back(pointOn(triangleOf(objects, photon.id), photon.weights[0], photon.weights[1]));
  }
  return points;
}

/// Uniform over the area, on the front.
std::vector<Sensor> makeSensors(const SceneObjects& objects, std::size_t count)
{
  std::vector<Triangle> triangles;
  std::vector<double> areas;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (std::uint32_t i = 0; i < objects[object].body->mesh().triangles().size(); ++i)
    {
      triangles.push_back(triangleOf(objects, { object, i }));
      areas.push_back(normalOf(triangles.back()).norm());
    }
  }
  Random random(3);
  std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
  std::uniform_real_distribution<double> unit;
  std::vector<Sensor> sensors;
  while (sensors.size() < count)
  {
    const Triangle& triangle = triangles[choose(random)];
    const double s = std::sqrt(unit(random)), t = s * unit(random);
    sensors.push_back({ pointOn(triangle, s - t, t), normalOf(triangle).normalized() });
  }
  return sensors;
}

/// Beside a search of all photons, one by one.
void requireNearest(
  PhotonLocator& locator, const Sensor& sensor, const std::vector<Vector3>& photons)
{
  std::vector<double> all;
  for (const Vector3& photon : photons)
  {
    all.push_back((photon - sensor.point).squaredNorm());
  }
  std::partial_sort(all.begin(), all.begin() + kNearest, all.end());
  locator.find(sensor, kNearest);
  std::vector<double> found = locator.squaredDistances();
  std::sort(found.begin(), found.end());
  // The locators compute in floats.
  require(found.size() == kNearest &&
      std::equal(found.begin(), found.end(), all.begin(),
        [](double a, double b) { return std::abs(std::sqrt(a) - std::sqrt(b)) < 1e-5; }),
    "A locator finds other photons");
}

struct Contestant
{
  std::string name;
  std::unique_ptr<PhotonLocator> locator;
};

/// The photons are those of an engine. (What finds them in the leaf cells of the engine's own trees
/// joins here; it keeps its photons up to date instead of building anything.)
std::vector<Contestant> makeContestants(const std::vector<Vector3>& photons)
{
  std::vector<Contestant> contestants;
  contestants.push_back({ "photon map", makePhotonMapLocator(photons, 1) });
  contestants.push_back({ "vtkStaticPointLocator", makeVtkLocator(photons) });
  return contestants;
}

/// A frame: walks are shot, and not stored; the locator is built; each pixel asks it.
void reportFrame(const std::string& row, double shooting, double building, double search)
{
  const double searches = kPixels * search, frame = shooting + building + searches;
  report("NearestPhotons", row, "built, s", building);
  report("NearestPhotons", row, "us a search", 1e6 * search);
  report(
    "NearestPhotons", row, "searches a second, building counted", kPixels / (building + searches));
  report("NearestPhotons", row, "share of a frame: searches, %", 100 * searches / frame);
  report("NearestPhotons", row, "share of a frame: building, %", 100 * building / frame);
}

void timeNearestPhotons(EngineSettings settings, int rounds)
{
  const SceneObjects objects = makePlainRoom().at(0);
  IrradianceEngine engine;
  timeUpdate(engine, objects, settings);
  const std::vector<Vector3> photons = photonPoints(engine, objects);
  const std::vector<Sensor> sensors = makeSensors(objects, 30000);
  const std::vector<Contestant> contestants = makeContestants(photons);
  for (const Contestant& contestant : contestants)
  {
    contestant.locator->build();
    for (std::size_t i = 0; i < 30; ++i)
    {
      requireNearest(*contestant.locator, sensors[i], photons);
    }
  }
  settings.verify = false;
  for (int round = 0; round < rounds; ++round)
  {
    IrradianceEngine plain;
    const double shooting = timeUpdate(plain, objects, settings).whole;
    for (const Contestant& contestant : contestants)
    {
      PhotonLocator& locator = *contestant.locator;
      const double building = secondsOf([&] { locator.build(); });
      const double searches = secondsOf([&] {
        for (const Sensor& sensor : sensors)
        {
          locator.find(sensor, kNearest);
        }
      });
      reportFrame(
        contestant.name, shooting, building, searches / static_cast<double>(sensors.size()));
    }
  }
  report("NearestPhotons", contestants.front().name, "photons, millions",
    1e-6 * static_cast<double>(photons.size()));
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  timeAllSets(settings.numberOfWalks, rounds);
  timeSpecularPhotons(settings, rounds);
  timeNearestPhotons(settings, rounds);
}
