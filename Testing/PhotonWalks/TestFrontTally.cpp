// SPDX-License-Identifier: BSD-3-Clause
// Law: what is taken back leaves no trace.

#include "FrontWorld.h"
#include "Kit.h"

namespace irradiance::test
{
namespace
{

struct TallyKind
{
  int bands;
  bool isGlossy;
  WalkPlan plan;
};

std::vector<TallyKind> someTallies()
{
  return { { 1, false, WalkPlan(6000, 6000, 1) }, { 1, false, WalkPlan(6000, 6000, 16) },
    { 1, true, WalkPlan(700, 6000, 3, 500) }, // several rounds
    { 3, true, WalkPlan(6000, 6000, 16) }, { 3, false, WalkPlan(1500, 6000, 2) } };
}

/// As a history would store them: all segments of all walks, and from where on each walk is to be
/// removed.
class Shot
{
public:
  explicit Shot(const FrontWorld& world)
    : world_(world)
    , sums_(world.objects(), world.plan(), world.plan().rounds().size())
  {
    FrontTally tally = world.tallyFor(sums_, balance_, 100000);
    world.shoot(1000, tally, {}, [&](const WalkFront& front) { all_.take(front, 0, front.size); });
  }

  const CellSums& sums() const { return sums_; }
  const PowerBalance& balance() const { return balance_; }
  const WalkFront& all() const { return all_; }
  std::uint32_t firstWalk() const { return world_.plan().rounds().front().firstWalk; }

  Power carriedBy(std::size_t row) const
  {
    return all_.bands == 1 ? world_.stages().powerPerWalk() : all_.powerAt(row, all_.bands);
  }

private:
  const FrontWorld& world_;
  CellSums sums_;
  PowerBalance balance_;
  WalkFront all_;
};

/// Some rows of what was shot, in any order: of each walk those from a bounce on.
struct Tails
{
  WalkFront segments; ///< all
  WalkFront others;   ///< but for the first ones
  Power starting;

  /// `isWhole`: all of all walks.
  Tails(const Shot& shot, bool isWhole, unsigned seed)
  {
    RandomVectors random(seed);
    const WalkFront& all = shot.all();
    std::vector<std::uint32_t> firsts(2 * all.size);
    for (std::uint32_t& first : firsts)
    {
      first = isWhole ? 0 : static_cast<std::uint32_t>(random.engine() % 6);
    }
    std::vector<std::size_t> rows(all.size);
    std::iota(rows.begin(), rows.end(), std::size_t{ 0 });
    std::shuffle(rows.begin(), rows.end(), random.engine);
    segments.reserve(1, all.bands);
    others.reserve(1, all.bands);
    isTaken.resize(all.size);
    for (const std::size_t row : rows)
    {
      const std::uint32_t first = firsts[all.walk[row] - shot.firstWalk()];
      isTaken[row] = all.bounce[row] >= first;
      if (isTaken[row])
      {
        segments.take(all, row, 1);
      }
      if (all.bounce[row] > first)
      {
        others.take(all, row, 1);
      }
      if (all.bounce[row] == first)
      {
        starting += shot.carriedBy(row);
      }
    }
  }

