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
    FrontTally tally = tallyFor(sums_, balance_, 100000);
    world.shoot(firstWalk(), world.plan().endWalk(), 1000, tally, {},
      [&](const WalkFront& front) { all_.take(front, 0, front.size); });
  }

  const CellSums& sums() const { return sums_; }
  const PowerBalance& balance() const { return balance_; }
  const WalkFront& all() const { return all_; }
  std::uint32_t firstWalk() const { return world_.plan().rounds().front().firstWalk; }

  FrontTally tallyFor(CellSums& sums, PowerBalance& balance, std::size_t expected) const
  {
    return FrontTally(world_.triangles(), sums, balance, world_.stages().powerPerWalk(), expected);
  }
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
      FrontTally tally = shot.tallyFor(sums, balance, expected);
      tally.remove(all.segments, all.starting);
    }
    test::expectEqual(sums, none);
    PowerBalance left;
    left.emitted = shot.balance().emitted;
    expectEqual(balance, left);
    shot.tallyFor(sums, balance, expected).unemit(all.starting);
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
      FrontTally tally = shot.tallyFor(sums, balance, expected);
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
      FrontTally tally = shot.tallyFor(sums, balance, expected);
      tally.remove(tails.segments, tails.starting);
      tally.receive(tails.segments);
      tally.release(tails.others);
    }
    test::expectEqual(sums, shot.sums());
    expectEqual(balance, shot.balance());
  });
}

}
}
