// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/TriangleIntersection.h"

#include "Kernels/FrontStages.h"
#include "RandomVectors.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

namespace irradiance
{
namespace
{

using test::RandomVectors;

struct Found
{
  double distance;
  Vector3 weights;
};

std::optional<Found> meet(const Vector3& origin, const Vector3& direction, const Triangle& triangle)
{
  Found found;
  if (!ShearedRay(origin, direction).intersects(triangle, found.distance, &found.weights))
  {
    return std::nullopt;
  }
  return found;
}

const Triangle kUnit{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };

TEST(TriangleIntersection, GivesDistanceAndWeights)
{
  const auto hit = meet({ 0.25, 0.5, 3 }, { 0, 0, -2 }, kUnit);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->distance, 1.5);
  EXPECT_EQ(hit->weights, Vector3(0.25, 0.25, 0.5));
}

TEST(TriangleIntersection, IsTheSameFromBothSides)
{
  const Triangle turned{ kUnit.a, kUnit.c, kUnit.b };
  for (const Triangle& triangle : { kUnit, turned })
  {
    const auto above = meet({ 0.25, 0.5, 3 }, { 0, 0, -1 }, triangle);
    const auto below = meet({ 0.25, 0.5, -3 }, { 0, 0, 1 }, triangle);
    ASSERT_TRUE(above && below);
    EXPECT_EQ(above->distance, 3);
    EXPECT_EQ(below->distance, 3);
  }
}

TEST(TriangleIntersection, IncludesEdgesAndVertices)
{
  for (const Vector3& target :
    { kUnit.a, kUnit.b, kUnit.c, Vector3(0.5, 0.5, 0), Vector3(0.25, 0, 0), Vector3(0, 0.75, 0) })
  {
    EXPECT_TRUE(meet(target + Vector3(0, 0, 1), { 0, 0, -1 }, kUnit)) << target.transpose();
  }
  EXPECT_FALSE(meet({ -0x1p-60, 0.25, 1 }, { 0, 0, -1 }, kUnit));
  EXPECT_FALSE(meet({ 0.5, 0.5 + 0x1p-50, 1 }, { 0, 0, -1 }, kUnit));
}

TEST(TriangleIntersection, CountsOnlyWhatIsAhead)
{
  EXPECT_FALSE(meet({ 0.25, 0.25, 1 }, { 0, 0, 1 }, kUnit));
  EXPECT_FALSE(meet({ 0.25, 0.25, 0 }, { 0, 0, 1 }, kUnit));
  EXPECT_TRUE(meet({ 0.25, 0.25, 0x1p-500 }, { 0, 0, -1 }, kUnit));
}

TEST(TriangleIntersection, FindsAnyKnownPoint)
{
  constexpr unsigned kSeed = 1;
  RandomVectors random(kSeed);
  for (int i = 0; i < 100000; ++i)
  {
    const Triangle triangle{ random.inCube(), random.inCube(), random.inCube() };
    const double s = random.uniform(0.01, 0.98), t = random.uniform(0.01, 0.99 - s);
    const Vector3 point = (1 - s - t) * triangle.a + s * triangle.b + t * triangle.c;
    const Vector3 origin = 3 * random.inCube();
    const Vector3 direction = (point - origin) * random.powerOfTwo(-5, 5);
    const Vector3 area = triangle.areaVector();
    const double sine = std::abs(area.dot(direction)) / (area.norm() * direction.norm());
    const double width = area.norm() / triangle.bounds().extent().maxCoeff();
    if (sine * width < 1e-3)
    {
      continue; // seen too flat for a reliable reference
    }
    const auto hit = meet(origin, direction, triangle);
    ASSERT_TRUE(hit) << "seed " << kSeed << " ray " << i;
    const Vector3 found = origin + hit->distance * direction;
    EXPECT_LT((found - point).norm(), 1e-11) << "seed " << kSeed << " ray " << i;
    EXPECT_LT((hit->weights - Vector3(1 - s - t, s, t)).norm(), 1e-10);
  }
}

TEST(TriangleIntersection, NothingMeetsATriangleWithoutArea)
{
  constexpr unsigned kSeed = 2;
  RandomVectors random(kSeed);
  const auto expectMissed = [](const Triangle& triangle, const Vector3& target,
                              const Vector3& origin) {
    EXPECT_FALSE(meet(origin, target - origin, triangle)) << origin.transpose();
  };
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3 p = random.inCube(), q = random.inCube();
    const Vector3 middle = 0.5 * (p + q), origin = 3 * random.inCube();
    for (const Vector3& target : { p, q, middle, Vector3(p + 0.3 * (q - p)) })
    {
      expectMissed({ p, p, p }, target, origin);
      expectMissed({ p, q, p }, target, origin);
      expectMissed({ p, q, q }, target, origin);
      expectMissed({ p, q, middle }, target, origin);
    }
  }
}

