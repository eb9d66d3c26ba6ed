// SPDX-License-Identifier: BSD-3-Clause
#include "Light/Reflection.h"
#include "Light/Roulette.h"

#include "TestScenes.h"

#include <gtest/gtest.h>

namespace irradiance
{

namespace
{

constexpr int kGrid = 10000;

Material oneTriangle(const std::array<double, 3>& reflectance, int bands)
{
  test::ObjectBuilder builder(bands);
  builder.addCell({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } } }, { reflectance, {} });
  return builder.material();
}

}

TEST(Reflection, RoundsToTheNearestQuantum)
{
  const Material material = oneTriangle({ 0.5, 0.25, 1.0 }, 3);
  EXPECT_EQ(reflected({ { 100, 100, 100 } }, material, 0), (Power{ { 50, 25, 100 } }));
  EXPECT_EQ(reflected({ { 1001, 1003, 7 } }, material, 0), (Power{ { 501, 251, 7 } }));
  EXPECT_EQ(reflected({ { 9, 9, 9 } }, oneTriangle({ 1, 1, 1 }, 1), 0), (Power{ { 9, 0, 0 } }));
  EXPECT_TRUE(reflected({ { 9, 9, 9 } }, oneTriangle({ 0, 0, 0 }, 3), 0).isZero());
}

// The mean over a grid of u is the power, up to one grid step of the threshold.
TEST(Reflection, RouletteIsUnbiased)
{
  const std::int64_t threshold = 1000000;
  for (const std::int64_t power : { 1ll, 17ll, 123456ll, 500000ll, 999999ll })
  {
    double sum = 0;
    for (int i = 0; i < kGrid; ++i)
    {
      const Power after = playRoulette({ { power, 0, 0 } }, threshold, (i + 0.5) / kGrid);
      ASSERT_TRUE(after.isZero() || after == (Power{ { threshold, 0, 0 } }));
      sum += static_cast<double>(after[0]);
    }
    EXPECT_NEAR(sum / kGrid, static_cast<double>(power), 0.5001 * threshold / kGrid);
  }
}

TEST(Reflection, BandsKeepTheirRatios)
{
  const Power power{ { 1234567, 654321, 7 } };
  const std::int64_t threshold = 987654321012;
  const Power after = playRoulette(power, threshold, 1e-9);
  ASSERT_EQ(after.largest(), threshold);
  for (int band = 0; band < 3; ++band)
  {
    const long double exact = static_cast<long double>(power[band]) * threshold / power[0];
    EXPECT_LE(std::abs(static_cast<double>(after[band] - exact)), 0.5) << band;
  }
  EXPECT_TRUE(playRoulette(power, threshold, 0.5).isZero());
}

TEST(Reflection, StrongWalksAreLeftAlone)
{
  const Power power{ { 5, 1000, 3 } };
  EXPECT_EQ(playRoulette(power, 1000, 0.999999), power);
  EXPECT_EQ(playRoulette(power, 0, 0.5), power);
  EXPECT_TRUE(playRoulette({}, 1000, 1e-10).isZero());
}

}
