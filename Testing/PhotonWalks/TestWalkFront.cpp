// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkFront.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

/// All columns of a row but for its power.
auto columnsOf(WalkFront& front, std::size_t i)
{
  return std::tie(front.originX[i], front.originY[i], front.originZ[i], front.directionX[i],
    front.directionY[i], front.directionZ[i], front.start[i], front.side[i], front.distance[i],
    front.hit[i], front.weightB[i], front.weightC[i], front.hitSide[i], front.candidate[i],
    front.walk[i], front.bounce[i], front.block[i], front.slot[i], front.parent[i],
    front.isSpecular[i]);
}

int bandsOfPower(const WalkFront& front)
{
  return front.bands > 1 ? front.bands : 0;
}

/// Every column tells the number of the row, each in another way.
void write(WalkFront& front, std::size_t place, std::uint32_t number)
{
  std::uint32_t column = 0;
  const auto set = [&](auto& value) {
    value = static_cast<std::decay_t<decltype(value)>>(number + 1000 * ++column);
  };
  std::apply([&](auto&... values) { (set(values), ...); }, columnsOf(front, place));
  for (int band = 0; band < bandsOfPower(front); ++band)
  {
    front.power[band][place] = (std::int64_t{ ++column } << 40) + number;
  }
}

void expectRow(WalkFront& front, std::size_t place, std::uint32_t number)
{
  WalkFront expected;
  expected.reserve(1, front.bands);
  write(expected, 0, number);
  ASSERT_TRUE(columnsOf(front, place) == columnsOf(expected, 0)) << "row " << place;
  ASSERT_EQ(front.powerAt(place, bandsOfPower(front)), expected.powerAt(0, bandsOfPower(front)));
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
