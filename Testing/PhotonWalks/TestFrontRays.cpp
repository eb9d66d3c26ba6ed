// SPDX-License-Identifier: BSD-3-Clause
#include "FrontWorld.h"
#include "Kit.h"

// Law: the rays that walks were shot with are found again, bit for bit, from what a history stores,
// whatever stands beside them in a front.

namespace irradiance::test
{
namespace
{

/// Each front before its rays were cast, one after the other.
WalkFront shotRows(const FrontWorld& world)
{
  WalkFront rows;
  CellSums sums(world.objects(), world.plan());
  PowerBalance balance;
  FrontTally tally = world.tallyFor(sums, balance, world.plan().most());
  world.shoot(1000, tally, [&](const WalkFront& front) { rows.take(front, 0, front.size); });
  return rows;
}

void clearRay(WalkFront& front, std::size_t i)
{
  front.originX[i] = front.originY[i] = front.originZ[i] = -1;
  front.directionX[i] = front.directionY[i] = front.directionZ[i] = -1;
}

auto rayOf(const WalkFront& front, std::size_t i)
{
  return std::tuple(front.walk[i], front.bounce[i], front.start[i], front.side[i], front.weightB[i],
    front.weightC[i], front.originX[i], front.originY[i], front.originZ[i], front.directionX[i],
    front.directionY[i], front.directionZ[i]);
}

/// Rows in an order that mixes walks and bounces, some of them not at all.
std::vector<std::size_t> someRows(const WalkFront& rows, bool areFirst)
{
  RandomVectors random(17);
  std::vector<std::size_t> chosen;
  for (std::size_t row = 0; row < rows.size; ++row)
  {
    if ((rows.bounce[row] == 0) == areFirst && random.engine() % 8 != 0)
    {
      chosen.push_back(row);
    }
  }
  std::shuffle(chosen.begin(), chosen.end(), random.engine);
  return chosen;
}

/// Specular walks leave as they came: from the segment before.
void setArrivals(WalkFront& front, const WalkFront& rows)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> rowOf;
  for (std::size_t row = 0; row < rows.size; ++row)
  {
    rowOf[{ rows.walk[row], rows.bounce[row] }] = row;
  }
  for (std::size_t i = 0; i < front.size; ++i)
  {
    const std::size_t before = rowOf.at({ front.walk[i], front.bounce[i] - 1 });
    front.originX[i] = rows.originX[before];
    front.originY[i] = rows.originY[before];
    front.originZ[i] = rows.originZ[before];
  }
}

/// Calls test(world, rows) on each instruction set for several scenes.
template <class Test>
void onAll(const Test& test)
{
  const std::uint32_t walks = scaled(10000);
  for (const std::uint32_t replicates : { 1u, 16u })
  {
    for (int kind = 0; kind < 3; ++kind)
    {
      const MovingScene scene(kind == 1 ? 3 : 1, kind == 0, 2, kind == 2);
      const FrontWorld world(scene.objects(), WalkPlan(walks, walks, replicates, 300), 1);
      const WalkFront rows = shotRows(world);
      for (const SimdLevel level : simdLevels())
      {
        const SimdLimit limit(level);
        test(world, rows);
      }
    }
  }
}

// Of areas and of a point in the air.
TEST(FrontRays, FirstRaysAreFoundAgainForAnyListOfWalks)
{
  onAll([](const FrontWorld& world, const WalkFront& rows) {
    const std::vector<std::size_t> chosen = someRows(rows, true);
    WalkFront front;
    front.reserve(chosen.size(), world.sampler().bands());
    front.size = chosen.size();
    std::size_t inAir = 0;
    for (std::size_t i = 0; i < front.size; ++i)
    {
      front.walk[i] = rows.walk[chosen[i]];
      clearRay(front, i);
      inAir += rows.start[chosen[i]] == WalkFront::kNone ? 1 : 0;
    }
    EXPECT_GT(inAir, 0u);
    EXPECT_LT(inAir, front.size);
    world.stages().start(front);
    for (std::size_t i = 0; i < front.size; ++i)
    {
      ASSERT_TRUE(rayOf(front, i) == rayOf(rows, chosen[i])) << "row " << chosen[i];
      ASSERT_EQ(front.parent[i], WalkFront::kNone);
      if (front.bands > 1)
      {
        ASSERT_EQ(front.powerAt(i, front.bands), world.lights().power(front.candidate[i]));
      }
    }
  });
}

TEST(FrontRays, LaterRaysAreFoundAgainWhateverTheirBounces)
{
  onAll([](const FrontWorld& world, const WalkFront& rows) {
    const std::vector<std::size_t> chosen = someRows(rows, false);
    WalkFront front;
    for (const std::size_t row : chosen)
    {
      front.take(rows, row, 1);
      clearRay(front, front.size - 1);
    }
    if (world.triangles().hasGlossy())
    {
      setArrivals(front, rows);
    }
    world.stages().leave(front);
    for (std::size_t i = 0; i < front.size; ++i)
    {
      ASSERT_TRUE(rayOf(front, i) == rayOf(rows, chosen[i])) << "row " << chosen[i];
    }
  });
}

}
}