TEST(TriangleIntersection, NothingMeetsATriangleEdgeOn)
{
  constexpr unsigned kSeed = 3;
  RandomVectors random(kSeed);
  for (int i = 0; i < 20000; ++i)
  {
    // All coordinates are multiples of 2^-20, so that the ray lies exactly in the plane.
    const auto onGrid = [&] { return std::round(random.uniform() * 0x1p20) * 0x1p-20; };
    const double z = onGrid();
    const Triangle triangle{ { onGrid(), onGrid(), z }, { onGrid(), onGrid(), z },
      { onGrid(), onGrid(), z } };
    const Vector3 origin(3 * onGrid(), 3 * onGrid(), z);
    for (const Vector3& target :
      { triangle.a, triangle.b, Vector3((triangle.a + triangle.b + triangle.c) / 3) })
    {
      EXPECT_FALSE(meet(origin, target - origin, triangle)) << "seed " << kSeed << ' ' << i;
    }
  }
}

TEST(TriangleIntersection, ScalesExactly)
{
  constexpr unsigned kSeed = 4;
  RandomVectors random(kSeed);
  int hits = 0;
  for (int i = 0; i < 200000; ++i)
  {
    const Triangle triangle{ random.inCube(), random.inCube(), random.inCube() };
    const Vector3 origin = 2 * random.inCube();
    const Vector3 target = i % 3 == 0 ? triangle.a
      : i % 3 == 1                    ? Vector3(0.5 * (triangle.a + triangle.b))
                                      : random.inCube();
    const Vector3 direction = target - origin;
    const auto hit = meet(origin, direction, triangle);
    hits += hit ? 1 : 0;
    for (const double factor : { 0x1p-100, 0x1p-20, 0x1p1, 0x1p77 })
    {
      const auto scaled = meet(factor * origin, direction,
        { factor * triangle.a, factor * triangle.b, factor * triangle.c });
      ASSERT_EQ(hit.has_value(), scaled.has_value()) << "seed " << kSeed << " ray " << i;
      if (hit)
      {
        EXPECT_EQ(scaled->distance, factor * hit->distance);
        EXPECT_EQ(scaled->weights, hit->weights);
      }
    }
  }
  EXPECT_GT(hits, 40000);
}

// All instruction sets and all lanes give the bits of the test of one triangle.
TEST(TriangleIntersection, IsTheSameInLanes)
{
  constexpr unsigned kSeed = 5;
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    RandomVectors random(kSeed);
    IntersectionLanes lanes;
    int hits = 0;
    for (int i = 0; i < 40000; ++i)
    {
      std::array<std::optional<Found>, IntersectionLanes::kSize> expected;
      for (unsigned lane = 0; lane < IntersectionLanes::kSize; ++lane)
      {
        const double flat = lane % 2 == 0 ? 1 : random.powerOfTwo(-60, 0);
        const Triangle triangle{ random.inCube(), random.inCube(),
          lane == 3 ? Vector3::Zero() : Vector3(flat * random.inCube()) };
        const Vector3 target = lane < 5 ? Vector3((triangle.a + triangle.b + triangle.c) / 3)
          : lane == 5                   ? triangle.b
                                        : Vector3(0.5 * (triangle.a + triangle.c));
        const Vector3 origin = random.powerOfTwo(-30, 30) * random.inCube();
        lanes.set(lane, origin, target - origin, triangle);
        expected[lane] = meet(origin, target - origin, triangle);
      }
      frontStages().intersect(lanes);
      for (unsigned lane = 0; lane < IntersectionLanes::kSize; ++lane)
      {
        ASSERT_EQ(expected[lane].has_value(), !std::isnan(lanes.distance[lane]));
        if (expected[lane])
        {
          ++hits;
          ASSERT_EQ(expected[lane]->distance, lanes.distance[lane]);
          ASSERT_EQ(expected[lane]->weights[1], lanes.weightB[lane]);
          ASSERT_EQ(expected[lane]->weights[2], lanes.weightC[lane]);
        }
      }
    }
    EXPECT_GT(hits, 100000);
    EXPECT_LT(hits, 310000);
  }
}

}
}
