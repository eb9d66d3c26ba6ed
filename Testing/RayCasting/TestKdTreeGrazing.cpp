// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Scene.h"

#include "TestRays.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

// A ray almost in the plane of a large triangle gets a distance that is off by up to 2^-52 of the
// size divided by the tilt, some 2^-13 for the flattest hits that count. If something lies just in
// front of the triangle's edge, the triangle may be closer by its computed distance and yet farther
// by its place in the tree. The tree must still find it.

namespace irradiance
{
namespace
{

using test::exactly;
using test::RandomVectors;

/// A large triangle in the x-y plane with an edge through the origin. A comb of tiny triangles
/// along the negative x axis is in the way; others beside it make the tree separate the comb from
/// the large triangle.
test::Triangles combBeforeEdge(double length)
{
  test::Triangles triangles = { { { -1, 1, 0 }, { 1, -1, 0 }, { 1, 1, 0 } } };
  for (double x = length; x > 0x1p-21; x *= 0.9)
  {
    const double w = 0.1 * x;
    triangles.push_back({ { -x, -w, -w }, { -x, w, -w }, { -x, -w, w } });
    triangles.push_back({ { -x, -w, -w }, { -x, w, -w }, { -x - w, w, w } });
  }
  for (double x = 1; x > length; x *= 0.85)
  {
    const double h = -0.02 * x;
    for (const double y : { -0.3 * x, 0.3 * x })
    {
      for (const double z : { -0.3 * x, 0.3 * x })
      {
        triangles.push_back({ { -x, y, z }, { -x, y + h, z }, { -x - h, y, z + h } });
      }
    }
  }
  return triangles;
}

/// Counts rays along x, tilted by about `tilt`, for which the tree and brute force differ.
int mismatches(const AffineMap& place, double tilt, double length, int rays, RandomVectors& random)
{
  const test::Triangles triangles = test::moved(combBeforeEdge(length), place);
  const test::NamedScene named{ "comb", test::bodyOf(triangles), {} };
  const Scene scene = named.scene(TraversalMode::Parallel);
  const Triangle& large = triangles[0];
  int wrong = 0;
  for (int i = 0; i < rays; ++i)
  {
    const Vector3 target = large.a +
      (0.5 + random.uniform(-0.01, 0.01) * length) * (large.b - large.a) +
      random.powerOfTwo(-54, -45) * Vector3::UnitX();
    const Vector3 direction =
      place.linear * Vector3(1, 0, (random.uniform() < 0 ? -1 : 1) * random.uniform(1, 2) * tilt);
    const Ray ray{ target - random.uniform(0.5, 1) * direction, direction, {} };
    const Hit expected = test::bruteForce(named, ray, { true });
    const Hit found = scene.cast(ray);
    if (found != expected && ++wrong == 1 && !testing::Test::HasFailure())
    {
      ADD_FAILURE() << exactly(ray) << "\n  brute force " << exactly(expected) << ": "
                    << exactly(triangles[expected.id.triangle]) << "\n  tree " << exactly(found);
    }
  }
  return wrong;
}

TEST(KdTree, FindsAnEarlyHitOfAGrazedTriangle)
{
  constexpr unsigned kSeed = 4;
  RandomVectors random(kSeed);
  for (const double tilt : { 0x1p-41, 0x1p-40, 0x1p-39, 0x1p-38, 0x1p-36, 0x1p-33 })
  {
    for (const double length : { 0x1p-13, 0x1p-15, 0x1p-17 })
    {
      int wrong = 0;
      for (int pose = 0; pose < 10; ++pose)
      {
        // Rotates about the ray only: the tree's planes must stay across the comb.
        const AffineMap place{
          Eigen::AngleAxisd(0.1 + 0.3 * pose, Vector3::UnitX()).toRotationMatrix(), random.inCube()
        };
        wrong += mismatches(place, tilt, length, 4000 / test::kFewer, random);
      }
      EXPECT_EQ(wrong, 0) << "tilt " << tilt << ", comb of " << length << ", seed " << kSeed;
    }
  }
}

}
}
