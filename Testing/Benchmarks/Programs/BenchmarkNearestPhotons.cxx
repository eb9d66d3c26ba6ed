// SPDX-License-Identifier: BSD-3-Clause
/**
 * How fast the photons nearest to a place are found, by locators that are built anew in each frame: the 50
 * nearest to places at random on the surfaces of a room. Before any time counts, the locators have to find
 * what a search of all photons finds. One thread, CPU time.
 *
 * A frame is what a program with a photon map does: it shoots walks without storing them, builds the map,
 * and asks it once for each of 640 x 480 pixels.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [searches = 30000]
 */
#include "../../PhotonWalks/HistoryChanges.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Rivals/PhotonLocator.h"
#include "Scenes/PlainRoom.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

using namespace irradiance;

namespace
{

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
  std::mt19937_64 random(3);
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

/// By a search of all photons, one by one: m2, in order.
std::vector<double> nearestOf(const std::vector<Vector3>& photons, const Sensor& sensor)
{
  std::vector<double> squaredDistances;
  for (const Vector3& photon : photons)
  {
    squaredDistances.push_back((photon - sensor.point).squaredNorm());
  }
  std::partial_sort(
    squaredDistances.begin(), squaredDistances.begin() + kNearest, squaredDistances.end());
  squaredDistances.resize(kNearest);
  return squaredDistances;
}

bool findsNearest(
  PhotonLocator& locator, const Sensor& sensor, const std::vector<double>& squaredDistances)
{
  locator.find(sensor, kNearest);
  std::vector<double> found = locator.squaredDistances();
  std::sort(found.begin(), found.end());
  // The locators compute in floats: 2e-7 m each for coordinates up to 4 m.
  return std::equal(found.begin(), found.end(), squaredDistances.begin(), squaredDistances.end(),
    [](double a, double b) { return std::abs(std::sqrt(a) - std::sqrt(b)) < 2e-6; });
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

void check(const std::vector<Contestant>& contestants, const std::vector<Sensor>& sensors,
  const std::vector<Vector3>& photons)
{
  constexpr std::size_t kChecked = 100;
  for (std::size_t i = 0; i < std::min(kChecked, sensors.size()); ++i)
  {
    const std::vector<double> nearest = nearestOf(photons, sensors[i]);
    for (const Contestant& contestant : contestants)
    {
      if (!findsNearest(*contestant.locator, sensors[i], nearest))
      {
        throw std::runtime_error("The " + contestant.name + " finds other photons");
      }
    }
  }
}

/// What a shooting takes that stores nothing.
double shootingSeconds(const SceneObjects& objects, EngineSettings settings)
{
  settings.verify = false;
  IrradianceEngine engine;
  return timeUpdate(engine, objects, settings).whole;
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  const SceneObjects objects = makePlainRoom().at(0);
  const std::vector<Sensor> sensors =
    makeSensors(objects, arguments.number(2, std::size_t{ 30000 }));
  IrradianceEngine engine;
  timeUpdate(engine, objects, settings);
  const std::vector<Vector3> photons = photonPoints(engine, objects);
  report("NearestPhotonsCount", "photons", "millions", 1e-6 * static_cast<double>(photons.size()));
  const std::vector<Contestant> contestants = makeContestants(photons);
  for (const Contestant& contestant : contestants)
  {
    contestant.locator->build();
  }
  check(contestants, sensors, photons);
  for (int round = 0; round < rounds; ++round)
  {
    const double shooting = shootingSeconds(objects, settings);
    for (const Contestant& contestant : contestants)
    {
      PhotonLocator& locator = *contestant.locator;
      const double building = threadCpuSecondsOf([&] { locator.build(); });
      const double searches = threadCpuSecondsOf([&] {
        for (const Sensor& sensor : sensors)
        {
          locator.find(sensor, kNearest);
        }
      });
      reportFrame(
        contestant.name, shooting, building, searches / static_cast<double>(sensors.size()));
    }
  }
}
