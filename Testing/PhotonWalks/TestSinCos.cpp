// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/ElementaryFunctions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace irradiance::test
{
namespace
{

TEST(SinCos, AgreesWithTheLibraryToTheBound)
{
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i)
  {
    // Samples are multiples of 2^-33.
    const double turns = static_cast<double>(random() >> 31) * 0x1p-33;
    const SinCos turn(turns);
    const long double angle = 2 * 3.141592653589793238462643383279502884L * turns;
    worst = std::max(worst, static_cast<double>(std::abs(turn.sine - std::sin(angle))));
    worst = std::max(worst, static_cast<double>(std::abs(turn.cosine - std::cos(angle))));
  }
  EXPECT_LE(worst, 0x1p-51);
}

TEST(SinCos, QuartersAreExact)
{
  for (int quarter = 0; quarter <= 4; ++quarter)
  {
    const SinCos turn(0.25 * quarter);
    EXPECT_EQ(turn.sine, quarter % 2 == 0 ? 0 : 2 - quarter);
    EXPECT_EQ(turn.cosine, quarter % 2 == 1 ? 0 : quarter == 2 ? -1 : 1);
  }
}

}
}
