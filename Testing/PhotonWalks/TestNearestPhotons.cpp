// SPDX-License-Identifier: BSD-3-Clause
#include "CountedSurface.h"
#include "Kit.h"
#include "Photons/NearestPhotons.h"
#include "ShotWalk.h"

// The nearest photons are those that a search of all photons finds.

namespace irradiance::test
{
namespace
{

/// A photon that a sensor may see.
struct PlacedPhoton
{
  SegmentRef reference;
  TriangleId id;
  int side;         ///< on which it arrived: 1 front, -1 back
  Vector3 position; ///< world
};

std::vector<PlacedPhoton> placed(const SceneObjects& objects, const WalkHistory& history)
{
  std::vector<PlacedPhoton> all;
  for (const Photon& photon : photonsOf(history))
  {
    const SceneObject& object = objects[photon.id.object];
    const TriangleMesh& mesh = object.body->mesh();
    all.push_back({ photon.reference, photon.id, photon.isFront ? 1 : -1,
      object.worldFromObject(modelPoint(mesh, photon.id.triangle, photon.weights)) });
  }
  return all;
}

/// The nearest, by a search of all.
struct Expected
{
  std::vector<SegmentRef> photons; ///< by distance
  double radius;
};

Expected searchAll(const std::vector<PlacedPhoton>& photons, const CountedSurface& surface,
  const Foot& foot, std::size_t count, double maximumRadius)
{
  struct Candidate
  {
    double squaredDistance;
    SegmentRef photon;
    bool operator<(const Candidate& other) const
    {
      return std::tie(squaredDistance, photon) < std::tie(other.squaredDistance, other.photon);
    }
  };
  std::vector<Candidate> nearest;
  double limit = maximumRadius * maximumRadius;
  for (const PlacedPhoton& photon : photons)
  {
    const double squared = foot.sensor.squaredDistance(photon.position);
    if (squared <= limit && surface.counts(foot, photon.id, photon.side))
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

/// All that sensors need of a scene whose photons are in leaves.
struct Prepared
{
  Prepared(const SceneObjects& objects, const WalkHistory& history, const LeafPhotons& leaves)
    : surfaces(objects)
    , photons(leaves, surfaces, objects, { &history })
    , all(placed(objects, history))
  {
  }

  struct UpdatedSurfaces : Surfaces
  {
    explicit UpdatedSurfaces(const SceneObjects& objects) { update(objects); }
  } surfaces;
  NearestPhotons photons;
  std::vector<PlacedPhoton> all;
};

LeafPhotons filled(const SceneObjects& objects, const WalkHistory& history)
{
  LeafPhotons leaves(objects);
  Execution execution;
  leaves.add(history, 0, history.size(), execution);
  return leaves;
}

void expectNearest(
  const Prepared& scene, const CountedSurface& surface, const Foot& foot, const Query& query)
{
  NearPhotons found = scene.photons.find(foot, query.count, query.maximumRadius);
  Expected expected = searchAll(scene.all, surface, foot, query.count, query.maximumRadius);
  ASSERT_EQ(found.photons.size(), expected.photons.size());
  ASSERT_EQ(found.radius, expected.radius);
  ASSERT_EQ(found.areAll, expected.photons.size() < query.count);
  ASSERT_TRUE(found.areAll || found.photons.back() == expected.photons.back());
  std::sort(found.photons.begin(), found.photons.end());
  std::sort(expected.photons.begin(), expected.photons.end());
  ASSERT_TRUE(found.photons == expected.photons);
}

void expectNearest(const Prepared& scene, RandomSensors sensors, std::uint32_t queries,
  const std::vector<Query>& kinds)
{
  const CountedSurface surface(scene.photons.objects());
  for (std::uint32_t i = 0; i < queries; ++i)
  {
    const std::optional<Foot> foot = scene.photons.footOf(sensors.next());
    if (foot)
    {
      ASSERT_NO_FATAL_FAILURE(expectNearest(scene, surface, *foot, kinds[i % kinds.size()]))
        << "query " << i;
    }
  }
}

/// In the first frame of a scene.
void expectNearest(const SceneObjects& objects, std::uint32_t walks, std::uint32_t queries,
  const std::vector<Query>& kinds)
{
  UpdatedEngine engine(objects, Shoot(walks).kept());
  const WalkHistory& history = onlySet(engine).history();
  const LeafPhotons leaves = filled(objects, history);
  const Prepared scene(objects, history, leaves);
  ASSERT_GT(scene.all.size(), walks / 8);
  expectNearest(scene, RandomSensors(objects, 7), scaled(queries), kinds);
}

TEST(NearestPhotons, EqualASearchOfAllWhileThingsMove)
{
  constexpr int kFrames = 20;
  MovingScene scene(1, false, 31);
  IrradianceEngine engine;
  Execution execution;
  LeafPhotons leaves;
  std::vector<Photon> before;
  for (int frame = 0; frame <= kFrames; ++frame)
  {
    engine.update(scene.objects(), Shoot(1500).kept(), execution);
    const WalkHistory& history = onlySet(engine).history();
    std::vector<Photon> after = photonsOf(history);
    if (frame == 0)
    {
      leaves = filled(scene.objects(), history);
    }
    else
    {
      leaves.apply(scene.objects(), { &history }, changesBetween(before, after), execution);
    }
    before = std::move(after);
    ASSERT_NO_FATAL_FAILURE(expectNearest({ scene.objects(), history, leaves },
      { scene.objects(), 100 + static_cast<unsigned>(frame) }, scaled(500),
      { { 1 }, { 5 }, { 50 }, { 20, 0.3 }, { 5000 } }))
      << "frame " << frame;
    scene.nextFrame();
  }
}

// Few large triangles: a leaf holds many photons.
TEST(NearestPhotons, EqualASearchOfAllInABareRoom)
{
  ObjectBuilder room = plainRoom({ 4, 4, 3 }, 1, grey(0.6));
  addPanel(room, { 1, 1, 2.9 }, 1, 1, 1);
  expectNearest({ room.build(), {} }, 700, 7000, { { 2 }, { 30 }, { 10, 0.2 } });
  expectNearest({ room.build(), {} }, 50000, 150, { { 50 }, { 500 } });
}

// Many small triangles around a lamp: a leaf holds few.
TEST(NearestPhotons, EqualASearchOfAllOnAFineMesh)
{
  ObjectBuilder lamp, dome, ball;
  lamp.addSphere({ 0, 0, 0 }, 0.2, 3, grey(0, 1));
  dome.addSphere({ 2, 2, 2 }, 2.5, 32, grey(0.7), true);
  ball.addSphere({ 0, 0, 0 }, 0.7, 24, grey(0.7));
  const SceneObjects objects{ dome.build(),
    { lamp.build(shift({ 1, 2, 2 })), ball.build(shift({ 2.8, 2, 2 }), true) } };
  expectNearest(objects, 400, 6000, { { 3 }, { 50 }, { 25, 0.5 } });
}

// Poses that stretch a hundredfold, objects far apart and far from the origin.
TEST(NearestPhotons, EqualASearchOfAllWherePosesAreExtreme)
{
  ObjectBuilder room, thing;
  room.addBox(box({ -9, -9, -9 }, { 13, 13, 13 }), 3, grey(0.5, 1), true);
  thing.addBox(box({ -1, -1, -1 }, { 1, 1, 1 }), 4, grey(0.5));
  RandomVectors random(12);
  SceneObjects objects{ room.build(), {} };
  for (int i = 0; i < 12; ++i)
  {
    Matrix3 linear = random.rotation() * Vector3(0.01, 0.3, 1).asDiagonal() * random.rotation();
    linear.col(0) *= random.powerOfTwo(-3, 2);
    objects.dynamicObjects.push_back(
      thing.build({ linear, Vector3(2, 2, 2) + 4 * random.inCube() }, i % 3 == 0));
  }
  const std::vector<Query> kinds{ { 4 }, { 50 }, { 10, 0.5 } };
  ASSERT_NO_FATAL_FAILURE(expectNearest(objects, 1500, 3000, kinds));
  // The thirteenth lies a million times as far away as it is large.
  objects.dynamicObjects.push_back(thing.build(shift({ 2e6, 0, 1 })));
  ASSERT_NO_FATAL_FAILURE(expectNearest(objects, 1500, 4000, kinds));
  // All are so far from the origin that doubles tell 10,000 places across the room, then 100. (They
  // were shot nearby; no ray finds anything there.)
  objects.staticObject = nothing();
  objects.dynamicObjects.back() = room.build();
  UpdatedEngine engine(objects, Shoot(1500).kept());
  const WalkHistory& history = onlySet(engine).history();
  const LeafPhotons leaves = filled(objects, history);
  for (const double far : { 1e12, 1e14 })
  {
    SceneObjects moved = objects;
    for (SceneObject& object : moved.dynamicObjects)
    {
      object.worldFromObject.translation += far * Vector3(1, -1, 1);
    }
    ASSERT_NO_FATAL_FAILURE(expectNearest(
      { moved, history, leaves }, { moved, 9 }, scaled(3000), { { 4 }, { 50 }, { 10, 3 } }))
      << far;
  }
}

// Photons in one place, and photons equally far: their numbers decide.
TEST(NearestPhotons, TiesAreBrokenByWalkAndBounce)
{
  ObjectBuilder floor;
  floor.addQuad({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 1, 1, grey(0.5));
  const SceneObjects objects{ floor.build(), {} };
  constexpr std::uint32_t kWalks = 400;
  const WalkPlan plan(kWalks, kWalks, 1);
  WalkHistory history(plan, PointGrid(), TriangleNumbers({ 2 }), 1, Power{ { 1 << 20 } },
    std::make_shared<BlockArena>(BounceBlock::pageBytes(1)));
  history.append();
  std::mt19937 random(3);
  for (std::uint32_t walk = 0; walk < kWalks; ++walk)
  {
    std::vector<WalkSegment> segments(2);
    for (WalkSegment& segment : segments)
    {
      // In the middle between some places, or in one of those.
      const auto place = [&] { return 0.25F * static_cast<float>(1 + random() % 2); };
      segment.ray = { Vector3::Zero(), Vector3::UnitZ(), {} };
      segment.hit = { 1, { 0, static_cast<std::uint32_t>(random() % 2) }, { place(), place() } };
    }
    storeWalk(history, walk, segments);
  }
  const LeafPhotons leaves = filled(objects, history);
  const Prepared scene(objects, history, leaves);
  const CountedSurface surface(objects);
  for (const double x : { 0.5, 1.0, 1.5, 2.0, 2.5, 3.0 })
  {
    for (const double y : { 0.5, 1.0, 1.5, 2.0, 2.5, 3.0 })
    {
      for (const std::size_t count : { 1, 7, 50, 333, 799, 800, 801 })
      {
        const Foot foot = scene.photons.footOf({ { x, y, 0.25 }, Vector3::UnitZ() }).value();
        ASSERT_NO_FATAL_FAILURE(expectNearest(scene, surface, foot, { count }))
          << x << ' ' << y << ' ' << count;
      }
    }
  }
}

TEST(NearestPhotons, OfNothing)
{
  const SceneObjects objects{ nothing(), { nothing() } };
  const WalkHistory history;
  const LeafPhotons leaves = filled(objects, history);
  const Prepared scene(objects, history, leaves);
  const Sensor sensor{ Vector3::Zero(), Vector3::UnitZ() };
  EXPECT_FALSE(scene.photons.footOf(sensor));
  const NearPhotons found = scene.photons.find({ sensor, Vector3::UnitZ(), false, 0, 0 }, 5, 2);
  EXPECT_TRUE(found.photons.empty());
  EXPECT_TRUE(found.areAll);
  EXPECT_EQ(found.radius, 2);
}

// Found by fuzzing: a triangle so thin that its area is lost where its object's coordinates are
// rounded leaves no surface.
TEST(NearestPhotons, OfSurfaceWhoseAreaIsLost)
{
  const Triangle needle{ { -5.6e-33, 1.8e-34, 1.8e-34 }, { 20, -0.22, -16 }, { 0, 0, 5.6e-33 } };
  ObjectBuilder builder;
  builder.addCell({ needle }, grey(0.5));
  const SceneObjects objects{ builder.build(), {} };
  const WalkHistory history;
  const LeafPhotons leaves = filled(objects, history);
  const Prepared scene(objects, history, leaves);
  ASSERT_FALSE(objects.staticObject.isEmpty());
  ASSERT_TRUE(scene.surfaces.of(0).isEmpty());
  EXPECT_FALSE(scene.photons.footOf({ Vector3::Zero(), Vector3::UnitZ() }));
}

}
}
