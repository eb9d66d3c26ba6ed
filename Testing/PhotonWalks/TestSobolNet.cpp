// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SobolNet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace irradiance::test
{
namespace
{

/// How many binary digits after the point two numbers in [0, 1) share from the first on.
int sharedDigits(double u, double v)
{
  int digits = 0;
  while (
    digits < 20 && std::floor(std::ldexp(u, digits + 1)) == std::floor(std::ldexp(v, digits + 1)))
  {
    ++digits;
  }
  return digits;
}

/// Scrambling keeps how many leading digits two points share. The points are those of Joe and Kuo's
/// page, in the order of Gray's code; the fourth coordinate follows from their direction numbers 1,
/// 3, 1, 5.
TEST(SobolNet, HasThePointsOfJoeAndKuo)
{
  const std::vector<SobolNet::Point> published = { { 0, 0, 0, 0 }, { 0.5, 0.5, 0.5, 0.5 },
    { 0.75, 0.25, 0.25, 0.25 }, { 0.25, 0.75, 0.75, 0.75 }, { 0.375, 0.375, 0.625, 0.875 },
    { 0.875, 0.875, 0.125, 0.375 }, { 0.625, 0.125, 0.875, 0.625 }, { 0.125, 0.625, 0.375, 0.125 },
    { 0.1875, 0.3125, 0.9375, 0.4375 }, { 0.6875, 0.8125, 0.4375, 0.9375 } };
  const auto gray = [](std::uint32_t i) { return i ^ i >> 1; };
  for (std::uint64_t seed = 0; seed < 8; ++seed)
  {
    const SobolNet net(splitMix(seed));
    for (std::uint32_t i = 0; i < published.size(); ++i)
    {
      for (std::uint32_t j = 0; j < i; ++j)
      {
        const SobolNet::Point a = net.inUnitCube(gray(i)), b = net.inUnitCube(gray(j));
        for (std::size_t k = 0; k < a.size(); ++k)
        {
          EXPECT_EQ(sharedDigits(a[k], b[k]), sharedDigits(published[i][k], published[j][k]))
            << "points " << i << " and " << j << ", coordinate " << k;
        }
      }
    }
  }
}

/// In each coordinate 2^m points that follow each other stand in all of 2^m strata, wherever they
/// begin.
TEST(SobolNet, FillsTheStrataOfEachCoordinate)
{
  for (std::uint64_t seed = 0; seed < 4; ++seed)
  {
    const SobolNet net(splitMix(seed));
    for (const std::uint32_t size : { 64u, 1024u, 65536u })
    {
      for (std::size_t k = 0; k < 4; ++k)
      {
        std::vector<bool> strata(size, false);
        for (std::uint32_t i = 0; i < size; ++i)
        {
          strata[static_cast<std::size_t>(net.inUnitCube(3 * size + i)[k] * size)] = true;
        }
        EXPECT_TRUE(std::all_of(strata.begin(), strata.end(), [](bool is) { return is; }))
          << size << " points, coordinate " << k;
      }
    }
  }
}

/// It is a (3, m, 4)-net: of 2048 points each of 4 x 4 x 4 x 4 boxes has 8.
TEST(SobolNet, FillsAllFourDimensionsTogether)
{
  for (std::uint64_t seed = 0; seed < 16; ++seed)
  {
    const SobolNet net(splitMix(seed));
    std::vector<int> counts(256, 0);
    for (std::uint32_t i = 0; i < 2048; ++i)
    {
      std::size_t box = 0;
      for (const double u : net.inUnitCube(2048 * static_cast<std::uint32_t>(seed) + i))
      {
        ASSERT_GT(u, 0);
        ASSERT_LT(u, 1);
        box = 4 * box + static_cast<std::size_t>(4 * u);
      }
      ++counts[box];
    }
    EXPECT_EQ(counts, std::vector<int>(256, 8));
  }
}

/// Of 4096 seeds, the first point's coordinates are even and independent: the mean of each and of
/// each product is off by more than 5 standard errors in one run of 170,000.
TEST(SobolNet, IsScrambledEvenly)
{
  constexpr int kSeeds = 4096;
  std::array<double, 4> sums{};
  double products = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
  {
    const SobolNet::Point point = SobolNet(splitMix(seed)).inUnitCube(0);
    for (std::size_t k = 0; k < 4; ++k)
    {
      sums[k] += point[k] - 0.5;
    }
    products += (point[0] - 0.5) * (point[1] - 0.5) + (point[2] - 0.5) * (point[3] - 0.5);
  }
  for (const double sum : sums)
  {
    EXPECT_LT(std::abs(sum), 5 * std::sqrt(kSeeds / 12.0));
  }
  EXPECT_LT(std::abs(products), 5 * std::sqrt(2 * kSeeds / 144.0));
}

}
}
