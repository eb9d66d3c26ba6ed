// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkHistory.h"
#include "Sampling/WalkPlan.h"
#include "ShotWalk.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace irradiance::test
{
namespace
{

std::shared_ptr<BlockArena> arena()
{
  return std::make_shared<BlockArena>(BounceBlock::pageBytes(1));
}

/// A history of ten walks, one of which has three hits and escapes.
WalkHistory smallHistory(const TriangleNumbers& numbers, std::uint32_t object)
{
  WalkHistory history(WalkPlan(10, 10, 1), PointGrid(), numbers, 1, Power{ { 7 } }, arena());
  history.append();
  std::vector<WalkSegment> walk(4);
  for (std::uint32_t i = 0; i < 4; ++i)
  {
    walk[i].ray = { Vector3::Zero(), Vector3::UnitZ(), {} };
    walk[i].hit = i < 3 ? Hit{ 1, { object, 10 + i }, { 0.25F, 0.5F } } : Hit{};
    walk[i].isFront = i != 1;
  }
  storeWalk(history, 5, walk);
  return history;
}

// A part of the walks, as one of several ranks has them: each walk has one place on one rank.
TEST(WalkHistory, RanksShareTheBlocksOfAPlan)
{
  const WalkPlan plan(5000, 20000, 3);
  constexpr std::size_t kRanks = 3;
  std::vector<int> isStored(plan.most(), 0);
  for (std::size_t rank = 0; rank < kRanks; ++rank)
  {
    const DealtBlocks dealt(rank, kRanks);
    WalkHistory history(plan, PointGrid(), TriangleNumbers(), 1, Power{ { 1 } }, arena(), dealt);
    while (history.size() < dealt.before(plan.rounds().back().endBlock))
    {
      history.append();
    }
    for (std::size_t i = 0; i < history.size(); ++i)
    {
      EXPECT_EQ(history.block(i).firstWalk(), plan.firstWalkOf(dealt[i]));
      for (std::uint32_t walk = history.block(i).firstWalk(); walk < history.block(i).endWalk();
           ++walk)
      {
        ASSERT_EQ(history.indexOf(walk), i);
        ++isStored[walk];
      }
    }
  }
  EXPECT_EQ(std::count(isStored.begin(), isStored.end(), 1), 20000);
}

TEST(WalkHistory, PhotonsOfATail)
{
  const WalkHistory history = smallHistory(TriangleNumbers({ 20 }), 0);
  std::vector<Photon> photons;
  const SegmentRef first{ 5, 1 };
  history.forEachPhotonFrom(
    history.placeOf(first), first, [&](const Photon& photon) { photons.push_back(photon); });
  ASSERT_EQ(photons.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(photons[i].reference, (SegmentRef{ 5, i + 1 }));
    EXPECT_EQ(photons[i].id.triangle, 11 + i);
    EXPECT_EQ(photons[i].isFront, i != 0);
    EXPECT_EQ(history.power(photons[i].reference)[0], 7);
  }
}

// An object that nothing has hit comes back with more triangles: those after it have other numbers.
TEST(WalkHistory, HitsStayWhereTrianglesAreNumberedAnew)
{
  WalkHistory history = smallHistory(TriangleNumbers({ 4, 3, 20 }), 2);
  history.renumber(TriangleNumbers({ 4, 8, 20 }));
  for (std::uint32_t bounce = 0; bounce < 3; ++bounce)
  {
    EXPECT_EQ(history.hit(SegmentRef{ 5, bounce }).id, (TriangleId{ 2, 10 + bounce }));
    EXPECT_EQ(history.block(0).triangle(history.placeOf({ 5, bounce }).slot), 22 + bounce);
  }
  EXPECT_FALSE(history.hit(SegmentRef{ 5, 3 }));
}

TEST(WalkPlan, RoundsDoubleUpToTheLimit)
{
  const WalkPlan plan(3000, 20000, 16);
  std::vector<std::uint32_t> ends;
  for (const WalkRound& round : plan.rounds())
  {
    EXPECT_EQ(round.firstWalk, ends.empty() ? 0 : ends.back());
    ends.push_back(round.endWalk);
  }
  EXPECT_EQ(ends, (std::vector<std::uint32_t>{ 3000, 6000, 12000, 20000 }));
  EXPECT_EQ(WalkPlan(3000, 3000, 1).rounds().size(), 1u);
  EXPECT_EQ(WalkPlan(3000, 24000, 1).rounds().size(), 4u);
}

// Walk numbers go up to the largest of 32 bits.
TEST(WalkPlan, NothingOverflowsAtTheLargestNumbers)
{
  const WalkPlan plan(1, 4294967295u, 16);
  EXPECT_EQ(plan.rounds().size(), 33u);
  EXPECT_EQ(plan.most(), 4294967295u);
  EXPECT_EQ(plan.roundOf(4294967294u), 32u);
  const std::size_t last = plan.rounds().back().endBlock - 1;
  EXPECT_EQ(plan.firstWalkOf(last) + (plan.walksIn(last) - 1), 4294967294u);
  EXPECT_EQ(WalkPlan().rounds().size(), 1u);
}

TEST(WalkPlan, EveryWalkHasOnePlaceInABlockOfItsRound)
{
  for (const std::uint32_t first : { 1u, 1000u, 1024u, 1025u, 5000u })
  {
    const WalkPlan plan(first, 30011, 3);
    std::uint32_t next = 0;
    for (std::size_t block = 0; block < plan.rounds().back().endBlock; ++block)
    {
      EXPECT_EQ(plan.firstWalkOf(block), next);
      ASSERT_GE(plan.walksIn(block), 1u);
      ASSERT_LE(plan.walksIn(block), WalkPlan::kWalksPerBlock);
      for (std::uint32_t i = 0; i < plan.walksIn(block); ++i, ++next)
      {
        ASSERT_EQ(plan.blockOf(next), block);
        const WalkRound& round = plan.rounds()[plan.roundOf(next)];
        ASSERT_TRUE(round.firstBlock <= block && block < round.endBlock);
        ASSERT_TRUE(round.firstWalk <= next && next < round.endWalk);
      }
    }
    EXPECT_EQ(next, 30011u);
  }
}

// The same walks under other numbers.
TEST(WalkPlan, NumbersMayBeginAnywhere)
{
  constexpr std::uint32_t kFirst = 12345;
  const WalkPlan plan(3000, 20000, 16), later(3000, 20000, 16, kFirst);
  EXPECT_EQ(later.most(), 20000u);
  EXPECT_EQ(later.walksAfter(2), 6000u);
  EXPECT_EQ(later.endWalk(), kFirst + 20000);
  EXPECT_FALSE(later == plan);
  ASSERT_EQ(later.rounds().back().endBlock, plan.rounds().back().endBlock);
  for (std::uint32_t walk = 0; walk < 20000; ++walk)
  {
    ASSERT_EQ(later.blockOf(kFirst + walk), plan.blockOf(walk));
    ASSERT_EQ(later.roundOf(kFirst + walk), plan.roundOf(walk));
    ASSERT_EQ(later.replicates().replicateOf(kFirst + walk), plan.replicates().replicateOf(walk));
    ASSERT_EQ(later.replicates().numberWithin(kFirst + walk), plan.replicates().numberWithin(walk));
  }
}

// Each replicate takes the numbers 0, 1, 2, ... of its own sequence, for any total.
TEST(WalkPlan, WalksAreAssignedInTurn)
{
  const Replicates replicates(7);
  std::vector<std::uint32_t> assigned(7, 0);
  for (std::uint32_t walk = 0; walk < 1000; ++walk)
  {
    const std::uint32_t replicate = replicates.replicateOf(walk);
    EXPECT_EQ(replicates.numberWithin(walk), assigned[replicate]++);
    for (std::uint32_t i = 0; i < 7; ++i)
    {
      ASSERT_EQ(replicates.share(i, walk + 1), assigned[i]);
    }
  }
}

}
}
