// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/ArcTangent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace irradiance::test
{
namespace
{

// Angles evenly and, to both sides of each axis, down to 2^-60.
TEST(ArcTangent, AgreesWithTheLibraryToTheBound)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  long double worst = 0;
  for (int i = 0; i < 1000000; ++i)
  {
    const double angle = 3.141592653589793 * unit(random), tiny = std::exp2(-60 * unit(random));
    const double side = i % 4 < 2 ? 1 : -1;
    const double y = i % 2 ? std::sin(angle) : i % 3 ? tiny : 1;
    const double x = i % 2 ? std::cos(angle) : i % 3 ? side : side * tiny;
    const long double expected =
      std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    worst = std::max(worst, std::abs(arcTangent(y, x) / expected - 1));
  }
  EXPECT_LE(worst, 0x1p-51L);
}

TEST(ArcTangent, AxesAreExact)
{
  EXPECT_EQ(arcTangent(0, 1), 0);
  EXPECT_EQ(arcTangent(2, 0), M_PI / 2);
  EXPECT_EQ(arcTangent(0, -3), M_PI);
  EXPECT_EQ(arcTangent(1, 1), M_PI / 4);
  EXPECT_EQ(arcTangent(0, 0), 0);
}

}
}
