// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"
#include "Tally/CellSums.h"
#include "Tally/PhotonCounts.h"

namespace irradiance::test
{
namespace
{

/// A static quad of 2 x 2 cells (8 triangles) and a box of 6 cells (12 triangles).
SceneObjects quadAndBox(int bands)
{
  ObjectBuilder quad(bands), block(bands);
  quad.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2, grey(0.5));
  block.addBox(box({ 0, 0, 0 }, { 1, 1, 1 }), 1, grey(0.5));
  return { quad.build(), { block.build() } };
}

void add(CellSums& sums, const TriangleId& id, bool isFront, const Power& power, int sign)
{
  std::vector<Deposit> deposits;
  sums.collect(sums.slotOf(0, sums.cellOf(id)), isFront, power, sign, deposits);
  sums.add(deposits);
}

TEST(CellSums, TrianglesOfACellShareASum)
{
  CellSums sums(quadAndBox(1));
  add(sums, { 0, 2 }, true, { { 5, 0, 0 } }, 1);
  add(sums, { 0, 3 }, false, { { 7, 0, 0 } }, 1);
  add(sums, { 1, 11 }, true, { { 1ll << 50, 0, 0 } }, 1);
  for (std::size_t cell = 0; cell < 4; ++cell)
  {
    EXPECT_EQ(sums.sum({ 0, cell }, 0), cell == 1 ? 12 : 0);
  }
  for (std::size_t cell = 0; cell < 6; ++cell)
  {
    EXPECT_EQ(sums.sum({ 1, cell }, 0), cell == 5 ? 1ll << 50 : 0);
  }
  add(sums, { 0, 3 }, false, { { 7, 0, 0 } }, -1);
  EXPECT_EQ(sums.sum({ 0, 1 }, 0), 5);
}

TEST(CellSums, SidesAndBandsStandApart)
{
  CellSums sums(quadAndBox(3));
  add(sums, { 1, 4 }, true, { { 1, 2, 3 } }, 1);
  add(sums, { 1, 5 }, false, { { 10, 20, 30 } }, 1);
  for (int band = 0; band < 3; ++band)
  {
    EXPECT_EQ(sums.sum({ 1, 2, 0 }, band), band + 1);
    EXPECT_EQ(sums.sum({ 1, 2, 1 }, band), 10 * (band + 1));
    EXPECT_EQ(sums.sum({ 1, 2 }, band), 11 * (band + 1)) << "both";
    EXPECT_EQ(sums.sum({ 1, 1, 1 }, band), 0);
    EXPECT_EQ(sums.sum({ 1, 3 }, band), 0);
  }
}

/// Of a quad, with a slot for each cell.
CellSums sumsOf(int cells)
{
  ObjectBuilder builder;
  builder.addQuad({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, cells, 1, grey(0.5));
  return CellSums({ builder.build(), {} }, {}, 1, {}, 1);
}

/// What each way of counting expects: of 64 cells, a table for many photons and a list for few.
constexpr std::size_t kExpected[] = { 1000, 1 };

TEST(PhotonCounts, CountsGoToTheirSums)
{
  for (const std::size_t expected : kExpected)
  {
    CellSums sums = sumsOf(64);
    for (int pass = 0; pass < 2; ++pass)
    {
      PhotonCounts counts(sums, std::int64_t{ 1 } << 40, expected);
      const std::uint32_t slots[] = { 3, 63, 3, 0, counts.escaped(), 3 };
      counts.add(slots, 6);
      counts.add(slots + 1, 1, -1);
      counts.add(slots + 4, 2, -1);
    }
    for (std::size_t cell = 0; cell < 64; ++cell)
    {
      const std::int64_t photons = cell == 3 ? 4 : cell == 0 ? 2 : 0;
      EXPECT_EQ(sums.sum({ { 0, cell } }, 0), photons << 40) << cell;
    }
  }
}

// A thread's table may be longer than the sums that come later: what escaped must not reach them.
TEST(PhotonCounts, TablesServeSumsOfEverySize)
{
  for (const int cells : { 100, 10, 1000, 10 })
  {
    CellSums sums = sumsOf(cells);
    {
      PhotonCounts counts(sums, 1, 10000);
      const std::uint32_t slots[] = { counts.escaped(), counts.escaped(), 1 };
      counts.add(slots, 3);
    }
    for (int cell = 0; cell < cells; ++cell)
    {
      EXPECT_EQ(sums.sum({ { 0, static_cast<std::size_t>(cell) } }, 0), cell == 1 ? 1 : 0);
    }
  }
}

// A thread has one table: who comes second keeps a list.
TEST(PhotonCounts, SeveralOfAThreadStandApart)
{
  CellSums sums = sumsOf(64), others = sumsOf(64);
  {
    PhotonCounts counts(sums, 2, 1000), otherCounts(others, 3, 1000);
    const std::uint32_t slot = 7;
    counts.add(&slot, 1);
    otherCounts.add(&slot, 1);
    counts.add(&slot, 1);
  }
  EXPECT_EQ(sums.sum({ { 0, 7 } }, 0), 4);
  EXPECT_EQ(others.sum({ { 0, 7 } }, 0), 3);
}

}
}
