// SPDX-License-Identifier: BSD-3-Clause
#include "History/WalkHistory.h"
#include "ShotWalk.h"

#include <gtest/gtest.h>

namespace irradiance
{

// A part of the walks, as one of several processes has them.
TEST(WalkHistory, NeedNotBeginAtTheFirstBlock)
{
  const WalkPlan plan(5000, 20000, 3);
  const UnitFrame frame;
  constexpr std::size_t kFirst = 3;
  WalkHistory history(plan, frame, 1, Power{ { 1 } }, kFirst);
  for (int i = 0; i < 4; ++i)
  {
    history.append();
  }
  std::uint32_t next = plan.firstWalkOf(kFirst);
  for (std::size_t i = 0; i < history.size(); ++i)
  {
    EXPECT_EQ(history.block(i).firstWalk(), next);
    EXPECT_EQ(history.block(i).numberOfWalks(), plan.walksIn(kFirst + i));
    for (; next < history.block(i).endWalk(); ++next)
    {
      ASSERT_EQ(history.indexOf(next), i);
      ASSERT_EQ(&history.blockOf(next), &history.block(i));
    }
  }
  EXPECT_EQ(next, plan.firstWalkOf(kFirst + 4));
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