  std::vector<bool> isTaken; ///< by row
};

void expectEqual(const PowerBalance& balance, const PowerBalance& expected)
{
  EXPECT_EQ(balance.emitted, expected.emitted);
  EXPECT_EQ(balance.absorbed, expected.absorbed);
  EXPECT_EQ(balance.escaped, expected.escaped);
  EXPECT_EQ(balance.segments, expected.segments);
  EXPECT_EQ(balance.received, expected.received);
}

/// Calls test(world, shot, expected) for each kind, and each way to count photons.
template <class Test>
void onAllFronts(const Test& test)
{
  for (const TallyKind& kind : someTallies())
  {
    const MovingScene scene(kind.bands, false, 2, kind.isGlossy);
    const FrontWorld world(scene.objects(), kind.plan, 1);
    const Shot shot(world);
    for (const std::size_t expected : { std::size_t{ 1 }, std::size_t{ 1000000 } })
    {
      test(world, shot, expected);
    }
  }
}

TEST(FrontTally, WhatStaysIsWhatTheOtherSegmentsBrought)
{
  for (const bool isWhole : { false, true })
  {
    onAllFronts([isWhole](const FrontWorld& world, const Shot& shot, std::size_t expected) {
      const std::size_t rounds = world.plan().rounds().size();
      CellSums sums(world.objects(), world.plan(), rounds),
        others(world.objects(), world.plan(), rounds);
      sums.add(shot.sums(), {});
      PowerBalance balance = shot.balance();
      const WalkFront& all = shot.all();
      const Tails tails(shot, isWhole, 2);
      {
        FrontTally tally = world.tallyFor(sums, balance, expected);
        tally.remove(tails.segments, tails.starting);
      }
      std::vector<Deposit> deposits;
      Power escaped;
      double received = 0;
      for (std::size_t row = 0; row < all.size; ++row)
      {
        const Power carried = shot.carriedBy(row);
        if (!tails.isTaken[row] && all.hit[row] == WalkFront::kNone)
        {
          escaped += carried;
        }
        else if (!tails.isTaken[row])
        {
          const SceneCell cell = others.cellOf(world.triangles().idOf(all.hit[row]));
          const bool isFront = all.hitSide[row] != 0;
          others.collect(others.slotOf(all.walk[row], cell), isFront, carried, 1, deposits);
          received += carried.total();
        }
      }
      others.add(deposits);
      test::expectEqual(sums, others);
      EXPECT_EQ(balance.escaped, escaped);
      EXPECT_EQ(balance.received, received);
      EXPECT_EQ(balance.segments, static_cast<std::int64_t>(all.size - tails.segments.size));
      Power arrived = balance.absorbed; // and the rest is under way
      arrived += balance.escaped;
      arrived += tails.starting;
      EXPECT_EQ(balance.emitted, arrived);
      if (isWhole)
      {
        EXPECT_EQ(tails.starting, shot.balance().emitted);
        world.tallyFor(sums, balance, expected).unemit(tails.starting);
        expectEqual(balance, {});
      }
    });
  }
}

// Removed and shot again, each in one tally, as a repair does that finds the same walks again.
TEST(FrontTally, TailsThatComeBackRestoreAll)
{
  onAllFronts([](const FrontWorld& world, const Shot& shot, std::size_t expected) {
    CellSums sums(world.objects(), world.plan(), world.plan().rounds().size());
    sums.add(shot.sums(), {});
    PowerBalance balance = shot.balance();
    for (unsigned seed = 3; seed < 6; ++seed)
    {
      const Tails tails(shot, false, seed);
      FrontTally tally = world.tallyFor(sums, balance, expected);
      tally.remove(tails.segments, tails.starting);
      tally.receive(tails.segments);
      tally.release(tails.others);
    }
    test::expectEqual(sums, shot.sums());
    expectEqual(balance, shot.balance());
  });
}

/// What one side of an object receives in all, over what it received before; nothing if it did not.
void addRatio(const CellSums& sumsBefore, const CellSums& sumsNow, std::uint32_t object, int side,
  ReplicateMean& ratio)
{
  double before = 0, now = 0;
  for (std::size_t cell = 0; cell < sumsBefore.numbers().sizeOf(object); ++cell)
  {
    for (int band = 0; band < sumsBefore.bands(); ++band)
    {
      before += sumsBefore.sum({ { object, cell }, side }, band);
      now += sumsNow.sum({ { object, cell }, side }, band);
    }
  }
  if (before > 0)
  {
    ratio.add(now / before);
  }
}

// Both draw the same samples, so that most walks go the same way but for roundings to float. What
// all cells of an object receive on a side differs by chance alone: over 16 seeds, at most 14
// sides, |t| > 5 of 15 degrees in one of 450 choices of seeds for a kind.
TEST(FrontWorld, BringsWhatWalkBatchBrings)
{
  constexpr int kSeeds = 16;
  const WalkPlan plan(scaled(12000), scaled(12000), 1);
  for (const auto& [bands, isClosed, isGlossy] : { std::tuple(1, true, false), { 1, false, false },
         { 1, true, true }, { 1, false, true }, { 3, true, false }, { 3, false, true } })
  {
    const MovingScene scene(bands, isClosed, 2, isGlossy);
    std::vector<ReplicateMean> ratios(2 * scene.objects().size()); // by object and side
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    {
      UpdatedEngine engine(scene.objects(), Shoot(plan.most()).seeded(seed));
      const FrontWorld world(scene.objects(), plan, seed);
      const Shot shot(world);
      for (std::uint32_t part = 0; part < ratios.size(); ++part)
      {
        addRatio(engine.sums(), shot.sums(), part / 2, static_cast<int>(part % 2), ratios[part]);
      }
    }
    for (const ReplicateMean& ratio : ratios)
    {
      if (ratio.count() == kSeeds)
      {
        EXPECT_LE(std::abs(ratio.t(1)), 5);
        EXPECT_NEAR(ratio.mean(), 1, kIsSanitized ? 0.02 : 0.001);
      }
    }
  }
}

// A point light alone, and nothing around it.
TEST(FrontWorld, AllLightEscapesFromNothing)
{
  ObjectBuilder builder;
  builder.addPointLight({ 1, 2, 3 }, 5);
  builder.material().numberOfCells = 1;
  builder.material().reflectance.push_back(0.5);
  SceneObjects objects{ builder.build(), {} };
  objects.staticObject.emission = std::make_shared<Emission>(builder.emission());
  const FrontWorld world(objects, WalkPlan(1000, 1000, 1), 1);
  const PowerBalance balance = Shot(world).balance();
  EXPECT_EQ(balance.segments, 1000);
  EXPECT_EQ(balance.emitted, balance.escaped);
  EXPECT_EQ(balance.emitted, 1000 * world.stages().powerPerWalk());
}

// Law: the rays that walks were shot with are found again, bit for bit, from what a history stores,
// whatever stands beside them in a front.

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
void onAllRays(const Test& test)
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
  onAllRays([](const FrontWorld& world, const WalkFront& rows) {
    const std::vector<std::size_t> chosen = someRows(rows, true);
    WalkFront front;
    front.reserve(chosen.size(), world.stages().bands());
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
  onAllRays([](const FrontWorld& world, const WalkFront& rows) {
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
