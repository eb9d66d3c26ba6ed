// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "TestFronts.h"
#include "TestRays.h"
#include "TestScenes.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <cstring>

// Law: the cast of a front finds what Scene::cast finds, bit for bit.

namespace irradiance
{
namespace
{

using test::exactly;
using test::kFewer;
using test::kRayKinds;
using test::NamedScene;
using test::RaySource;

bool haveSameBits(const Hit& a, const Hit& b)
{
  return std::memcmp(&a.distance, &b.distance, sizeof a.distance) == 0 && a.id == b.id &&
    std::memcmp(a.weights.data(), b.weights.data(), sizeof a.weights) == 0;
}

SurfaceRecords recordsOf(const NamedScene& scene)
{
  SurfaceRecords records;
  records.update(scene.still, scene.objects);
  return records;
}

/// Rays aimed at the triangles of all objects.
RaySource raysAt(const NamedScene& named, const SurfaceRecords& records, unsigned seed)
{
  std::vector<Triangle> triangles;
  std::vector<TriangleId> ids;
  const Scene scene = named.scene(TraversalMode::Parallel);
  for (std::uint32_t i = 0; i < records.size(); ++i)
  {
    ids.push_back(records.idOf(i));
    triangles.push_back(scene.worldTriangle(ids.back()));
  }
  return RaySource(triangles, seed, ids);
}

/// Casts the rays as fronts with these hits given; expects these others.
void expectHits(const NamedScene& named, const std::vector<Ray>& rays,
  const std::vector<Hit>& given, const std::vector<Hit>& expected, const std::string& what)
{
  const SurfaceRecords records = recordsOf(named);
  test::TestFront front(records);
  const Scene scene = named.scene(TraversalMode::Parallel);
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
      cast.cast(scene, records, front.columns());
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

/// The scenes of all tests; and each with one, two and three of its objects, all instanced.
std::vector<NamedScene> frontScenes()
{
  std::vector<NamedScene> scenes = test::testScenes();
  for (const NamedScene& scene : test::testScenes())
  {
    for (std::size_t count = 0; count < 4; ++count)
    {
      // Different ones each time.
      NamedScene some{ scene.name + ", " + std::to_string(count), scene.still, {} };
      for (std::size_t i = 0; i < count; ++i)
      {
        some.objects.push_back(scene.objects[(3 * count + 2 * i) % scene.objects.size()]);
        some.objects.back().isFlattened = false;
      }
      scenes.push_back(some);
    }
  }
  return scenes;
}

class FrontLaw : public testing::TestWithParam<NamedScene>
{
};

TEST_P(FrontLaw, FindsWhatSceneFinds)
{
  constexpr unsigned kSeed = 21;
  constexpr int kRays = 8000 / kFewer;
  const SurfaceRecords records = recordsOf(GetParam());
  if (records.size() == 0)
  {
    return;
  }
  RaySource source = raysAt(GetParam(), records, kSeed);
  const Scene scene = GetParam().scene(TraversalMode::Parallel);
  int hits = 0;
  for (const test::RayKind kind : kRayKinds)
  {
    std::vector<Ray> rays;
    for (int i = 0; i < kRays; ++i)
    {
      rays.push_back(test::asInFront(source.next(kind)));
    }
    std::vector<Hit> expected(rays.size());
    scene.cast(rays.data(), rays.size(), expected.data());
    for (const Hit& hit : expected)
    {
      hits += hit ? 1 : 0;
    }
    expectHits(GetParam(), rays, std::vector<Hit>(rays.size()), expected, nameOf(kind));
  }
  EXPECT_GT(hits, kRays);
}

// Hits that are known are kept unless something is closer, also at the very same distance.
TEST_P(FrontLaw, KeepsCloserHits)
{
  constexpr unsigned kSeed = 22;
  constexpr int kRays = 8000 / kFewer;
  const SurfaceRecords records = recordsOf(GetParam());
  if (records.size() == 0)
  {
    return;
  }
  RaySource source = raysAt(GetParam(), records, kSeed);
  const Scene scene = GetParam().scene(TraversalMode::Parallel);
  std::vector<Ray> rays;
  std::vector<Hit> given(kRays), expected;
  for (int i = 0; i < kRays; ++i)
  {
    rays.push_back(
      test::asInFront(source.next(kRayKinds[static_cast<std::size_t>(i) % kRayKinds.size()])));
  }
  scene.cast(rays.data(), rays.size(), given.data());
  for (int i = 0; i < kRays; ++i)
  {
    Hit& hit = given[static_cast<std::size_t>(i)];
    const double distance = hit ? hit.distance : 1.0;
    const double distances[] = { hit.distance, distance, std::nextafter(distance, kInfinity),
      1.5 * distance, 0.5 * distance, 0.0 };
    hit.distance = distances[i / 6 % 6];
    hit.id =
      i / 36 % 2 == 0 ? records.idOf(static_cast<std::uint32_t>(i) % records.size()) : hit.id;
    hit.weights = { 0.25F, 0.5F };
  }
  expected = given;
  scene.castDynamic(rays.data(), rays.size(), expected.data());
  scene.castStatic(rays.data(), rays.size(), expected.data());
  expectHits(GetParam(), rays, given, expected, "with hits given");
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
  const SurfaceRecords records = recordsOf(scene);
  test::RandomVectors random(23);
  std::vector<Ray> rays;
  std::vector<Hit> expected;
  for (int i = 0; i < 500; ++i)
  {
    const Ray ray{ Vector3(0.3, 0.3, 2) + 0.2 * random.inCube(), { 0, 0, -1 },
      records.idOf(static_cast<std::uint32_t>(i) % records.size()) };
    rays.push_back(
      test::asInFront({ ray.origin, ray.direction + 0.1 * random.inCube(), ray.start }));
    expected.push_back(scene.scene(TraversalMode::Sequential).cast(rays.back()));
  }
  expectHits(scene, rays, std::vector<Hit>(rays.size()), expected, "");
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
  std::vector<Hit> expected(rays.size());
  scene.scene(TraversalMode::Parallel).cast(rays.data(), rays.size(), expected.data());
  expectHits(scene, rays, std::vector<Hit>(rays.size()), expected, "");
}

// An object that is not there keeps its numbers.
TEST(FrontCast, WhatIsNotThereIsNotHit)
{
  NamedScene scene = test::hardMaps();
  scene.objects.resize(3);
  scene.objects[1].isPresent = false;
  const SurfaceRecords records = recordsOf(scene);
  RaySource source = raysAt(test::hardMaps(), recordsOf(test::hardMaps()), 25);
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i)
  {
    Ray ray = test::asInFront(source.next(test::RayKind::Edge));
    ray.start = {};
    rays.push_back(ray);
  }
  std::vector<Hit> expected(rays.size());
  scene.scene(TraversalMode::Parallel).cast(rays.data(), rays.size(), expected.data());
  expectHits(scene, rays, std::vector<Hit>(rays.size()), expected, "");
}

}
}
