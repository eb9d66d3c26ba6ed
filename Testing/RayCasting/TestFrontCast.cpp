// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "SceneTest.h"
#include "TestFronts.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>

// Law: the casts of a front find what brute force finds, bit for bit.

namespace irradiance
{
namespace
{

using test::exactly;
using test::kFewer;
using test::kRayKinds;
using test::NamedScene;
using test::RaySource;
using test::SceneMaker;

bool haveSameBits(const Hit& a, const Hit& b)
{
  return std::memcmp(&a.distance, &b.distance, sizeof a.distance) == 0 && a.id == b.id &&
    std::memcmp(a.weights.data(), b.weights.data(), sizeof a.weights) == 0;
}

using test::CastFunction;

/// Without trees, the closest hits; if hits are given, those that stay the closest.
std::vector<Hit> bruteForce(const NamedScene& named, const std::vector<Ray>& rays,
  const std::vector<bool>& chosen, const std::vector<Hit>& given = {})
{
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    hits.push_back(test::bruteForce(named, rays[i], chosen, given.empty() ? Hit{} : given[i]));
  }
  return hits;
}

std::vector<bool> allOf(const NamedScene& named)
{
  return std::vector<bool>(named.objects.size() + 1, true);
}

/// The number of rays that so many ray/triangle tests allow.
int raysFor(const SurfaceRecords& records, int tests)
{
  constexpr int kLeast = 120, kMost = 8000;
  return std::max(kLeast, std::min(kMost, tests / static_cast<int>(records.size())) / kFewer);
}

/// Casts the rays as fronts with these hits given; expects these others.
void expectHits(const NamedScene& named, const Scene& scene, CastFunction function,
  const std::vector<Ray>& rays, const std::vector<Hit>& given, const std::vector<Hit>& expected,
  const std::string& what)
{
  const SurfaceRecords records = named.records();
  test::TestFront front(records);
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    FrontCast cast;
    int wrong = 0;
    // Fronts of any size, cast by one object in turn.
    std::size_t first = 0;
    for (std::size_t size = 1; first < rays.size(); size = 7 * size % 4099)
    {
      const auto begin = static_cast<std::ptrdiff_t>(first);
      const auto end = static_cast<std::ptrdiff_t>(std::min(first + size, rays.size()));
      front.set({ rays.begin() + begin, rays.begin() + end },
        { given.begin() + begin, given.begin() + end });
      (cast.*function)(scene, records, front.columns());
      for (; first < static_cast<std::size_t>(end); ++first)
      {
        const Hit found = front.hit(first - static_cast<std::size_t>(begin));
        if (!haveSameBits(found, expected[first]) && ++wrong <= 3)
        {
          ADD_FAILURE() << named.name << ", " << what << ", SIMD level " << static_cast<int>(level)
                        << ", ray " << first << ": " << exactly(rays[first]) << "\n  given "
                        << exactly(given[first]) << "\n  expected " << exactly(expected[first])
                        << "\n  found " << exactly(found);
        }
      }
    }
    EXPECT_EQ(wrong, 0) << named.name << ", " << what << ", of " << rays.size();
  }
}

void expectHits(const NamedScene& named, const std::vector<Ray>& rays,
  const std::vector<Hit>& given, const std::vector<Hit>& expected, const std::string& what)
{
  expectHits(
    named, named.scene(TraversalMode::Parallel), &FrontCast::cast, rays, given, expected, what);
}

/// Some of the scene's objects, all instanced.
NamedScene withSome(const NamedScene& scene, std::size_t count)
{
  NamedScene some{ scene.name + ", " + std::to_string(count), scene.still, {} };
  for (std::size_t i = 0; i < count; ++i)
  {
    // Different ones each time.
    some.objects.push_back(scene.objects[(3 * count + 2 * i) % scene.objects.size()]);
    some.objects.back().isFlattened = false;
  }
  return some;
}

/// Copies of the scene's objects, here and there; a box in place of those that have more triangles
/// than these.
NamedScene withMany(const NamedScene& scene, std::size_t count, std::size_t mostTriangles)
{
  const auto simple =
    test::bodyOf(test::boxOfCells({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }, { 1, 1, 1 }));
  NamedScene many{ scene.name + ", " + std::to_string(count), scene.still, {} };
  test::RandomVectors random(26);
  for (std::size_t i = 0; i < count; ++i)
  {
    many.objects.push_back(scene.objects[i % scene.objects.size()]);
    PlacedBody& object = many.objects.back();
    object.body = object.body->mesh().size() > mostTriangles ? simple : object.body;
    object.isFlattened = i == 7 && scene.objects.size() > 6;
    object.worldFromObject.translation += (i % 3 == 0 ? 0.0 : 0.3) * random.inCube();
  }
  return many;
}

