// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontCast.h"

#include "TestFronts.h"
#include "TestRays.h"
#include "TestScenes.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

// Attacks the margins with which a front prepares rays in floats: where they enter the tree's box,
// how late, and how nearly along it.

namespace irradiance
{
namespace
{

using test::exactly;
using test::RandomVectors;
using test::Triangles;

/// Tiny triangles in the faces of a box, along its edges and in its corners, in all orientations: a
/// ray that begins a little too late in the box has passed them.
Triangles crumbsInFaces(RandomVectors& random, double size)
{
  Triangles triangles;
  for (int i = 0; i < 120; ++i)
  {
    Vector3 place = random.inCube();
    const int faces = i % 8 == 0 ? 3 : i % 4 == 0 ? 2 : 1;
    for (int axis = 0; axis < faces; ++axis)
    {
      // Within their own size of the face, so that they reach it.
      place[(i + axis) % 3] = random.uniform() < 0 ? -1 : 1;
    }
    const auto corner = [&] {
      return Vector3((place + size * random.inCube()).cwiseMax(-1).cwiseMin(1));
    };
    const Vector3 a = corner(), b = corner(), c = corner();
    triangles.push_back({ a, b, c });
    // One that lies flat in the face: floats bound its distance best.
    Vector3 along = Vector3::Zero(), across = Vector3::Zero();
    along[(i + 1) % 3] = size;
    across[(i + 2) % 3] = size;
    triangles.push_back({ place, place + along, place + across });
  }
  return triangles;
}

/// A ray at a point of a triangle or just beside it; often nearly along an axis of the tree, or
/// nearly in a face of its box; from some distance, relative to the box. `map`: from the tree's
/// space to the world.
Ray attack(const Triangles& triangles, const AffineMap& map, RandomVectors& random)
{
  const Triangle& triangle = triangles[random.engine() % triangles.size()];
  const double s = random.uniform(0, 1), t = random.uniform(0, 1) * (1 - s);
  Vector3 target = (1 - s - t) * triangle.a + s * triangle.b + t * triangle.c;
  Vector3 direction = random.direction();
  const auto axis = static_cast<int>(random.engine() % 3);
  switch (random.engine() % 5)
  {
    case 0: // nearly along an axis, about as nearly as floats follow
      direction = Vector3::Unit(axis) + random.powerOfTwo(-13, -6) * random.inCube();
      break;
    case 1: // along a face, in which most targets lie
      direction[axis] = random.uniform() * random.powerOfTwo(-12, -8);
      break;
    case 2: // along a diagonal: there the pad, which might hide an error, is least
      direction = Vector3::Ones() + 0.5 * random.inCube();
      direction[axis] *= random.uniform() < 0 ? -1 : 1;
      break;
    case 3:
      target = random.engine() % 2 == 0 ? triangle.a : triangle.c;
      break;
    default:
      break;
  }
  if (random.uniform() < 0)
  {
    direction = -direction;
  }
  Ray ray = test::asInFront({ map(target), map.linear * direction, {} });
  const double length = (map.linear.inverse() * ray.direction).norm();
  // The tree's frame is half as large; from beyond 2^12 in it, others prepare the rays.
  const double distance =
    random.uniform() < 0 ? random.powerOfTwo(12, 13.2) : random.powerOfTwo(-1, 13.5);
  ray.origin -= distance / length * ray.direction;
  return ray;
}

/// What is attacked: a static mesh, at some place, or a body.
struct Target
{
  Triangles triangles;
  AffineMap map; ///< to the world
  test::NamedScene scene;

  explicit Target(RandomVectors& random)
    : triangles(crumbsInFaces(random, random.powerOfTwo(-20, -4)))
  {
    if (random.engine() % 3 == 0)
    {
      map = { random.powerOfTwo(-8, 8) * random.rotation(), random.inCube() };
      scene = { "", test::bodyOf({}), { { test::bodyOf(triangles), map } } };
      return;
    }
    map.translation = random.engine() % 2 == 0
      ? Vector3(Vector3::Zero())
      : Vector3(random.powerOfTwo(0, 20) * random.inCube());
    scene = { "", test::bodyOf(test::moved(triangles, map)), {} };
  }
};

/// Casts rays at a target. Returns how many have not the hits of brute force.
int mismatches(RandomVectors& random, int& hits)
{
  constexpr std::uint32_t kRays = 4000;
  const Target target(random);
  const Scene scene = target.scene.scene(TraversalMode::Sequential);
  SurfaceRecords records;
  records.update(target.scene.still, target.scene.objects);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < kRays; ++i)
  {
    rays.push_back(attack(target.triangles, target.map, random));
  }
  std::vector<Hit> expected;
  for (const Ray& ray : rays)
  {
    expected.push_back(test::bruteForce(target.scene, ray, { true, true }));
  }
  int wrong = 0;
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    test::TestFront front(records);
    front.set(rays, std::vector<Hit>(kRays));
    FrontCast().cast(scene, records, front.columns());
    for (std::size_t i = 0; i < kRays; ++i)
    {
      const Hit found = front.hit(i);
      hits += found ? 1 : 0;
      if (found != expected[i] && ++wrong == 1 && !testing::Test::HasFailure())
      {
        ADD_FAILURE() << "SIMD level " << static_cast<int>(level) << ": " << exactly(rays[i])
                      << "\n  expected " << exactly(expected[i]) << "\n  found " << exactly(found);
      }
    }
  }
  return wrong;
}

