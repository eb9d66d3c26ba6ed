// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

// Another number of walks: those that both numbers have stay.

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kBlock = WalkPlan::kWalksPerBlock;

/// With a single source of walks.
SceneObjects someRoom(int bands, bool isMoving)
{
  SceneObjects objects{ litRoom(3, bands).build(), {} };
  if (isMoving)
  {
    objects.dynamicObjects.push_back(ball({ 2.4, 1.5, 1 }, 0.4, 4, grey(0.5), bands));
  }
  return objects;
}

/// Goes through numbers of walks; `shots`: how many of them are shot each time.
void expectShots(const SceneObjects& objects, const Shoot& settings,
  const std::vector<std::uint32_t>& numbers, const std::vector<std::uint32_t>& shots)
{
  Shoot now = settings;
  UpdatedEngine engine;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    now.numberOfWalks = numbers[i];
    engine.update(objects, now);
    EXPECT_EQ(engine.statistics().shotWalks, shots[i]) << numbers[i] << " walks";
    EXPECT_EQ(engine.statistics().invalidWalks, 0);
    EXPECT_TRUE(isShownAsFresh(engine)) << numbers[i] << " walks";
    expectBalance(engine);
  }
}

// Walks are stored in blocks; one that is not full is shot again.
TEST(NumberOfWalks, StoredWalksStay)
{
  for (const std::uint32_t replicates : { 1u, 3u })
  {
    expectShots(someRoom(1, true), Shoot(0).errors(replicates),
      { 2000, 4000, 2 * kBlock, 2 * kBlock + 1, 100, 3000 },
      { 2000, 4000 - kBlock, 0, 1, 100, 3000 });
  }
}

// Those that are not stored stay as well, but none of them can be taken back.
TEST(NumberOfWalks, GrowsWhereNothingIsStored)
{
  expectShots(
    someRoom(1, false), Shoot(0).errors(4), { 1000, 2000, 2001, 1500 }, { 1000, 1000, 1, 1500 });
}

// Powers of several bands are rounded to quanta, of which walks have others beyond a power of two.
TEST(NumberOfWalks, ColoursStayWhileQuantaDo)
{
  expectShots(someRoom(3, true), Shoot(0).bySide(), { 2100, 4000, 4200, 4096 + 2, 3000 },
    { 2100, 4000 - 2 * kBlock, 4200, 2, 3000 });
}

// Walks of later sources have numbers from the end of those before: they would change.
TEST(NumberOfWalks, SeveralSourcesStartAnew)
{
  const SceneObjects objects = underSky(MovingScene(1, true, 3).objects());
  UpdatedEngine engine(objects, Shoot(1500));
  ASSERT_GT(engine.walks().sets().size(), 1u);
  engine.update(objects, Shoot(3000));
  EXPECT_EQ(engine.statistics().shotWalks, engine.walks().numberOfShotWalks());
  EXPECT_TRUE(isAsFresh(engine));
}

// Walks that wait for their repair are of the old number: all start anew.
TEST(NumberOfWalks, NoneStaysStale)
{
  SceneObjects objects = someRoom(1, true);
  UpdatedEngine engine(objects, Shoot(3000));
  objects.dynamicObjects[0].worldFromObject.translation[0] += 0.5;
  engine.update(objects, Shoot(3000).budget(kNoTime));
  ASSERT_TRUE(engine.walks().hasStale());
  engine.update(objects, Shoot(5000).budget(kNoTime));
  EXPECT_FALSE(engine.walks().hasStale());
  EXPECT_TRUE(isAsFresh(engine));
}

}
}
