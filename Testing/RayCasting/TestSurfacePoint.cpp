// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "TestMeshes.h"
#include "TestRays.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

// Where a ray leaves a surface: on it, clear of it and of its neighbours.

namespace irradiance
{
namespace
{

using test::exactly;
using test::kFewer;
using test::NamedMesh;
using test::RandomVectors;

/// Half of them are close to an edge or a corner; the sum is 1 up to rounding.
Vector3 randomWeights(RandomVectors& random)
{
  const double s = random.uniform(0, 1), t = random.uniform(0, 1) * (1 - s);
  Vector3 weights(s, t, 1 - s - t);
  const auto i = static_cast<int>(random.engine() % 3);
  switch (random.engine() % 6)
  {
    case 0:
      weights[i] = random.powerOfTwo(-60, -1);
      break;
    case 1:
      weights[i] = 0;
      break;
    case 2:
      weights[i] = random.powerOfTwo(-60, -1);
      weights[(i + 1) % 3] = random.powerOfTwo(-60, -1);
      break;
    default:
      break;
  }
  return weights / weights.sum();
}

/// A direction on the side of the normal; one in five grazes.
Vector3 randomDirection(const Vector3& normal, RandomVectors& random)
{
  Vector3 direction = random.direction();
  double cosine = direction.dot(normal);
  direction -= cosine * normal;
  cosine = std::abs(cosine);
  if (random.engine() % 5 == 0)
  {
    cosine *= random.powerOfTwo(-24, 0);
  }
  return (direction + cosine * normal).normalized();
}

class SpawnedRays : public testing::TestWithParam<NamedMesh>
{
};

// Law: a ray that starts on the inside of a closed mesh hits the mesh from inside.
TEST_P(SpawnedRays, StayInAClosedMesh)
{
  constexpr unsigned kSeed = 1;
  const int kRays = 150000 / kFewer * test::effort();
  Scene scene;
  const auto body = std::make_shared<RigidObject>(TriangleMesh(GetParam().triangles));
  scene.setStatic(body);
  scene.commit({});
  RandomVectors random(kSeed);
  int leaks = 0, losses = 0;
  for (int i = 0; i < kRays; ++i)
  {
    const TriangleId start{ 0, static_cast<std::uint32_t>(random.engine() % body->mesh().size()) };
    SurfacePoint point = surfacePoint(body->mesh()[start.triangle], randomWeights(random));
    point.normal = -point.normal; // fronts are outside
    const Ray ray{ point.clearPosition(), randomDirection(point.normal, random), start };
    const Hit hit = scene.cast(ray);
    const bool isLeak = !hit;
    const bool isLoss =
      hit && test::surfaceAt(scene, ray.direction, hit).isFront; // hit from outside
    leaks += isLeak ? 1 : 0;
    losses += isLoss ? 1 : 0;
    if ((isLeak || isLoss) && leaks + losses <= 3)
    {
      ADD_FAILURE() << "seed " << kSeed << " ray " << i << ": " << exactly(ray) << "\n  of "
                    << exactly(body->mesh()[start.triangle]) << "\n  " << exactly(hit);
    }
  }
  EXPECT_EQ(leaks, 0) << "of " << kRays;
  EXPECT_EQ(losses, 0) << "of " << kRays;
}

INSTANTIATE_TEST_SUITE_P(
  ClosedMeshes, SpawnedRays, testing::ValuesIn(test::closedMeshes()), test::NameOfMesh());

// A ray must get away from what lies in the plane of its triangle, too.
TEST(SurfacePoint, IsClearOfCoplanarTriangles)
{
  constexpr unsigned kSeed = 5;
  RandomVectors random(kSeed);
  int met = 0;
  for (int pose = 0; pose < 10; ++pose)
  {
    const TriangleMesh mesh(test::coincidentSheets(random.rotation()));
    for (int i = 0; i < 2000 / kFewer; ++i)
    {
      const auto start = static_cast<std::uint32_t>(random.engine() % mesh.size());
      const SurfacePoint point = surfacePoint(mesh[start], randomWeights(random));
      const Vector3 direction = randomDirection(point.normal, random);
      const ShearedRay ray(point.clearPosition(), direction);
      for (std::uint32_t k = 0; k < mesh.size(); ++k)
      {
        double distance;
        met += k != start && ray.intersects(mesh[k], distance) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(met, 0) << "seed " << kSeed;
}

TEST(SurfacePoint, HasTheFrontsNormalAndAMarginByTheCoordinates)
{
  const Triangle triangle{ { 3, 0, 5 }, { 4, 0, 5 }, { 3, 2, 5 } };
  const SurfacePoint point = surfacePoint(triangle, { 0.25, 0.25, 0.5 });
  EXPECT_EQ(point.normal, Vector3(0, 0, 1));
  EXPECT_TRUE(point.isFront);
  EXPECT_EQ(point.clearance, 5 * 0x1p-33);
  EXPECT_EQ(point.position, Vector3(3.25, 1, 5));
  EXPECT_EQ(point.clearPosition(), Vector3(3.25, 1, 5 + 5 * 0x1p-33));
}

TEST(SurfacePoint, LiesInTheTriangleOffItsEdges)
{
  constexpr unsigned kSeed = 2;
  RandomVectors random(kSeed);
  for (int i = 0; i < 200000 / kFewer; ++i)
  {
    const double size = random.powerOfTwo(-12, 3);
    const Vector3 a = random.inCube();
    const Triangle triangle{ a, a + size * random.inCube(), a + size * random.inCube() };
    const Vector3 edges[] = { triangle.c - triangle.b, triangle.a - triangle.c,
      triangle.b - triangle.a };
    const Vector3 corners[] = { triangle.b, triangle.c, triangle.a };
    const double area = triangle.areaVector().norm();
    const double perimeter = edges[0].norm() + edges[1].norm() + edges[2].norm();
    const Vector3 weights = randomWeights(random);
    const SurfacePoint point = surfacePoint(triangle, weights);
    const double inradius = area / perimeter;
    if (inradius < 4 * point.clearance)
    {
      continue; // too small to keep points off its edges
    }
    const double rounding = 0x1p-45;
    EXPECT_LT(std::abs(point.normal.dot(point.position - a)), rounding * (1 + size)) << i;
    double clearance = kInfinity;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 inwards = point.normal.cross(edges[k]).normalized();
      clearance = std::min(clearance, inwards.dot(point.position - corners[k]));
    }
    // Normalising the weights to a sum of 1 takes back a little of the distance.
    EXPECT_GT(clearance, 0.5 * point.clearance) << "seed " << kSeed << " triangle " << i;
    // The point moves no farther than the insets of two edges require.
    const Vector3 exact =
      weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
    const double longest = std::max({ edges[0].norm(), edges[1].norm(), edges[2].norm() });
    EXPECT_LT((point.position - exact).norm(),
      4 * 64 * point.clearance * longest * longest / area + rounding * (1 + size))
      << "seed " << kSeed << " triangle " << i;
  }
}

// Law: no point is farther off than verification assumes, not even on the slenderest triangles. The
// weights are rounded as the weights of a hit are.
TEST_P(SpawnedRays, BeginWithinTheClearance)
{
  constexpr unsigned kSeed = 7;
  const TriangleMesh mesh(GetParam().triangles);
  RandomVectors random(kSeed);
  const double bound =
    farthestClearance(mesh.bounds().magnitude(), mesh.longestEdge(), mesh.slenderness());
  double farthest = 0;
  for (int i = 0; i < 20000 / kFewer; ++i)
  {
    const Triangle& triangle = mesh[random.engine() % mesh.size()];
    const Vector3 weights = randomWeights(random);
    const Vector3 hit = weights[0] * triangle.a + weights[1] * triangle.b + weights[2] * triangle.c;
    const Hit stored{ 0, {}, { static_cast<float>(weights[1]), static_cast<float>(weights[2]) } };
    farthest =
      std::max(farthest, (surfacePoint(triangle, weightsOf(stored)).clearPosition() - hit).norm());
  }
  EXPECT_LE(farthest, bound * (1 + 0x1p-20));
  EXPECT_GT(farthest, 0.001 * bound); // the bound is not absurdly large
}

TEST(SurfacePoint, OfATriangleThinnerThanTheMarginStaysInIt)
{
  const Triangle sliver{ { 1, 0, 0 }, { 2, 0, 0 }, { 1.5, 1e-12, 0 } };
  const SurfacePoint point = surfacePoint(sliver, { 1, 0, 0 });
  EXPECT_GE(point.position[0], 1);
  EXPECT_LE(point.position[0], 2);
  EXPECT_GE(point.position[1], 0);
  EXPECT_LE(point.position[1], 1e-12);
}

TEST(SurfacePoint, ScalesExactly)
{
  constexpr unsigned kSeed = 3;
  RandomVectors random(kSeed);
  for (int i = 0; i < 20000; ++i)
  {
    const Triangle triangle{ random.inCube(), random.inCube(), random.inCube() };
    const Vector3 weights = randomWeights(random);
    const SurfacePoint point = surfacePoint(triangle, weights);
    for (const double factor : { 0x1p-60, 0x1p-3, 0x1p40 })
    {
      const SurfacePoint scaled =
        surfacePoint({ factor * triangle.a, factor * triangle.b, factor * triangle.c }, weights);
      ASSERT_EQ(scaled.position, factor * point.position) << "seed " << kSeed << ' ' << i;
      ASSERT_EQ(scaled.clearance, factor * point.clearance);
      ASSERT_EQ(scaled.normal, point.normal);
    }
  }
}

}
}