// VTKIRRADIANCE_TEST_EFFORT=9 casts some ten million rays.
TEST(PrepareLanes, LoseNoHitWhereRaysEnterTheTree)
{
  constexpr unsigned kSeed = 41;
  RandomVectors random(kSeed);
  const int targets = std::max(1, 300 * test::effort() / test::kFewer);
  int wrong = 0, hits = 0;
  for (int i = 0; i < targets; ++i)
  {
    wrong += mismatches(random, hits);
  }
  EXPECT_EQ(wrong, 0) << "of " << targets * 12000 << ", seed " << kSeed;
  EXPECT_GT(hits, targets * 4000);
}

/// How late a ray begins, as a part of its true entry into the box of the tree: less than 0 if
/// early.
template <class Real>
double lateness(const PrepareLanes<Real>& lanes, unsigned lane, const TriangleTree& tree,
  const double* const (&origins)[3], const Real* const (&directions)[3])
{
  long double entry = 0, origin[3], direction[3];
  int steepest = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    direction[axis] = directions[axis][lane];
    origin[axis] = (static_cast<long double>(origins[axis][lane]) - tree.frame().center[axis]) *
      tree.frame().scale;
    steepest = std::abs(direction[axis]) > std::abs(direction[steepest]) ? axis : steepest;
    const long double lower = (tree.bounds().lower[axis] - origin[axis]) / direction[axis],
                      upper = (tree.bounds().upper[axis] - origin[axis]) / direction[axis];
    entry = std::max(entry, std::min(lower, upper));
  }
  const long double begin = (lanes.begin[steepest][lane] - origin[steepest]) / direction[steepest];
  return static_cast<double>((begin - entry) / entry);
}

/// Fifteen random rays at a unit box from afar, and one that begins in it; the extremes of
/// lateness.
template <class Real>
std::pair<double, double> extremeLateness(RandomVectors& random, int groups)
{
  constexpr unsigned kSize = PrepareLanes<Real>::kSize;
  const TriangleTree tree = treeOf(test::boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 }));
  std::pair<double, double> extremes(kInfinity, -kInfinity);
  for (int group = 0; group < groups; ++group)
  {
    double origin[3][kSize], bound[kSize];
    Real direction[3][kSize];
    for (unsigned lane = 0; lane < kSize; ++lane)
    {
      const Ray ray = test::asInFront({ random.inCube(), random.direction(), {} });
      const double away = lane == 0 ? 0 : random.powerOfTwo(6, 12.5);
      bound[lane] = kInfinity;
      for (int axis = 0; axis < 3; ++axis)
      {
        direction[axis][lane] = static_cast<Real>(ray.direction[axis]);
        origin[axis][lane] = ray.origin[axis] - away * ray.direction[axis];
      }
    }
    PrepareLanes<Real> lanes;
    const double* const origins[] = { origin[0], origin[1], origin[2] };
    const Real* const directions[] = { direction[0], direction[1], direction[2] };
    lanes.prepare(tree, origins, directions, bound);
    EXPECT_EQ(lanes.begin[0][0], static_cast<float>(0.5 * origin[0][0]));
    for (unsigned lane = 1; lane < kSize; ++lane)
    {
      if (lanes.isKept[lane] != 0)
      {
        const double late = lateness<Real>(lanes, lane, tree, origins, directions);
        extremes = { std::min(extremes.first, late), std::max(extremes.second, late) };
      }
    }
  }
  return extremes;
}

// Law: no ray begins behind its entry, except by the rounding of where it begins. Nor much before
// it.
TEST(PrepareLanes, BeginNoRayTooLate)
{
  RandomVectors random(42);
  const int groups = std::max(1, 20000 * test::effort() / test::kFewer);
  for (const auto& [earliest, latest] :
    { extremeLateness<float>(random, groups), extremeLateness<double>(random, groups) })
  {
    EXPECT_LT(latest, 0);
    EXPECT_GT(earliest, -0x1p-19);
  }
}

}
}
