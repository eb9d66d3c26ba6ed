// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkHistory.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}
}
