// SPDX-License-Identifier: BSD-3-Clause
// Functions of our own beside those of the library, in long double.

#include "Sampling/ElementaryFunctions.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance::test
{
namespace
{

constexpr long double kTwoPi = 2 * 3.141592653589793238462643383279502884L;

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

TEST(PowUnit, IsWithinItsErrorOfTheLibrarysLongDouble)
{
  RandomVectors random(11);
  for (int trial = 0; trial < 300000; ++trial)
  {
    const double base = trial % 3 == 0 ? 1 - random.powerOfTwo(-50, -1)
                                       : std::abs(random.uniform()) * random.powerOfTwo(-32, 0);
    const double exponent = std::abs(random.uniform()) * random.powerOfTwo(-40, 20);
    if (base <= 0)
    {
      continue;
    }
    const long double exact = std::pow(static_cast<long double>(base), exponent);
    const double power = powUnit(base, exponent);
    if (exact < 0x1p-995L)
    {
      ASSERT_LE(power, 0x1p-990);
      continue;
    }
    ASSERT_LE(std::abs(power - exact), 0x1p-50L * exact * (1 - std::log(exact)))
      << base << " to the power of " << exponent;
  }
}

TEST(PowUnit, EndsAreExact)
{
  EXPECT_EQ(powUnit(1, 0), 1);
  EXPECT_EQ(powUnit(1, 1e300), 1);
  EXPECT_EQ(powUnit(0x1p-33, 0), 1);
  EXPECT_EQ(powUnit(0.5, 1e6), 0);
}

TEST(SinCos, AgreesWithTheLibraryToTheBound)
{
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i)
  {
    // Samples are multiples of 2^-33.
    const double turns = static_cast<double>(random() >> 31) * 0x1p-33;
    const SinCos turn(turns);
    const long double angle = kTwoPi * turns;
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

// 2^24 angles, one in each step of 2^-24 turns, at another place in each.
TEST(TurnInFloat, AgreesWithTheLibraryToTheBound)
{
  long double worst = 0, worstLength = 0;
  for (std::uint32_t i = 0; i < 1u << 24; ++i)
  {
    const std::uint32_t turn = i << 8 | (i * 0x9e3779b9u) >> 24;
    const TurnInFloat found(turn);
    const long double angle = kTwoPi * 0x1p-32L * turn;
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
      const long double angle = kTwoPi * 0x1p-32L * turn;
      ASSERT_NEAR(TurnInFloat(turn).sine, static_cast<double>(std::sin(angle)), 1.7e-7);
      ASSERT_NEAR(TurnInFloat(turn).cosine, static_cast<double>(std::cos(angle)), 1.7e-7);
    }
  }
}

}
}
