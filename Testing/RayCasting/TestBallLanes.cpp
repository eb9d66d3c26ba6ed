// SPDX-License-Identifier: BSD-3-Clause
#include "Kernels/BallLanes.h"

#include "RandomVectors.h"
#include "TestSimdLevels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace irradiance
{
namespace
{

using LongVector = Eigen::Matrix<long double, 3, 1>;

/// Of the ball's center from the half-line, in more digits than the lanes have.
long double distanceOf(const Ray& ray, const Vector3& center)
{
  const LongVector toCenter = center.cast<long double>() - ray.origin.cast<long double>();
  const LongVector direction = ray.direction.cast<long double>();
  const long double along = std::max(0.0L, toCenter.dot(direction) / direction.squaredNorm());
  return (toCenter - along * direction).norm();
}

/// The rays that pass, the same for each instruction set.
unsigned raysThatPass(const BallLanes& lanes, const Ball& ball)
{
  const unsigned found = passingOfPlain(lanes, ball);
  for (const SimdLevel level : test::simdLevels())
  {
    const test::SimdLimit limit(level);
    EXPECT_EQ(passingOf(lanes, ball), found) << "SIMD level " << static_cast<int>(level);
  }
  return found;
}

// Law: a ray that passes a ball is never taken for one that misses it.
TEST(BallLanes, FindTheRaysThatPass)
{
  test::RandomVectors random(23);
  int passing = 0, near = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double size = random.powerOfTwo(-60, 60), away = random.powerOfTwo(0, 12);
    const Vector3 center = size * away * random.inCube();
    BallLanes lanes;
    Ray rays[BallLanes::kSize];
    for (unsigned lane = 0; lane < BallLanes::kSize; ++lane)
    {
      // Aimed beside the center, by about a radius.
      const Vector3 origin = center + size * random.powerOfTwo(-1, 12) * random.direction();
      const double sign = lane % 4 == 3 ? -1 : 1;
      rays[lane] = { origin,
        sign * random.powerOfTwo(-20, 20) * (center + size * random.inCube() - origin), {} };
      lanes.set(lane, rays[lane]);
    }
    // Some touch the ball, so that rounding decides.
    const auto touched = static_cast<double>(distanceOf(rays[0], center));
    const double radius = i % 2 == 0 ? touched * (1 + 0x1p-50) : 0.5 * size;
    const unsigned found = raysThatPass(lanes, { center, radius * radius });
    for (unsigned lane = 0; lane < BallLanes::kSize; ++lane)
    {
      const long double distance = distanceOf(rays[lane], center);
      const bool isFound = (found >> lane & 1) != 0;
      passing += distance <= radius ? 1 : 0;
      near += std::abs(distance - radius) < 1e-12L * radius ? 1 : 0;
      // A ray is kept that passes within some 2^-24 of its origin's distance.
      const double reach = radius + 0x1p-23 * (rays[lane].origin - center).norm();
      wrong += (distance <= radius && !isFound) || (distance > reach && isFound) ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(passing, 40000);
  EXPECT_GT(near, 9000);
}

TEST(BallLanes, WhatIsNotKnownPasses)
{
  BallLanes lanes;
  const Ray ray{ { 0, 0, 0 }, { 1, 0, 0 }, {} };
  for (unsigned lane = 0; lane < BallLanes::kSize; ++lane)
  {
    lanes.set(lane, ray);
  }
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(raysThatPass(lanes, { { 0, 5, 0 }, 1 }), 0u);
  EXPECT_EQ(raysThatPass(lanes, { { kNaN, 5, 0 }, 1 }), 255u);
  EXPECT_EQ(raysThatPass(lanes, { { 0, 5, 0 }, kInfinity }), 255u);
  EXPECT_EQ(raysThatPass(lanes, { { 0, 5, 0 }, kNaN }), 255u);
}

}
}
