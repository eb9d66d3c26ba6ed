// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkFront.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// Every column tells the number of the row, each in another way.
void write(WalkFront& front, std::size_t place, std::uint32_t number)
{
  double* const doubles[] = { &front.originX[place], &front.originY[place], &front.originZ[place],
    &front.distance[place] };
  float* const floats[] = { &front.directionX[place], &front.directionY[place],
    &front.directionZ[place], &front.weightB[place], &front.weightC[place] };
  std::uint32_t* const integers[] = { &front.start[place], &front.hit[place],
    &front.candidate[place], &front.walk[place], &front.bounce[place], &front.block[place],
    &front.slot[place], &front.parent[place] };
  std::uint8_t* const bytes[] = { &front.side[place], &front.hitSide[place],
    &front.isSpecular[place] };
  std::uint32_t column = 0;
  for (double* const value : doubles)
  {
    *value = number + 0.01 * ++column;
  }
  for (float* const value : floats)
  {
    *value = static_cast<float>(number + ++column);
  }
  for (std::uint32_t* const value : integers)
  {
    *value = 0x10000 * ++column + number;
  }
  for (std::uint8_t* const value : bytes)
  {
    *value = static_cast<std::uint8_t>(number + ++column);
  }
  for (int band = 0; front.bands > 1 && band < front.bands; ++band)
  {
    front.power[band][place] = (std::int64_t{ ++column } << 40) + number;
  }
}

void expectRow(WalkFront& front, std::size_t place, std::uint32_t number)
{
  WalkFront expected;
  expected.reserve(1, front.bands);
  write(expected, 0, number);
  ASSERT_EQ(front.originX[place], expected.originX[0]);
  ASSERT_EQ(front.originY[place], expected.originY[0]);
  ASSERT_EQ(front.originZ[place], expected.originZ[0]);
  ASSERT_EQ(front.directionX[place], expected.directionX[0]);
  ASSERT_EQ(front.directionY[place], expected.directionY[0]);
  ASSERT_EQ(front.directionZ[place], expected.directionZ[0]);
  ASSERT_EQ(front.start[place], expected.start[0]);
  ASSERT_EQ(front.side[place], expected.side[0]);
  ASSERT_EQ(front.distance[place], expected.distance[0]);
  ASSERT_EQ(front.hit[place], expected.hit[0]);
  ASSERT_EQ(front.weightB[place], expected.weightB[0]);
  ASSERT_EQ(front.weightC[place], expected.weightC[0]);
  ASSERT_EQ(front.hitSide[place], expected.hitSide[0]);
  ASSERT_EQ(front.candidate[place], expected.candidate[0]);
  ASSERT_EQ(front.walk[place], expected.walk[0]);
  ASSERT_EQ(front.bounce[place], expected.bounce[0]);
  ASSERT_EQ(front.block[place], expected.block[0]);
  ASSERT_EQ(front.slot[place], expected.slot[0]);
  ASSERT_EQ(front.parent[place], expected.parent[0]);
  ASSERT_EQ(front.isSpecular[place], expected.isSpecular[0]);
  for (int band = 0; front.bands > 1 && band < front.bands; ++band)
  {
    ASSERT_EQ(front.power[band][place], expected.power[band][0]);
  }
}

TEST(WalkFront, TakesWholeRowsBehindItsOwn)
{
  constexpr std::uint32_t kRows = 500;
  RandomVectors random(3);
  for (const int bands : { 1, 2, 3 })
  {
    WalkFront from, to;
    from.reserve(kRows, bands);
    from.size = kRows;
    for (std::uint32_t i = 0; i < kRows; ++i)
    {
      write(from, i, i);
    }
    std::vector<std::uint32_t> expected;
    for (int trial = 0; trial < 50; ++trial)
    {
      const std::size_t first = random.engine() % (kRows + 1);
      const std::size_t count = trial % 3 == 0 ? 0 : random.engine() % (kRows - first + 1);
      to.take(from, first, count);
      for (std::size_t i = first; i < first + count; ++i)
      {
        expected.push_back(static_cast<std::uint32_t>(i));
      }
      ASSERT_EQ(to.size, expected.size());
    }
    ASSERT_EQ(to.bands, bands);
    for (std::size_t i = 0; i < to.size; ++i)
    {
      ASSERT_NO_FATAL_FAILURE(expectRow(to, i, expected[i]));
    }
    to.pad(); // there is room
  }
}

}
}
