// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/TurnInFloat.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irradiance::test
{
namespace
{

// 2^24 angles, one in each step of 2^-24 turns, at another place in each.
TEST(TurnInFloat, AgreesWithTheLibraryToTheBound)
{
  long double worst = 0, worstLength = 0;
  for (std::uint32_t i = 0; i < 1u << 24; ++i)
  {
    const std::uint32_t turn = i << 8 | (i * 0x9e3779b9u) >> 24;
    const TurnInFloat found(turn);
    const long double angle = 2 * 3.141592653589793238462643383279502884L * 0x1p-32L * turn;
    worst = std::max(worst, std::abs(found.sine - std::sin(angle)));
    worst = std::max(worst, std::abs(found.cosine - std::cos(angle)));
    const long double s = found.sine, c = found.cosine;
    worstLength = std::max(worstLength, std::abs(s * s + c * c - 1));
  }
  EXPECT_LE(worst, 1.7e-7L); // 2^-22.5
  EXPECT_LE(worstLength, 2.4e-7L);
}

TEST(TurnInFloat, QuartersAreExact)
{
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
  {
    const TurnInFloat turn(quarter << 30);
    EXPECT_EQ(turn.sine, quarter % 2 == 0 ? 0 : 2 - static_cast<int>(quarter));
    EXPECT_EQ(turn.cosine, quarter % 2 == 1 ? 0 : quarter == 2 ? -1 : 1);
  }
}

// In the middle of an eighth the quarter changes.
TEST(TurnInFloat, TakesEveryEdge)
{
  for (std::uint32_t eighth = 0; eighth < 8; ++eighth)
  {
    for (std::uint32_t offset = 0xffffff00u; offset != 0x100; ++offset)
    {
      const std::uint32_t turn = (eighth << 29) + offset;
      const long double angle = 2 * 3.141592653589793238462643383279502884L * 0x1p-32L * turn;
      ASSERT_NEAR(TurnInFloat(turn).sine, static_cast<double>(std::sin(angle)), 1.7e-7);
      ASSERT_NEAR(TurnInFloat(turn).cosine, static_cast<double>(std::cos(angle)), 1.7e-7);
    }
  }
}

}
}
