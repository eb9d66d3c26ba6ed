// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkHistory.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace irradiance
{

// A part of the walks, as one of several ranks has them: each walk has one place on one rank.
TEST(WalkHistory, RanksShareTheBlocksOfAPlan)
{
  const WalkPlan plan(5000, 20000, 3);
  const UnitFrame frame;
  constexpr std::size_t kRanks = 3;
  std::vector<int> isStored(plan.most(), 0);
  for (std::size_t rank = 0; rank < kRanks; ++rank)
  {
    const DealtBlocks dealt(rank, kRanks);
    WalkHistory history(plan, frame, 1, Power{ { 1 } }, dealt);
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
        ASSERT_EQ(&history.blockOf(walk), &history.block(i));
        ++isStored[walk];
      }
    }
  }
  EXPECT_EQ(std::count(isStored.begin(), isStored.end(), 1), 20000);
}

TEST(WalkHistory, PhotonsOfATail)
{
  const UnitFrame frame;
  WalkHistory history(WalkPlan(10, 10, 1), frame, 1, Power{ { 7 } });
  history.append();
  std::vector<test::WalkSegment> walk(4);
  for (std::uint32_t i = 0; i < 3; ++i) // the last one escapes
  {
    walk[i].ray = { Vector3::Zero(), Vector3::UnitZ(), {} };
    walk[i].hit = { 1, { 0, 10 + i }, { 0.25F, 0.5F } };
    walk[i].isFront = i != 1;
  }
  walk[3].ray = { Vector3::Zero(), Vector3::UnitZ(), {} };
  test::replaceTail(history.block(0), { 5, 0 }, walk, frame);
  std::vector<Photon> photons;
  history.forEachPhotonFrom({ 5, 1 }, [&](const Photon& photon) { photons.push_back(photon); });
  ASSERT_EQ(photons.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i)
  {
    EXPECT_EQ(photons[i].reference, (SegmentRef{ 5, i + 1 }));
    EXPECT_EQ(photons[i].id.triangle, 11 + i);
    EXPECT_EQ(photons[i].isFront, i != 0);
    EXPECT_EQ(history.power(photons[i].reference)[0], 7);
  }
}

}
