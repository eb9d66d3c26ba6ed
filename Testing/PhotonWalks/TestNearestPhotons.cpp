// SPDX-License-Identifier: BSD-3-Clause
#include "EngineRun.h"
#include "HistoryPhotons.h"
#include "MovingScene.h"
#include "Photons/NearestPhotons.h"

#include <gtest/gtest.h>

// The nearest photons are those that a search of all photons finds.

namespace irradiance
{

namespace
{

using test::MovingScene;
using test::RandomVectors;

/// A photon that a sensor may see.
struct PlacedPhoton
{
  PhotonReference reference;
  Vector3 position, normal; ///< world; the normal of the side on which it arrived
};

std::vector<PlacedPhoton> placed(const SceneObjects& objects, const WalkHistory& history)
{
  std::vector<PlacedPhoton> all;
  for (const Photon& photon : test::photonsOf(history))
  {
    const SceneObject& object = objects[photon.id.object];
    const TriangleMesh& mesh = object.body->mesh();
    const Vector3 front =
      transformed(object.worldFromObject, mesh[photon.id.triangle]).areaVector().normalized();
    all.push_back({ photon.reference,
      object.worldFromObject(modelPoint(mesh, photon.id.triangle, photon.weights)),
      photon.isFront ? front : Vector3(-front) });
  }
  return all;
}

/// The nearest, by a search of all.
struct Expected
{
  std::vector<PhotonReference> photons; ///< by distance
  double radius;
};

Expected searchAll(const std::vector<PlacedPhoton>& photons, const Sensor& sensor,
  std::size_t count, double maximumRadius)
{
  struct Candidate
  {
    double squaredDistance;
    PhotonReference photon;
    bool operator<(const Candidate& other) const
    {
      return std::tie(squaredDistance, photon) < std::tie(other.squaredDistance, other.photon);
    }
  };
  std::vector<Candidate> nearest;
  double limit = maximumRadius * maximumRadius;
  for (const PlacedPhoton& photon : photons)
  {
    const double squared = (photon.position - sensor.position).squaredNorm();
    if (squared <= limit && photon.normal.dot(sensor.normal) >= Facing::kLeastCosine)
    {
      nearest.push_back({ squared, photon.reference });
      std::push_heap(nearest.begin(), nearest.end());
      if (nearest.size() > count)
      {
        std::pop_heap(nearest.begin(), nearest.end());
        nearest.pop_back();
        limit = nearest.front().squaredDistance;
      }
    }
  }
  std::sort_heap(nearest.begin(), nearest.end());
  Expected expected{ {}, maximumRadius };
  for (const Candidate& candidate : nearest)
  {
    expected.photons.push_back(candidate.photon);
  }
  if (nearest.size() == count)
  {
    expected.radius = std::sqrt(nearest.back().squaredDistance);
  }
  return expected;
}

/// Some on surfaces, facing as they do or aslant; some anywhere.
class RandomSensors
{
public:
  RandomSensors(const SceneObjects& objects, unsigned seed)
    : objects_(objects)
    , random_(seed)
  {
  }

  Sensor next()
  {
    const auto object = static_cast<std::uint32_t>(random_.engine() % objects_.size());
    const TriangleMesh& mesh = objects_[object].body->mesh();
    if (mesh.isEmpty() || random_.engine() % 8 == 0)
    {
      return { 3 * random_.inCube() + Vector3(2, 2, 2), random_.direction() };
    }
    const Triangle triangle =
      transformed(objects_[object].worldFromObject, mesh[random_.engine() % mesh.size()]);
    const double b = random_.uniform(0, 1), c = random_.uniform(0, 1 - b);
    const Vector3 front = triangle.areaVector().normalized();
    const Vector3 side = random_.engine() % 2 == 0 ? front : Vector3(-front);
    const Vector3 aslant = (side + random_.uniform(0, 0.5) * random_.direction()).normalized();
    return { triangle.a + b * (triangle.b - triangle.a) + c * (triangle.c - triangle.a), aslant };
  }

private:
  const SceneObjects& objects_;
  RandomVectors random_;
};

struct Query
{
  std::size_t count;
  double maximumRadius = kInfinity;
};

void expectNearest(const NearestPhotons& photons, const std::vector<PlacedPhoton>& all,
  RandomSensors& sensors, std::uint32_t queries, const std::vector<Query>& kinds)
{
  for (std::uint32_t i = 0; i < queries; ++i)
  {
    const Sensor sensor = sensors.next();
    const Query& kind = kinds[i % kinds.size()];
    NearPhotons found = photons.find(sensor, kind.count, kind.maximumRadius);
    Expected expected = searchAll(all, sensor, kind.count, kind.maximumRadius);
    ASSERT_EQ(found.photons.size(), expected.photons.size()) << "query " << i;
    ASSERT_EQ(found.radius, expected.radius) << "query " << i;
    ASSERT_EQ(found.areAll, expected.photons.size() < kind.count);
    ASSERT_TRUE(found.areAll || found.photons.back() == expected.photons.back()) << "query " << i;
    std::sort(found.photons.begin(), found.photons.end());
    std::sort(expected.photons.begin(), expected.photons.end());
    ASSERT_TRUE(found.photons == expected.photons) << "query " << i;
  }
}

}

TEST(NearestPhotons, EqualASearchOfAllWhileThingsMove)
{
  constexpr int kFrames = 20;
  const std::uint32_t queries = test::scaled(1500);
  MovingScene scene(1, false, 31);
  IrradianceEngine engine;
  EngineSettings settings;
  settings.numberOfWalks = 1500;
  settings.keepPhotons = true;
  Execution execution;
  for (int frame = 0; frame <= kFrames; ++frame)
  {
    engine.update(scene.objects(), settings, execution);
    const WalkHistory history = engine.photons();
    LeafPhotons leaves(scene.objects());
    leaves.add(history, 0, history.blocks().size(), execution);
    const NearestPhotons photons(leaves, scene.objects(), history);
    RandomSensors sensors(scene.objects(), 100 + static_cast<unsigned>(frame));
    ASSERT_NO_FATAL_FAILURE(expectNearest(photons, placed(scene.objects(), history), sensors,
      queries, { { 1 }, { 5 }, { 50 }, { 20, 0.3 }, { 5000 } }))
      << "frame " << frame;
    scene.nextFrame();
  }
}

}
