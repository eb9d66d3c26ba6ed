// SPDX-License-Identifier: BSD-3-Clause
// Walks after a motion: which walks were shot again, which are stale, and what is as in a
// new filter.

#include "ErrorObserver.h"
#include "ShownWalks.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <functional>

using namespace ShownWalks;

// Every walk that touches the moved object, before or after, and no other.
TEST(PhotonWalks, SayWhichWereRepaired)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  Walks before = UpdatedWalks(filter);
  EXPECT_TRUE(RepairedOf(before).empty()) << "all were shot for the first time";
  for (const int moved : { 0, 1, 0 })
  {
    SCOPED_TRACE(moved);
    Ids expected = Touching(filter, 1, moved);
    scene.Moving[static_cast<std::size_t>(moved)].Pose->Translate(0.2, -0.1, 0.15);
    const Walks after = UpdatedWalks(filter);
    EXPECT_EQ(RepairedOf(after).size(), Field(filter.Light, "NumberOfInvalidWalks"));
    double segments = 0;
    for (const auto& [id, walk] : after)
    {
      SCOPED_TRACE(id);
      const auto news = std::count(walk.IsNew.begin(), walk.IsNew.end(), true);
      const auto kept = walk.IsNew.size() - static_cast<std::size_t>(news);
      EXPECT_EQ(walk.Repaired, news > 0);
      EXPECT_TRUE(std::is_sorted(walk.IsNew.begin(), walk.IsNew.end())) << "a tail";
      ASSERT_GE(before.at(id).Points.size(), kept);
      EXPECT_TRUE(
        std::equal(walk.Points.begin(), walk.Points.end() - news, before.at(id).Points.begin()));
      EXPECT_TRUE(walk.Repaired || walk.Points == before.at(id).Points);
      segments += static_cast<double>(news);
    }
    EXPECT_EQ(segments, Field(filter.Light, "NumberOfRepairedSegments"));
    const Ids now = Touching(filter, 1, moved);
    expected.insert(now.begin(), now.end());
    EXPECT_EQ(RepairedOf(after), expected);
    EXPECT_GT(expected.size(), 50u);
    EXPECT_LT(expected.size(), static_cast<std::size_t>(NumberOfWalks) / 2);
    before = after;
  }
}

TEST(PhotonWalks, SayWhichAThingTouchedThatCameOrLeft)
{
  const Scene scene = MakeSmallScene();
  const Mesh ball = Copy(scene.Moving[0].Model);
  const auto filter = MakeShowing(scene);
  filter.Update();
  const Ids touching = Touching(filter, 1, 0);
  EXPECT_GT(touching.size(), 50u);
  for (const bool leaves : { true, false, true })
  {
    scene.Moving[0].Model->ShallowCopy(leaves ? Mesh::New() : ball);
    const Walks after = UpdatedWalks(filter);
    EXPECT_FALSE(HasShot(filter));
    EXPECT_EQ(RepairedOf(after), touching);
    EXPECT_EQ(Touching(filter, 1, 0), leaves ? Ids() : touching);
  }
}

TEST(PhotonWalks, KeepTheMarksWhileNothingMoves)
{
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter.Update();
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const Ids repaired = RepairedOf(UpdatedWalks(filter));
  filter.Shown->SetNumberOfWalks(NumberOfWalks / 2);
  Ids half = RepairedOf(UpdatedWalks(filter));
  EXPECT_EQ(half, Ids(repaired.begin(), repaired.lower_bound(NumberOfWalks / 2)));
  EXPECT_FALSE(half.empty());
  filter.Shown->SetNumberOfWalks(0);
  filter.Update();
  EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfPoints(), 0);
  filter.Shown->SetNumberOfWalks(All);
  EXPECT_EQ(RepairedOf(UpdatedWalks(filter)), repaired);
  filter->SetSeed(2);
  EXPECT_TRUE(RepairedOf(UpdatedWalks(filter)).empty());
  EXPECT_TRUE(HasShot(filter));
}

TEST(PhotonWalks, OfAStaticSceneAreShotOnce)
{
  Scene scene = MakeSmallScene();
  scene.Moving.clear();
  const auto filter = MakeShowing(scene, 100);
  filter->Update();
  const vtkMTimeType time = filter.Time();
  filter.Update();
  EXPECT_GT(filter.Time(), time) << "they were not stored";
  EXPECT_TRUE(HasShot(filter));
  EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfCells(), 100);
  const vtkMTimeType stored = filter.Time();
  filter.Shown->SetNumberOfWalks(20);
  filter.Shown->SetCell(4);
  filter.Update();
  EXPECT_EQ(filter.Shown->GetOutput()->GetNumberOfCells(), 20);
  EXPECT_EQ(filter.Time(), stored);
}

TEST(PhotonWalks, SayWhichAreStale)
{
  constexpr double noTime = 1e-9; // s; over when it begins
  const Scene scene = MakeSmallScene();
  const auto filter = MakeShowing(scene);
  filter->SetRepairTimeBudget(noTime);
  EXPECT_TRUE(IdsOf(UpdatedWalks(filter)).size() == static_cast<std::size_t>(NumberOfWalks));
  EXPECT_TRUE(filter.Shown->GetOutput()->GetCellData()->HasArray("Stale"));
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const auto full = MakeShowing(scene);
  full->SetRepairTimeBudget(10);
  scene.Moving[0].Pose->Translate(-0.2, 0, 0);
  full.Update();
  scene.Moving[0].Pose->Translate(0.2, 0, 0);
  const Ids expected = RepairedOf(UpdatedWalks(full));
  Ids repaired;
  std::size_t left = expected.size();
  for (int calls = 0; left > 0; ++calls)
  {
    filter->Modified();
    const Walks walks = UpdatedWalks(filter);
    Ids waiting = expected;
    const Ids now = RepairedOf(walks);
    EXPECT_GT(now.size(), 0u);
    repaired.insert(now.begin(), now.end());
    std::size_t stale = 0;
    double power = 0;
    for (const auto& [id, walk] : walks)
    {
      EXPECT_EQ(walk.Stale, expected.count(id) > 0 && repaired.count(id) == 0) << id;
      stale += walk.Stale;
      power += walk.Stale ? walk.Power[0] : 0;
    }
    EXPECT_NEAR(
      power, Field(filter.Light, "StalePower"), 1e-9 * Field(filter.Light, "EmittedPower"));
    ASSERT_LT(stale, left) << "call " << calls;
    left = stale;
    filter->SetRepairTimeBudget(calls < 3 ? noTime : 10);
  }
  EXPECT_EQ(repaired, expected);
  EXPECT_TRUE(IsSame(LastingBits(filter.Shown->GetOutput()), LastingBits(full.Shown->GetOutput())));
}
