// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/AxisPlanes.h"

#include "Kernels/CountedBlocks.h"
#include "Trees/KdBounds.h"

#include "TestRays.h"
#include "TestScenes.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

namespace irradiance
{
namespace
{

using test::NamedScene;
using test::Triangles;

Triangle acrossZ(double z)
{
  return { { 0, 0, z }, { 1, 0, z }, { 0, 1, z } };
}

TEST(AxisPlanes, KnowsThePlanesOfTriangles)
{
  const Triangle oblique{ { 0, 0, 0 }, { 1, 0, 0.1 }, { 0, 1, 0 } };
  const Triangle acrossX{ { 2, 0, 0 }, { 2, 1, 0 }, { 2, 0, 1 } };
  const AxisPlanes planes({ acrossZ(0.1), oblique, acrossX, acrossZ(-3), acrossZ(0.1) });
  EXPECT_EQ(planes.of(1), nullptr);
  EXPECT_EQ(planes.of(5), nullptr);
  EXPECT_EQ(planes.of(0), planes.of(4));
  for (const auto& [triangle, axis, place] :
    { std::make_tuple(0u, 2, 0.1), std::make_tuple(2u, 0, 2.0), std::make_tuple(3u, 2, -3.0) })
  {
    ASSERT_NE(planes.of(triangle), nullptr);
    EXPECT_EQ(planes.of(triangle)->axis, axis);
    EXPECT_EQ(planes.of(triangle)->place, place);
  }
  EXPECT_TRUE(AxisPlanes({ oblique }).isEmpty());
}

TEST(AxisPlanes, HideWhatHardlyReachesBeyondThem)
{
  const auto box = [](double lower, double upper) {
    return Box{ { 0, 0, lower }, { 1, 1, upper } };
  };
  for (const double place : { 0.1, -0.1, 1e-30 })
  {
    const AxisPlanes planes({ acrossZ(place) });
    const float up = roundUp(place), down = roundDown(place);
    ASSERT_LT(down, up);
    const double above = std::nextafter(place, 1), below = std::nextafter(place, -1);
    EXPECT_FALSE(planes.hide(2, 1, up, box(-1, place)));
    EXPECT_TRUE(planes.hide(2, 1, up, box(-1, above)));
    EXPECT_TRUE(planes.hide(2, 1, up, box(-1, place + 0.49)));
    EXPECT_FALSE(planes.hide(2, 1, up, box(-1, place + 0.51))); // a wall that begins at the floor
    EXPECT_FALSE(planes.hide(2, 1, down, box(-1, above)));
    EXPECT_FALSE(planes.hide(1, 1, up, box(-1, above)));
    EXPECT_FALSE(planes.hide(2, -1, down, box(place, 1)));
    EXPECT_TRUE(planes.hide(2, -1, down, box(below, 1)));
    EXPECT_FALSE(planes.hide(2, -1, down, box(place - 0.51, 1)));
    EXPECT_FALSE(planes.hide(2, -1, up, box(below, 1)));
  }
  // What lies in a box that ends exactly at the plane does not lie beyond it.
  const AxisPlanes planes({ acrossZ(0.5) });
  EXPECT_FALSE(planes.hide(2, 1, 0.5F, box(0, 0.6)));
  EXPECT_FALSE(planes.hide(2, -1, 0.5F, box(0.4, 1)));
}

/// A floor and a ceiling whose heights are no floats; sheets as near to them as rounding to float
/// can hide; and walls that begin at the floor, cross it, lean or hang in oblique pieces.
Triangles nearPlanes(double floor)
{
  const auto patch = [](const Vector3& corner, const Vector3& along, const Vector3& across) {
    return Triangles{ { corner, corner + along, corner + across },
      { corner + along, corner + along + across, corner + across } };
  };
  Triangles triangles;
  for (int x = -3; x < 3; ++x)
  {
    for (int y = -3; y < 3; ++y)
    {
      const double u = x / 3.0, v = y / 3.0;
      test::append(triangles, patch({ u, v, floor }, { 1 / 3.0, 0, 0 }, { 0, 1 / 3.0, 0 }));
      test::append(triangles, patch({ u, v, 0.7 }, { 0, 1 / 3.0, 0 }, { 1 / 3.0, 0, 0 }));
    }
  }
  for (const double above :
    { -0x1p-28, -0x1p-52, 0x1p-30, 0x1p-28, 0x1p-26, 0x1p-25, 0x1p-24, 1e-3 })
  {
    const double at = 0.1 * std::log2(std::abs(above)) + 2;
    test::append(triangles, patch({ at, -0.9, floor + above }, { 0.05, 0, 0 }, { 0, 0.5, 0 }));
    test::append(triangles, patch({ at, 0, floor }, { 0, 0.2, 0 }, { 0, 0, 0.01 + above }));
    test::append(triangles, patch({ at, 0.3, floor - 0.1 }, { 0, 0.2, 0 }, { 0.01, 0.02, 0.2 }));
    test::append(
      triangles, patch({ at, 0.6, floor + above }, { 0.3, 0.1, 0.3 }, { 0, 0.2, above }));
  }
  return triangles;
}

// What is behind the plane of a triangle that a ray leaves is skipped, and nothing else is.
TEST(AxisPlanes, RaysThatLeaveThemHitWhatBruteForceHits)
{
  constexpr int kRays = 60000 / test::kFewer;
  test::RandomVectors random(17);
  int hits = 0, near = 0;
  for (const double floor : { -0.3, -1 / 3.0, 0.0, -0.25 })
  {
    const Triangles triangles = nearPlanes(floor);
    const NamedScene scene{ "", test::bodyOf(triangles),
      { { test::bodyOf(triangles), { random.rotation(), { 0.1, 0.2, 0.1 } } } } };
    std::vector<Ray> rays;
    std::vector<Hit> expected;
    for (int i = 0; i < kRays; ++i)
    {
      const auto object = static_cast<std::uint32_t>(i % 3 == 0 ? 1 : 0);
      const AffineMap place = object == 0 ? AffineMap{} : scene.objects[0].worldFromObject;
      const auto triangle = static_cast<std::uint32_t>(
        (0.5 + 0.5 * random.inCube()[0]) * 0.999 * static_cast<double>(triangles.size()));
      const Triangle& left = triangles[triangle];
      const double u = 0.5 + 0.499 * random.inCube()[0], v = 0.5 + 0.499 * random.inCube()[1];
      const Vector3 normal = left.areaVector().normalized();
      // From in the plane to far above it; mostly at the height from which walks start.
      constexpr double kHeights[] = { 0x1p-33, 0x1p-33, 0x1p-38, 0x1p-41, 0, -0x1p-33, 0x1p-26 };
      const Vector3 point =
        left.a + u * (left.b - left.a) + (1 - u) * v * (left.c - left.a) + kHeights[i % 7] * normal;
      Vector3 direction = random.direction();
      direction[2] *= random.powerOfTwo(-30, 0); // along the floor as well
      direction *= direction.dot(normal) < 0 && i % 5 != 0 ? -1 : 1;
      rays.push_back({ place(point), place.linear * direction, { object, triangle } });
      expected.push_back(test::bruteForce(scene, rays.back(), { true, true }));
      hits += expected.back() ? 1 : 0;
      near += expected.back() && expected.back().distance * direction.norm() < 1e-6 ? 1 : 0;
    }
    for (const SimdLevel level : test::simdLevels())
    {
      const test::SimdLimit limit(level);
      for (const TraversalMode mode : { TraversalMode::OneTree, TraversalMode::Parallel })
      {
        std::vector<Hit> found(rays.size());
        scene.scene(mode).cast(rays.data(), rays.size(), found.data());
        for (std::size_t i = 0; i < rays.size(); ++i)
        {
          ASSERT_EQ(found[i], expected[i]) << floor << ": " << test::exactly(rays[i]);
        }
      }
    }
  }
  EXPECT_GT(hits, kRays);
  EXPECT_GT(near, kRays / 1000);
}

#ifdef VTKIRRADIANCE_COUNT_QUERIES
TEST(AxisPlanes, TheWallThatARayLeavesIsNotSearched)
{
  const Triangles room = test::boxOfCells({ 0, 0, 0 }, { 4.1, 3.3, 2.7 }, { 12, 12, 12 });
  const NamedScene scene{ "", test::bodyOf(room), {} };
  const Scene made = scene.scene(TraversalMode::Parallel);
  test::RandomVectors random(5);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < room.size(); ++i)
  {
    const Vector3 center = (room[i].a + room[i].b + room[i].c) / 3;
    const Vector3 inwards = (Vector3(2.05, 1.65, 1.35) - center).normalized();
    const Vector3 normal = room[i].areaVector().normalized();
    rays.push_back({ center + 0x1p-32 * (normal.dot(inwards) > 0 ? normal : Vector3(-normal)),
      inwards + 0.1 * random.inCube(), { 0, i } });
  }
  const auto blocksOf = [&] {
    std::uint64_t blocks = 0;
    countedBlocks() = &blocks;
    std::vector<Hit> hits(rays.size());
    made.cast(rays.data(), rays.size(), hits.data());
    countedBlocks() = nullptr;
    return static_cast<double>(blocks) / static_cast<double>(rays.size());
  };
  const double known = blocksOf();
  for (Ray& ray : rays)
  {
    ray.start = {};
  }
  const double unknown = blocksOf();
  // Nothing is in the room, so a ray needs one leaf where it ends, and as many where it starts.
  EXPECT_LT(known, 0.8 * unknown);
}
#endif

}
}