/// The scenes of all tests; each with none to three of its objects; and with so many that all their
/// balls are tested, or, of small ones, that there is a tree over them.
std::vector<SceneMaker> frontScenes()
{
  std::vector<SceneMaker> scenes = test::sceneMakers();
  for (const SceneMaker& scene : test::sceneMakers())
  {
    const auto add = [&](std::size_t count, const std::function<NamedScene()>& make) {
      scenes.push_back({ scene.name + ", " + std::to_string(count), make });
    };
    for (std::size_t count = 0; count < 4; ++count)
    {
      add(count, [make = scene.make, count] { return withSome(make(), count); });
    }
    add(40, [make = scene.make] { return withMany(make(), 40, 1000); });
    add(520, [make = scene.make] { return withMany(make(), 520, 40); });
  }
  return scenes;
}

class FrontLaw : public test::SceneTest
{
};

TEST_P(FrontLaw, FindsWhatBruteForceFinds)
{
  constexpr unsigned kSeed = 21;
  const SurfaceRecords records = named_.records();
  if (records.size() == 0)
  {
    return;
  }
  const int count = raysFor(records, 500000);
  RaySource source = test::raysAt(named_, kSeed);
  int hits = 0;
  for (const test::RayKind kind : kRayKinds)
  {
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i)
    {
      rays.push_back(test::asInFront(source.next(kind)));
    }
    const std::vector<Hit> expected = bruteForce(named_, rays, allOf(named_));
    for (const Hit& hit : expected)
    {
      hits += hit ? 1 : 0;
    }
    expectHits(named_, rays, std::vector<Hit>(rays.size()), expected, nameOf(kind));
  }
  EXPECT_GT(hits, count);
}

/// Rays of all kinds.
std::vector<Ray> mixedRays(const NamedScene& named, const SurfaceRecords& records, unsigned seed)
{
  const auto count = static_cast<std::size_t>(raysFor(records, 1000000));
  RaySource source = test::raysAt(named, seed);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i)
  {
    rays.push_back(test::asInFront(source.next(kRayKinds[i % kRayKinds.size()])));
  }
  return rays;
}

/// Hits that are closer and farther than the closest ones, and some at the very same distance.
std::vector<Hit> givenHits(
  const Scene& scene, const SurfaceRecords& records, const std::vector<Ray>& rays)
{
  std::vector<Hit> given(rays.size());
  scene.cast(rays.data(), rays.size(), given.data());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    Hit& hit = given[i];
    const double distance = hit ? hit.distance : 1.0;
    const double distances[] = { hit.distance, distance, std::nextafter(distance, kInfinity),
      1.5 * distance, 0.5 * distance, 0.0 };
    hit.distance = distances[i / 6 % 6];
    hit.id = i / 36 % 2 == 0
      ? records.numbers().idOf(static_cast<std::uint32_t>(i) % records.size())
      : hit.id;
    hit.weights = { 0.25F, 0.5F };
  }
  return given;
}

// Hits that are known are kept unless something is closer, also at the very same distance.
TEST_P(FrontLaw, KeepsCloserHits)
{
  const SurfaceRecords records = named_.records();
  if (records.size() == 0)
  {
    return;
  }
  const std::vector<Ray> rays = mixedRays(named_, records, 22);
  for (const TraversalMode mode :
    { TraversalMode::Parallel, TraversalMode::Sequential, TraversalMode::OneTree })
  {
    const Scene scene = named_.scene(mode);
    const std::vector<Hit> given = givenHits(scene, records, rays);
    std::vector<bool> dynamic = allOf(named_);
    dynamic[0] = false;
    expectHits(named_, scene, &FrontCast::castDynamic, rays, given,
      bruteForce(named_, rays, dynamic, given), "dynamic");
    expectHits(named_, scene, &FrontCast::cast, rays, given,
      bruteForce(named_, rays, allOf(named_), given),
      mode == TraversalMode::OneTree ? "one tree" : "with hits given");
  }
}

