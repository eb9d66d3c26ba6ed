// SPDX-License-Identifier: BSD-3-Clause
#include "FrontWorld.h"
#include "Kit.h"

// Law: what is taken back leaves no trace.

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
    return all_.bands == 1 ? world_.sampler().powerPerWalk() : all_.powerAt(row, all_.bands);
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

TEST(FrontTally, WalksThatAreRemovedLeaveNoTrace)
{
  onAllFronts([](const FrontWorld& world, const Shot& shot, std::size_t expected) {
    CellSums sums(world.objects(), world.plan(), world.plan().rounds().size());
    const CellSums none(world.objects(), world.plan(), world.plan().rounds().size());
    sums.add(shot.sums(), {});
    PowerBalance balance = shot.balance();
    const Tails all(shot, true, 1);
    ASSERT_EQ(all.starting, balance.emitted);
    {
      FrontTally tally = world.tallyFor(sums, balance, expected);
      tally.remove(all.segments, all.starting);
    }
    test::expectEqual(sums, none);
    PowerBalance left;
    left.emitted = shot.balance().emitted;
    expectEqual(balance, left);
    world.tallyFor(sums, balance, expected).unemit(all.starting);
    expectEqual(balance, {});
  });
}

TEST(FrontTally, WhatStaysIsWhatTheOtherSegmentsBrought)
{
  onAllFronts([](const FrontWorld& world, const Shot& shot, std::size_t expected) {
    const std::size_t rounds = world.plan().rounds().size();
    CellSums sums(world.objects(), world.plan(), rounds),
      others(world.objects(), world.plan(), rounds);
    sums.add(shot.sums(), {});
    PowerBalance balance = shot.balance();
    const WalkFront& all = shot.all();
    const Tails tails(shot, false, 2);
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
  });
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
  EXPECT_EQ(balance.emitted, 1000 * world.sampler().powerPerWalk());
}

}
}
