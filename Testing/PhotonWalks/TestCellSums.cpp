// SPDX-License-Identifier: BSD-3-Clause
#include "Tally/CellSums.h"

#include "Kit.h"

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

}
}