TEST_P(FrontLaw, CastsToMovedObjects)
{
  const SurfaceRecords records = named_.records();
  if (records.size() == 0)
  {
    return;
  }
  const std::vector<Ray> rays = mixedRays(named_, records, 27);
  std::vector<bool> moved(named_.objects.size()), chosen(moved.size() + 1);
  for (const std::size_t step : { 1, 2, 3 })
  {
    for (std::size_t i = 0; i < moved.size(); ++i)
    {
      moved[i] = chosen[i + 1] = i % step == 0;
    }
    const Scene scene = named_.scene(TraversalMode::Parallel, moved);
    const std::vector<Hit> given = givenHits(scene, records, rays);
    expectHits(named_, scene, &FrontCast::castMoved, rays, given,
      bruteForce(named_, rays, chosen, given), "moved");
  }
}

// Known hits have the distances and the weights with which they were found; others are missed.
TEST_P(FrontLaw, FindsTheDistancesOfKnownHits)
{
  const SurfaceRecords records = named_.records();
  if (records.size() == 0)
  {
    return;
  }
  const std::vector<Ray> rays = mixedRays(named_, records, 28);
  const Scene scene = named_.scene(TraversalMode::Parallel);
  std::vector<Hit> expected(rays.size());
  scene.cast(rays.data(), rays.size(), expected.data());
  std::vector<Hit> given = expected;
  int missed = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    given[i].distance = i % 3 == 0 ? 0.0 : 7.0;
    given[i].weights = { 0.25F, 0.5F };
    if (i % 5 == 0) // a triangle that the ray seldom hits
    {
      given[i].id = records.numbers().idOf(static_cast<std::uint32_t>(i) % records.size());
      expected[i] = scene.hitOf(rays[i], given[i].id);
      expected[i].id = given[i].id;
    }
    if (expected[i].distance == kInfinity)
    {
      expected[i].weights = given[i].weights;
      ++missed;
    }
  }
  EXPECT_GT(missed, 20);
  expectHits(named_, scene, &FrontCast::findDistances, rays, given, expected, "distances");
}

INSTANTIATE_TEST_SUITE_P(Scenes, FrontLaw, testing::ValuesIn(frontScenes()), test::NameOfMesh());

// Hundreds of triangles at one place: more candidates than a search holds, and than the list takes.
TEST(FrontCast, ManyTrianglesAtOneDistance)
{
  const Triangle triangle{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  test::Triangles many(300, triangle);
  many.push_back({ { 0, 0, -1 }, { 1, 0, -1 }, { 0, 1, -1 } });
  const auto body = test::bodyOf(many);
  const NamedScene scene{ "many at one place", body,
    { { body, { test::stretch(1, 1, 1), { 0, 0, -0.25 } } } } };
  const SurfaceRecords records = scene.records();
  test::RandomVectors random(23);
  std::vector<Ray> rays;
  for (int i = 0; i < 500; ++i)
  {
    const Ray ray{ Vector3(0.3, 0.3, 2) + 0.2 * random.inCube(), { 0, 0, -1 },
      records.numbers().idOf(static_cast<std::uint32_t>(i) % records.size()) };
    rays.push_back(
      test::asInFront({ ray.origin, ray.direction + 0.1 * random.inCube(), ray.start }));
  }
  expectHits(scene, rays, std::vector<Hit>(rays.size()), bruteForce(scene, rays, allOf(scene)), "");
}

// A ray may begin so far away that the scene looks like a point.
TEST(FrontCast, CastsFromVeryFar)
{
  test::RandomVectors random(24);
  const NamedScene scene{ "from far", test::bodyOf(test::icosphere(2)),
    { { test::bodyOf(test::icosphere(1)), { 0.5 * random.rotation(), { 1, 0, 0 } } } } };
  std::vector<Ray> rays;
  for (const double distance : { 10., 100., 1e3, 4e3, 5e3, 1e6, 1e9, 1e20, 1e35, 1e40, 1e100 })
  {
    for (int i = 0; i < 200; ++i)
    {
      const Vector3 away = test::asInFront({ {}, random.direction(), {} }).direction;
      rays.push_back({ random.inCube() + distance * away, -away, {} });
    }
  }
  expectHits(scene, rays, std::vector<Hit>(rays.size()), bruteForce(scene, rays, allOf(scene)), "");
}

// An object that is not there keeps its numbers.
TEST(FrontCast, WhatIsNotThereIsNotHit)
{
  NamedScene scene = test::hardMaps();
  scene.objects.resize(3);
  scene.objects[1].isPresent = false;
  const SurfaceRecords records = scene.records();
  RaySource source = test::raysAt(test::hardMaps(), 25);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i)
  {
    Ray ray = test::asInFront(source.next(test::RayKind::Edge));
    ray.start = {};
    rays.push_back(ray);
  }
  expectHits(scene, rays, std::vector<Hit>(rays.size()),
    bruteForce(scene, rays, { true, true, false, true }), "");
}

}
}
