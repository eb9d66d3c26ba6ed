// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "TestFronts.h"
#include "TestRays.h"
#include "TestScenes.h"
#include "TestSimdLevels.h"
#include "Trees/KdTreeBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>

// Law: ray casting = brute force, bit for bit.

namespace irradiance
{
namespace
{

using test::exactly;
using test::isSameHit;
using test::kFewer;
using test::kRayKinds;
using test::NamedMesh;
using test::RayKind;
using test::RaySource;

class KdTreeLaw : public testing::TestWithParam<NamedMesh>
{
protected:
  KdTreeLaw()
    : named{ GetParam().name, test::bodyOf(GetParam().triangles), {} }
    , scene(named.scene(TraversalMode::Parallel))
  {
  }

  Hit bruteForce(const Ray& ray) const { return test::bruteForce(named, ray, { true }); }
  const TriangleMesh& mesh() const { return named.still->mesh(); }

  std::string describe(const Ray& ray, const Hit& expected, const Hit& found) const
  {
    std::string text = exactly(ray);
    for (const Hit& hit : { expected, found })
    {
      text += "\n  hit " + exactly(hit) + (hit ? ": " : "");
      text += hit ? exactly(mesh()[hit.id.triangle]) : "";
    }
    return text;
  }

  /// The number of rays of a kind: as many as 2e7 ray/triangle tests allow.
  int numberOfRays() const
  {
    constexpr int kTests = 20000000, kMost = 30000;
    return std::min(kMost, kTests / static_cast<int>(mesh().size())) / kFewer;
  }

  test::NamedScene named;
  Scene scene;
};

TEST_P(KdTreeLaw, FindsWhatBruteForceFinds)
{
  constexpr unsigned kSeed = 1;
  RaySource source(GetParam().triangles, kSeed);
  int hits = 0, wrong = 0;
  for (const RayKind kind : kRayKinds)
  {
    std::vector<Ray> rays;
    std::vector<Hit> expected;
    for (int i = 0; i < numberOfRays(); ++i)
    {
      rays.push_back(source.next(kind));
      expected.push_back(bruteForce(rays.back()));
      hits += expected.back() ? 1 : 0;
    }
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      std::vector<Hit> found(rays.size());
      scene.cast(rays.data(), rays.size(), found.data());
      for (std::size_t i = 0; i < rays.size(); ++i)
      {
        if (!isSameHit(found[i], expected[i]) && ++wrong <= 3)
        {
          ADD_FAILURE() << nameOf(kind) << " ray " << i << ", SIMD level "
                        << static_cast<int>(level) << ' '
                        << describe(rays[i], expected[i], found[i]);
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0) << "of " << kRayKinds.size() * numberOfRays();
  EXPECT_GT(hits, numberOfRays());
}

// A known hit is replaced only by a closer one, or by one with a smaller number at a tie.
TEST_P(KdTreeLaw, KeepsABetterHit)
{
  constexpr unsigned kSeed = 3;
  RaySource source(GetParam().triangles, kSeed);
  const SurfaceRecords records = named.records();
  for (const RayKind kind : kRayKinds)
  {
    std::vector<Ray> rays;
    std::vector<Hit> given, expected;
    for (int i = 0; i < numberOfRays() / 8; ++i)
    {
      const Ray ray = source.next(kind);
      const Hit nearest = bruteForce(ray);
      const double distance = nearest ? nearest.distance : 1.0;
      for (const Hit& best :
        { Hit{ distance, { 1, 0 } }, Hit{ distance * source.random().uniform(0.5, 2), { 1, 0 } },
          Hit{ std::nextafter(distance, 0.0), { 1, 0 } } })
      {
        rays.push_back(ray);
        given.push_back(best);
        expected.push_back(test::isCloser(nearest, best) ? nearest : best);
      }
    }
    const auto found = test::hitsOf(scene, records, &FrontCast::cast, rays, given);
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      ASSERT_TRUE(isSameHit(found[i], expected[i]))
        << nameOf(kind) << " ray " << i << ' ' << exactly(rays[i]) << "\n  found "
        << exactly(found[i]) << " with " << exactly(given[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
  Meshes, KdTreeLaw, testing::ValuesIn(test::testMeshes()), test::NameOfMesh());

TEST(KdTree, OfNothingIsHitByNothing)
{
  Scene scene;
  scene.commit({});
  EXPECT_FALSE(scene.cast({ { 0, 0, 0 }, { 0, 0, 1 }, {} }));
}

TEST(KdTree, EveryTriangleIsInSomeLeaf)
{
  for (const NamedMesh& mesh : test::testMeshes())
  {
    std::vector<KdPrimitive> primitives;
    for (const Triangle& triangle : mesh.triangles)
    {
      primitives.push_back({ triangle.bounds(), &triangle });
    }
    const KdTree tree = KdTreeBuilder().build(primitives);
    std::vector<bool> seen(primitives.size());
    for (const std::uint32_t reference : tree.references)
    {
      seen[reference] = true;
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << mesh.name;
  }
}

}
}
