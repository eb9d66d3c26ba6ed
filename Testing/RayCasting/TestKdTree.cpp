// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "TestFronts.h"
#include "TestMeshes.h"
#include "TestRays.h"
#include "TestSimdLevels.h"
#include "Trees/KdTreeBuilder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

// Law: ray casting = brute force, bit for bit.

namespace irradiance
{
namespace
{

using test::exactly;
using test::kFewer;
using test::kRayKinds;
using test::NamedMesh;
using test::RayKind;
using test::RaySource;

Hit bruteForce(const TriangleMesh& mesh, const Ray& ray)
{
  const ShearedRay sheared(ray.origin, ray.direction);
  Hit best;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
  {
    Hit hit{ 0, { 0, i } };
    if (sheared.intersects(mesh[i], hit.distance) && hit.id != ray.start && isCloser(hit, best))
    {
      best = hit;
    }
  }
  return best;
}

bool isSameHit(const Hit& a, const Hit& b)
{
  return std::memcmp(&a.distance, &b.distance, sizeof a.distance) == 0 && a.id == b.id;
}

class KdTreeLaw : public testing::TestWithParam<NamedMesh>
{
protected:
  KdTreeLaw()
    : body(std::make_shared<RigidObject>(TriangleMesh(GetParam().triangles)))
  {
    scene.setStatic(body);
    scene.commit({});
  }

  std::string describe(const Ray& ray, const Hit& expected, const Hit& found) const
  {
    std::string text = exactly(ray);
    for (const Hit& hit : { expected, found })
    {
      text += "\n  hit " + exactly(hit) + (hit ? ": " : "");
      text += hit ? exactly(body->mesh()[hit.id.triangle]) : "";
    }
    return text;
  }

  /// The number of rays of a kind: as many as 2e7 ray/triangle tests allow.
  int numberOfRays() const
  {
    constexpr int kTests = 20000000, kMost = 30000;
    return std::min(kMost, kTests / static_cast<int>(body->mesh().size())) / kFewer;
  }

  std::shared_ptr<const RigidObject> body;
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
      expected.push_back(bruteForce(body->mesh(), rays.back()));
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
  SurfaceRecords records;
  records.update(body, {});
  for (const RayKind kind : kRayKinds)
  {
    std::vector<Ray> rays;
    std::vector<Hit> given, expected;
    for (int i = 0; i < numberOfRays() / 8; ++i)
    {
      const Ray ray = source.next(kind);
      const Hit nearest = bruteForce(body->mesh(), ray);
      const double distance = nearest ? nearest.distance : 1.0;
      for (const Hit& best :
        { Hit{ distance, { 1, 0 } }, Hit{ distance * source.random().uniform(0.5, 2), { 1, 0 } },
          Hit{ std::nextafter(distance, 0.0), { 1, 0 } } })
      {
        rays.push_back(ray);
        given.push_back(best);
        expected.push_back(isCloser(nearest, best) ? nearest : best);
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
