// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SobolPoint.h"
#include "Surfaces/CellLook.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace irradiance::test
{
namespace
{

void expectSameDecisions(double reflectance, std::uint32_t sample)
{
  const CellLook look(5, reflectance, false);
  // Around the sample, and around where the decision changes.
  const auto turns = static_cast<std::uint32_t>(std::llrint(0x1p32 * reflectance));
  for (std::uint32_t offset = 0xfffffffcu; offset != 4; ++offset)
  {
    for (const std::uint32_t c : { sample + offset, turns + offset, look.threshold + offset })
    {
      ASSERT_EQ(look.survives(c), SobolPoint::toUnit(c) < reflectance)
        << std::hexfloat << reflectance << ' ' << c;
    }
  }
}

TEST(CellLook, DecidesAsDoublesDo)
{
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000000; ++i)
  {
    const auto sample = static_cast<std::uint32_t>(random());
    const double uniform = std::uniform_real_distribution<double>()(random);
    expectSameDecisions(uniform, sample);
    // A multiple of 2^-33, or next to one: thresholds lie there.
    const double tie = static_cast<double>(random() >> 31) * 0x1p-33;
    expectSameDecisions(tie, sample);
    expectSameDecisions(std::nextafter(tie, 2.0), sample);
    expectSameDecisions(std::nextafter(tie, -1.0), sample);
    expectSameDecisions(std::ldexp(uniform, -static_cast<int>(random() % 80)), sample);
    expectSameDecisions(1 - std::ldexp(uniform, -static_cast<int>(random() % 54)), sample);
  }
  for (const double extreme : { 0.0, -0.0, 1.0, 0x1p-33, 0x1p-34, 0x1p-1074, 1 - 0x1p-53,
         1 - 0x1p-33, 1 - 0x1p-34, 1.0 + 0x1p-52 })
  {
    expectSameDecisions(extreme, 0);
  }
}

TEST(CellLook, KeepsNumberAndKind)
{
  const CellLook white(CellLook::kNumber, 1, true), black(7, 0, false);
  EXPECT_EQ(white.number(), CellLook::kNumber);
  EXPECT_TRUE(white.isGlossy());
  EXPECT_TRUE(white.survives(0xffffffffu));
  EXPECT_EQ(black.number(), 7u);
  EXPECT_FALSE(black.isGlossy());
  EXPECT_FALSE(black.survives(0));
}

}
}
