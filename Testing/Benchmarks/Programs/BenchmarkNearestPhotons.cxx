// SPDX-License-Identifier: BSD-3-Clause
/**
 * How fast the photons nearest to a place are found: the 50 nearest to places at random on the
 * surfaces of a room, by locators that are built again in each frame, and by our leaf photons, of
 * which only those of changed walks are moved. Before any time counts, all have to find what a
 * search of all photons finds. Ours takes only photons on sides that face as the sensor does, from
 * a flattened world. One thread, CPU time.
 *
 * A frame asks once for each of 640 x 480 pixels. A program with a photon map shoots walks without
 * storing them, and builds the map; ours verifies and repairs them, and moves photons.
 *
 * Arguments: [walks = 1000000] [rounds = 5] [searches = 30000]
 */
#include "../../PhotonWalks/CountedSurface.h"
#include "../../PhotonWalks/HistoryPhotons.h"
#include "Measuring/EngineTiming.h"
#include "Measuring/Program.h"
#include "Measuring/Results.h"
#include "Photons/LeafPhotons.h"
#include "Photons/NearestEstimate.h"
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

constexpr std::size_t kNearest = 50;
constexpr double kPixels = 640 * 480; ///< searches of a frame

std::vector<Vector3> photonPoints(const IrradianceEngine& engine)
{
  std::vector<Vector3> points;
  for (const Photon& photon : test::photonsOf(test::onlySet(engine).history()))
  {
    const SceneObject& object = engine.objects()[photon.id.object];
    points.push_back(
      object.worldFromObject(modelPoint(object.body->mesh(), photon.id.triangle, photon.weights)));
  }
  return points;
}

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

/// Two frames that follow each other.
struct Frames
{
  explicit Frames(const EngineSettings& settings)
  {
    for (int frame = 0; frame < 2; ++frame)
    {
      timeUpdate(engines[frame], scene.inFrame(frame), settings);
    }
  }

  MovingScene scene = makePlainRoom();
  std::array<IrradianceEngine, 2> engines;
};

const std::string kOurs = "leaf photons";

/// The photons are from the first frame.
std::vector<Contestant> makeContestants(Frames& frames)
{
  const std::vector<Vector3> photons = photonPoints(frames.engines[0]);
  std::vector<Contestant> contestants;
  contestants.push_back({ "photon map", makePhotonMapLocator(photons, 1) });
  contestants.push_back({ "vtkStaticPointLocator", makeVtkLocator(photons) });
  contestants.push_back({ kOurs, makeLeafLocator(frames.engines[0], frames.engines[1]) });
  return contestants;
}

struct Cost
{
  double walks, building, search; ///< seconds; of one search

  double searches() const { return kPixels * search; }
  double perSecond() const { return kPixels / (building + searches()); }
};

void reportFrame(const std::string& row, const Cost& cost)
{
  const double frame = cost.walks + cost.building + cost.searches();
  report("NearestPhotons", row, "built or kept up to date, s", cost.building);
  report("NearestPhotons", row, "us a search", 1e6 * cost.search);
  report("NearestPhotons", row, "searches a second, building counted", cost.perSecond());
  report("NearestPhotons", row, "frame, s", frame);
  report("NearestPhotons", row, "share of a frame: searches, %", 100 * cost.searches() / frame);
  report("NearestPhotons", row, "share of a frame: building, %", 100 * cost.building / frame);
}

void check(const std::vector<Contestant>& contestants, const std::vector<Sensor>& sensors)
{
  constexpr std::size_t kChecked = 100;
  for (std::size_t i = 0; i < std::min(kChecked, sensors.size()); ++i)
  {
    for (const Contestant& contestant : contestants)
    {
      if (!findsNearest(*contestant.locator, sensors[i]))
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

/// From the first frame to the second.
double updateSeconds(const MovingScene& scene, const EngineSettings& settings)
{
  IrradianceEngine engine;
  timeUpdate(engine, scene.inFrame(0), settings);
  return timeUpdate(engine, scene.inFrame(1), settings).whole;
}

Cost costOf(PhotonLocator& locator, const std::vector<Sensor>& sensors, double walks)
{
  const double building = threadCpuSecondsOf([&] { locator.build(); });
  const double searches = threadCpuSecondsOf([&] {
    for (const Sensor& sensor : sensors)
    {
      locator.find(sensor, kNearest);
    }
  });
  return { walks, building, searches / static_cast<double>(sensors.size()) };
}

/// What sensors cost that lie 10 m off all surface: with the distance that vtkIrradianceProbeFilter
/// takes by itself, and with any. Before that counts, the surface found has to be the one that a
/// look at all triangles finds.
void timeFarSensors(IrradianceEngine& engine, const std::vector<Sensor>& near)
{
  CpuTime execution;
  engine.collectPhotons(execution);
  engine.prepareSurfaces(execution);
  const WalkHistory& history = test::onlySet(engine).history();
  const NearestPhotons photons = engine.nearestPhotons();
  std::vector<Sensor> far(near.begin(), near.begin() + std::min<std::ptrdiff_t>(near.size(), 300));
  for (Sensor& sensor : far)
  {
    sensor.position += 10 * sensor.normal;
  }
  const test::CountedSurface surface(engine.objects());
  for (std::size_t i = 0; i < std::min<std::size_t>(far.size(), 50); ++i)
  {
    const std::optional<Foot> found = photons.footOf(far[i]), nearest = surface.footOf(far[i]);
    if (found.has_value() != nearest.has_value() ||
      (found && std::abs(found->distance - nearest->distance) > 1e-9))
    {
      throw std::runtime_error("A sensor has another foot");
    }
  }
  for (const bool isAny : { false, true })
  {
    const double seconds = threadCpuSecondsOf([&] {
      for (const Sensor& sensor : far)
      {
        const auto foot = photons.footOf(sensor, isAny ? kInfinity : usualDistance(photons));
        if (foot)
        {
          nearestEstimate(photons, *foot, kNearest, usualRadius(photons, kNearest));
        }
      }
    });
    report("FarSensors", isAny ? "any distance" : "usual distance", "us a sensor",
      1e6 * seconds / static_cast<double>(far.size()), { 500, 50 });
  }
}

}

void run(const Arguments& arguments)
{
  EngineSettings settings;
  settings.numberOfWalks = arguments.number(0, 1000000u);
  const int rounds = arguments.number(1, 5);
  Frames frames(settings);
  const SceneObjects objects = frames.scene.inFrame(0);
  const std::vector<Sensor> sensors =
    makeSurfaceSensors(objects, arguments.number(2, std::size_t{ 30000 }));
  const std::vector<Contestant> contestants = makeContestants(frames);
  for (const Contestant& contestant : contestants)
  {
    contestant.locator->build();
  }
  check(contestants, sensors);
  timeFarSensors(frames.engines[0], sensors);
  for (int round = 0; round < rounds; ++round)
  {
    const double shooting = shootingSeconds(objects, settings);
    const double updating = updateSeconds(frames.scene, settings);
    std::vector<double> perSecond;
    for (const Contestant& contestant : contestants)
    {
      const Cost cost =
        costOf(*contestant.locator, sensors, contestant.name == kOurs ? updating : shooting);
      reportFrame(contestant.name, cost);
      perSecond.push_back(cost.perSecond());
    }
    for (std::size_t i = 0; i + 1 < contestants.size(); ++i)
    {
      report("NearestPhotonsRatios", kOurs + " / " + contestants[i].name,
        "searches a second, building counted", perSecond.back() / perSecond[i], { 1, 3 });
    }
  }
}
