// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "SceneTest.h"
#include "TestFronts.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <initializer_list>

// Law: all traversal modes and brute force give the same bits.

namespace irradiance
{
namespace
{

using test::exactly;
using test::isSameHit;
using test::kFewer;
using test::kRayKinds;
using test::NamedScene;
using test::RayKind;
using test::RaySource;

constexpr TraversalMode kModes[] = { TraversalMode::OneTree, TraversalMode::Sequential,
  TraversalMode::Parallel };

class SceneLaw : public test::SceneTest
{
protected:
  std::size_t numberOfObjects() const { return named_.objects.size(); }

  Hit bruteForceAll(const Ray& ray) const
  {
    return bruteForce(named_, ray, std::vector<bool>(numberOfObjects() + 1, true));
  }
};

TEST_P(SceneLaw, AllModesFindWhatBruteForceFinds)
{
  constexpr unsigned kSeed = 1;
  constexpr int kRays = 8000 / kFewer;
  // The last ones swap flattened and instanced objects.
  NamedScene other = named_;
  for (PlacedBody& object : other.objects)
  {
    object.isFlattened = !object.isFlattened;
  }
  std::vector<std::pair<std::string, Scene>> scenes;
  for (const TraversalMode mode : kModes)
  {
    const std::string name = std::to_string(static_cast<int>(mode));
    scenes.emplace_back("mode " + name, named_.scene(mode));
    scenes.emplace_back("flattened for instanced, mode " + name, other.scene(mode));
  }
  RaySource source = test::raysAt(named_, kSeed);
  int hits = 0, wrong = 0;
  for (const RayKind kind : kRayKinds)
  {
    std::vector<Ray> batch;
    std::vector<Hit> expected;
    for (int i = 0; i < kRays; ++i)
    {
      batch.push_back(source.next(kind));
      expected.push_back(bruteForceAll(batch.back()));
      hits += expected.back() ? 1 : 0;
    }
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      for (const auto& [name, scene] : scenes)
      {
        std::vector<Hit> found(batch.size());
        scene.cast(batch.data(), batch.size(), found.data());
        for (std::size_t i = 0; i < batch.size(); ++i)
        {
          if (!isSameHit(found[i], expected[i]) && ++wrong <= 5)
          {
            ADD_FAILURE() << name << ", SIMD level " << static_cast<int>(level) << ", seed "
                          << kSeed << ", " << nameOf(kind) << " ray " << i << ": "
                          << exactly(batch[i]) << "\n  brute force " << exactly(expected[i])
                          << "\n  found " << exactly(found[i]);
          }
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << kRays * kRayKinds.size() * scenes.size();
  EXPECT_GT(hits, 2 * kRays);
}

// castDynamic and castMoved see only the objects that they should, and keep a closer hit.
TEST_P(SceneLaw, SeesTheChosenObjectsOnly)
{
  constexpr unsigned kSeed = 2;
  constexpr int kRays = 3000 / kFewer;
  std::vector<bool> dynamic(numberOfObjects() + 1, true), chosen(numberOfObjects() + 1, false);
  dynamic[0] = false;
  std::vector<bool> moved(numberOfObjects(), false);
  for (std::size_t i = 1; i < moved.size(); i += 3)
  {
    chosen[i + 1] = moved[i] = true;
  }
  RaySource source = test::raysAt(named_, kSeed);
  const Scene scene = named_.scene(TraversalMode::Sequential, moved, source.originBounds());
  const SurfaceRecords records = named_.records();
  const TriangleId first = records.numbers().idOf(0);
  int hits = 0;
  for (const RayKind kind : kRayKinds)
  {
    std::vector<Ray> batch;
    std::vector<Hit> given, inDynamic, inMoved;
    for (int i = 0; i < kRays; ++i)
    {
      const Ray ray = source.next(kind);
      const Hit all = bruteForceAll(ray);
      const Hit nearest = bruteForce(named_, ray, chosen);
      // The last one is just behind the hit, so that a bound that is too tight is noticed.
      for (const Hit& best : { Hit{}, all, Hit{ all ? 1.5 * all.distance : 1.0, first },
             Hit{ std::nextafter(nearest.distance, kInfinity), first } })
      {
        batch.push_back(ray);
        given.push_back(best);
        inDynamic.push_back(bruteForce(named_, ray, dynamic, best));
        inMoved.push_back(bruteForce(named_, ray, chosen, best));
        hits += inMoved.back() != best ? 1 : 0;
      }
    }
    const auto foundDynamic = test::hitsOf(scene, records, &FrontCast::castDynamic, batch, given);
    const auto foundMoved = test::hitsOf(scene, records, &FrontCast::castMoved, batch, given);
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const std::string text = nameOf(kind) + (" ray " + std::to_string(i)) + ": " +
        exactly(batch[i]) + " with " + exactly(given[i]);
      ASSERT_TRUE(isSameHit(foundDynamic[i], inDynamic[i])) << text;
      ASSERT_TRUE(isSameHit(foundMoved[i], inMoved[i])) << text;
    }
  }
  EXPECT_GT(hits, kRays / 4);
}

INSTANTIATE_TEST_SUITE_P(
  Scenes, SceneLaw, testing::ValuesIn(test::sceneMakers()), test::NameOfMesh());

TEST(Scene, WithoutMovedObjectsNothingIsHit)
{
  const Scene scene = test::hardMaps().scene(TraversalMode::Parallel);
  EXPECT_FALSE(test::hitOf(scene, test::hardMaps().records(), &FrontCast::castMoved,
    { { 2, 1, 1 }, { 0, 0, 1 }, {} }, {}));
}

// The bounds of a body beyond the range of doubles are unknown. The bounds of the others must still
// count.
TEST(Scene, ABodyWithoutBoundsAmongMany)
{
  const auto ball = test::bodyOf(test::icosphere(1));
  for (const double size : { 0.0, 1e-320, 1e-300, 1e-3, 1e30, 1e100, 1e200, 1e308 })
  {
    NamedScene scene{ "", test::bodyOf(test::icosphere(2)), {} };
    for (const double x : { -0.6, -0.2, 0.2, 0.6 })
    {
      scene.objects.push_back({ ball, { test::stretch(0.1, 0.1, 0.1), { x, 0, 0 } } });
    }
    scene.objects.push_back({ ball, { test::stretch(0.2, 0.2, size), { 0, 0, 0.5 } } });
    test::RandomVectors random(6);
    const Scene made = scene.scene(TraversalMode::Parallel);
    int hits = 0;
    for (int i = 0; i < 3000; ++i)
    {
      const Ray ray{ 0.7 * random.inCube(), random.direction(), {} };
      const Hit hit = made.cast(ray);
      EXPECT_EQ(hit, test::bruteForce(scene, ray, std::vector<bool>(6, true))) << size;
      hits += hit.id.isDynamic() ? 1 : 0;
    }
    EXPECT_GT(hits, 30);
  }
}

// A ray may begin so far away that the scene looks like a point.
TEST(Scene, CastsFromVeryFar)
{
  const NamedScene scene{ "", test::bodyOf(test::icosphere(2)), {} };
  test::RandomVectors random(4);
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    const Scene made = scene.scene(TraversalMode::Parallel);
    for (const double distance : { 1e6, 1e9, 1e20, 1e35, 1e40, 1e100, 1e150 })
    {
      for (int i = 0; i < 50; ++i)
      {
        const Vector3 away = random.direction();
        const Ray ray{ random.inCube() + distance * away, -away, {} };
        EXPECT_EQ(made.cast(ray), test::bruteForce(scene, ray, { true })) << distance;
      }
    }
  }
}

// A direction may have any length, also such that floats cannot follow it.
TEST(Scene, DirectionsHaveAnyLength)
{
  const NamedScene named = test::hardMaps();
  const std::vector<bool> all(named.objects.size() + 1, true);
  for (const TraversalMode mode : kModes)
  {
    const Scene scene = named.scene(mode);
    RaySource source(named.still->mesh().triangles(), 8);
    int hits = 0;
    for (const double length : { 0x1p-200, 0x1p-61, 0x1p-59, 1e-3, 0x1p59, 0x1p61, 0x1p200 })
    {
      for (const RayKind kind : kRayKinds)
      {
        for (int i = 0; i < 60; ++i)
        {
          Ray ray = source.next(kind);
          ray.direction *= length;
          const Hit expected = bruteForce(named, ray, all);
          hits += expected ? 1 : 0;
          ASSERT_TRUE(isSameHit(scene.cast(ray), expected)) << nameOf(kind) << exactly(ray);
        }
      }
    }
    EXPECT_GT(hits, 1000);
  }
}

// Of two triangles at the same distance the one with the smaller number is hit, in all modes.
TEST(Scene, BreaksTiesByObjectAndTriangle)
{
  const Triangle triangle{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  const auto twice = test::bodyOf({ triangle, triangle });
  const AffineMap identity;
  for (const bool isFlattened : { false, true })
  {
    const NamedScene both{ "", twice,
      { { twice, identity, isFlattened }, { twice, identity, !isFlattened } } };
    for (const TraversalMode mode : kModes)
    {
      const Scene scene = both.scene(mode, { true, true });
      const SurfaceRecords records = both.records();
      const auto moved = [&](const Ray& ray, const Hit& given) {
        return test::hitOf(scene, records, &FrontCast::castMoved, ray, given);
      };
      Ray ray{ { 0.2, 0.3, 2 }, { 0, 0, -1 }, {} };
      EXPECT_EQ(scene.cast(ray), (Hit{ 2, { 0, 0 } }));
      EXPECT_EQ(
        test::hitOf(scene, records, &FrontCast::castDynamic, ray, {}), (Hit{ 2, { 1, 0 } }));
      EXPECT_EQ(moved(ray, Hit{ 2, { 1, 1 } }), (Hit{ 2, { 1, 0 } }));
      EXPECT_EQ(moved(ray, Hit{ 2, { 0, 1 } }), (Hit{ 2, { 0, 1 } }));
      ray.start = { 0, 0 };
      EXPECT_EQ(scene.cast(ray), (Hit{ 2, { 0, 1 } }));
    }
  }
}

TEST(Scene, GivesWorldTrianglesAndNormals)
{
  const Triangle triangle{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  const AffineMap mirrored{ test::stretch(2, -1, 1), { 0, 0, 5 } };
  const NamedScene one{ "", test::bodyOf({ triangle }),
    { { test::bodyOf({ triangle }), mirrored } } };
  const Scene scene = one.scene(TraversalMode::Parallel);
  EXPECT_EQ(scene.worldTriangle({ 0, 0 }), triangle);
  EXPECT_EQ(scene.worldTriangle({ 1, 0 }), (Triangle{ { 0, 0, 5 }, { 2, 0, 5 }, { 0, -1, 5 } }));

  const Ray up{ { 0.5, -0.25, 2 }, { 0, 0, 3 }, {} };
  const Hit hit = scene.cast(up);
  ASSERT_EQ(hit, (Hit{ 1, { 1, 0 } }));
  const SurfacePoint point = test::surfaceAt(scene, up.direction, hit);
  // The mirrored triangle's front looks down, against the ray.
  EXPECT_TRUE(point.isFront);
  EXPECT_EQ(point.normal, Vector3(0, 0, -1));
  EXPECT_LT((point.position - Vector3(0.5, -0.25, 5)).norm(), 1e-14);

  const Ray down{ { 0.5, -0.25, 8 }, { 0, 0, -3 }, {} };
  const SurfacePoint back = test::surfaceAt(scene, down.direction, scene.cast(down));
  EXPECT_FALSE(back.isFront);
  EXPECT_EQ(back.normal, Vector3(0, 0, 1));
}

// Scaling all lengths by a power of two gives the same hits at scaled distances.
TEST(Scene, ScalesExactly)
{
  constexpr unsigned kSeed = 4;
  const NamedScene original = test::hardMaps();
  for (const double factor : { 0x1p-30, 0x1p20 })
  {
    NamedScene scaled = original;
    scaled.still = test::bodyOf(test::scaled(original.still->mesh().triangles(), factor));
    for (PlacedBody& object : scaled.objects)
    {
      object.worldFromObject.linear *= factor;
      object.worldFromObject.translation *= factor;
    }
    const Scene one = original.scene(TraversalMode::Parallel);
    const Scene other = scaled.scene(TraversalMode::Parallel);
    RaySource source(original.still->mesh().triangles(), kSeed);
    for (const RayKind kind : kRayKinds)
    {
      for (int i = 0; i < 10000 / kFewer; ++i)
      {
        const Ray ray = source.next(kind);
        Hit expected = one.cast(ray);
        // The direction has no unit, so distances scale.
        const Ray scaledRay{ factor * ray.origin, ray.direction, ray.start };
        const Hit found = other.cast(scaledRay);
        if (expected)
        {
          const SurfacePoint p = test::surfaceAt(one, ray.direction, expected),
                             q = test::surfaceAt(other, scaledRay.direction, found);
          EXPECT_EQ(q.position, factor * p.position);
          EXPECT_EQ(q.clearance, factor * p.clearance);
          EXPECT_EQ(q.normal, p.normal);
        }
        expected.distance *= factor;
        ASSERT_TRUE(isSameHit(found, expected)) << factor << ' ' << exactly(ray);
      }
    }
  }
}

}
}
