// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/FrontStages.h"

#include "RandomVectors.h"
#include "TestFronts.h"
#include "TestRays.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

// Attacks the test of rays against many balls, in floats: it may find too many pairs, never too
// few.

namespace irradiance
{
namespace
{

using test::exactly;
using test::RandomVectors;

struct Balls
{
  std::vector<Vector3> centers;
  std::vector<double> squaredRadii;
  double extent; ///< of all

  std::size_t size() const { return centers.size(); }
};

/// In a cube at some place, of some size; from as large as the cube down to points.
Balls someBalls(RandomVectors& random, std::size_t count)
{
  Balls balls{ {}, {}, random.powerOfTwo(-60, 60) };
  const Vector3 middle = balls.extent * random.powerOfTwo(-4, 10) * random.inCube();
  for (std::size_t i = 0; i < count; ++i)
  {
    const double radius = i % 5 == 0 ? 0.0 : balls.extent * random.powerOfTwo(-20, 0);
    balls.centers.push_back(middle + balls.extent * random.inCube());
    balls.squaredRadii.push_back(radius * radius);
  }
  return balls;
}

/// Rays as columns, with directions in floats or in doubles.
struct Columns
{
  std::array<std::vector<double>, 3> origin, exact;
  std::array<std::vector<float>, 3> direction;
  std::uint32_t count;

  explicit Columns(const std::vector<Ray>& rays)
    : count(static_cast<std::uint32_t>(rays.size()))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis].resize(TreeRays::roomFor(count), std::numeric_limits<double>::quiet_NaN());
      exact[axis].resize(origin[axis].size());
      direction[axis].resize(origin[axis].size());
      for (std::size_t i = 0; i < rays.size(); ++i)
      {
        origin[axis][i] = rays[i].origin[axis];
        exact[axis][i] = rays[i].direction[axis];
        direction[axis][i] = static_cast<float>(rays[i].direction[axis]);
      }
    }
  }

  TreeRays rays(bool isExact) const
  {
    TreeRays all{};
    all.count = count;
    for (int axis = 0; axis < 3; ++axis)
    {
      all.origin[axis] = origin[axis].data();
      all.direction[axis] = isExact ? nullptr : direction[axis].data();
      all.exactDirection[axis] = isExact ? exact[axis].data() : nullptr;
    }
    return all;
  }
};

using Pairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// Of rays and balls; no pair may be found twice.
Pairs pairsOf(const TreeRays& rays, const BodyBalls& balls)
{
  std::vector<NearRays> found(
    std::size_t{ TreeRays::roomFor(rays.count) } / NearRays::kLeastLanes * balls.size());
  found.resize(frontStages().findNear(rays, balls, found.data()));
  Pairs pairs;
  for (const NearRays& near : found)
  {
    for (unsigned lane = 0; lane < 16; ++lane)
    {
      if ((near.lanes >> lane & 1) != 0)
      {
        EXPECT_TRUE(pairs.insert({ near.first + lane, near.body }).second);
      }
    }
  }
  return pairs;
}

/// Calls check(found) with what is found at each SIMD level.
template <class Check>
void forEachLevel(const Columns& columns, const Balls& balls, bool isExact, const Check& check)
{
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    check(pairsOf(columns.rays(isExact), { balls.centers, balls.squaredRadii }));
  }
}

/// A ray that comes as close as `distance` to a place, from near or far, forwards or backwards.
Ray rayBeside(RandomVectors& random, const Vector3& place, double distance, double extent)
{
  Ray ray = test::asInFront({ place, random.direction(), {} });
  const Vector3 across = ray.direction.cross(random.direction()).normalized();
  const double before = random.uniform() * extent * random.powerOfTwo(-10, 11);
  ray.origin = place + distance * across - before * ray.direction;
  return ray;
}

TEST(BodyBalls, NoneIsMissedThatARayTouches)
{
  constexpr unsigned kSeed = 61;
  RandomVectors random(kSeed);
  for (int scene = 0; scene < 200; ++scene)
  {
    const Balls balls = someBalls(random, 17 + random.engine() % 100);
    const double length = scene % 2 == 0 ? 1 : random.powerOfTwo(-80, 80);
    std::vector<Ray> rays;
    for (std::size_t ball = 0; ball < balls.size(); ++ball)
    {
      // All but a tangent; so far off that doubles do not tell here.
      const double radius = std::sqrt(balls.squaredRadii[ball]);
      const double inner = std::max(0.0, radius - 0x1p-36 * balls.extent);
      rays.push_back(rayBeside(random, balls.centers[ball], inner, balls.extent));
      rays.back().direction *= length;
    }
    forEachLevel(Columns(rays), balls, length != 1, [&](const Pairs& pairs) {
      for (std::uint32_t i = 0; i < rays.size(); ++i)
      {
        EXPECT_EQ(pairs.count({ i, i }), 1u) << "scene " << scene << ", " << exactly(rays[i]);
      }
    });
  }
}

TEST(BodyBalls, NoneIsFoundFromWhichARayIsClear)
{
  constexpr double kClear = 0x1p-5; // of the extent, which is at least a quarter of the unit
  constexpr unsigned kSeed = 62;
  RandomVectors random(kSeed);
  for (int scene = 0; scene < 100; ++scene)
  {
    const Balls balls = someBalls(random, 40);
    std::vector<Ray> rays;
    for (std::size_t ball = 0; ball < balls.size(); ++ball)
    {
      const double away = std::sqrt(balls.squaredRadii[ball]) + kClear * balls.extent;
      rays.push_back(rayBeside(random, balls.centers[ball], away, balls.extent));
    }
    forEachLevel(Columns(rays), balls, scene % 2 == 1, [&](const Pairs& pairs) {
      for (std::uint32_t i = 0; i < rays.size(); ++i)
      {
        EXPECT_EQ(pairs.count({ i, i }), 0u) << "scene " << scene << ", " << exactly(rays[i]);
      }
    });
  }
}

// Where floats, or doubles, tell nothing, everything is near.
TEST(BodyBalls, AllAreNearWhereNumbersFail)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Balls balls{ { { 1, 2, 3 }, { 1, 2, 4 } }, { 1e-6, 1e-6 }, 1 };
  const Columns fails({ { { 1e30, 0, 0 }, { 0, 1, 0 }, {} }, { { none, 0, 0 }, { 0, 1, 0 }, {} },
    { { 0, 0, 0 }, { 0, none, 0 }, {} }, { { 0, 0, 0 }, { 0, 0, 0 }, {} },
    { { 0, 0, 0 }, { 0, 1e200, 0 }, {} }, { { 0, 0, 0 }, { 0, 1e-200, 0 }, {} } });
  forEachLevel(
    fails, balls, true, [&](const Pairs& pairs) { EXPECT_EQ(pairs.size(), 2 * fails.count); });

  const Balls endless{ { { 1, 2, 3 }, { none, 0, 0 }, { 0, 0, 0 } }, { 1, 1, kInfinity }, 1 };
  const Columns away({ { { 0, 0, 0 }, { 1, 0, 0 }, {} } });
  for (const bool isExact : { false, true })
  {
    forEachLevel(away, endless, isExact, [](const Pairs& pairs) {
      EXPECT_EQ(pairs, (Pairs{ { 0, 1 }, { 0, 2 } }));
    });
  }
}

}
}
