// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

// Parts of the static object that come and go; the laws are in TestLaws.

namespace irradiance::test
{
namespace
{

constexpr std::uint32_t kGone = KeptParts::kNone;

SceneObject part(double x)
{
  return block({ x, 0, 0 }, { 0.1, 0.1, 0.1 }, 1);
}

/// By part of before, its place among those of now.
std::vector<std::uint32_t> placesOf(
  const std::vector<SceneObject>& before, const std::vector<SceneObject>& now)
{
  constexpr std::uint32_t kTriangles = 12, kCells = 6; // of a part
  const KeptParts kept = keptParts({ merged(now), {} }, { merged(before), {} });
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const std::uint32_t first = kept.triangles[kTriangles * i];
    places.push_back(first == kGone ? kGone : first / kTriangles);
    for (std::uint32_t k = 0; k < kTriangles; ++k)
    {
      EXPECT_EQ(kept.triangles[kTriangles * i + k], first == kGone ? kGone : first + k);
      EXPECT_EQ(kept.staticCells[kCells * i + k / 2], first == kGone ? kGone : (first + k) / 2);
    }
  }
  const auto gone = std::count(places.begin(), places.end(), kGone);
  EXPECT_EQ(kept.added.size(), now.size() - before.size() + static_cast<std::size_t>(gone));
  return places;
}

TEST(KeptParts, AreThoseThatAreEqualInOrder)
{
  using Places = std::vector<std::uint32_t>;
  SceneObject painted = part(1);
  RandomVectors random(1);
  paint(painted, random);
  EXPECT_EQ(placesOf({ part(0), part(1) }, { part(0), part(1), part(2) }), (Places{ 0, 1 }));
  EXPECT_EQ(placesOf({ part(0), part(1), part(2) }, { part(1), part(2) }), (Places{ kGone, 0, 1 }));
  EXPECT_EQ(placesOf({ part(0), part(1) }, { part(3), part(0), part(4) }), (Places{ 1, kGone }));
  EXPECT_EQ(placesOf({ part(0), part(1) }, { part(0), painted, part(2) }), (Places{ 0, kGone }));
  EXPECT_EQ(placesOf({ part(0), part(1) }, { part(1), part(0) }), (Places{ 1, kGone }));
}

/// Of the segments, those that an update shot again; none of the walks started anew.
double partShot(const IrradianceEngine& engine)
{
  EXPECT_EQ(engine.statistics().shotWalks, 0);
  EXPECT_TRUE(isShownAsFresh(engine));
  return static_cast<double>(engine.statistics().repairedSegments) /
    static_cast<double>(engine.balance().segments);
}

// What is shot again is what hit a part that went, or that a part that came is in the way of. Of
// light that is all around, a ball of a hundredth of the area gets about as much.
TEST(KeptParts, OnlyWhatMetAPartIsShotAgain)
{
  const SceneObject room = litRoom(4).build(), ball = test::ball({ 2.4, 1.5, 1 }, 0.2, 6),
                    other = block({ 3, 3, 0.3 }, { 0.2, 0.2, 0.2 }, 1);
  SceneObjects objects{ merged({ room, other }), { block({ 1, 3, 1 }, { 0.2, 0.2, 0.2 }, 1) } };
  const Shoot settings(scaled(6000));
  UpdatedEngine engine(objects, settings);
  for (const auto& parts : { std::vector{ room, other, ball }, std::vector{ room, ball },
         std::vector{ room, other, ball }, std::vector{ room, other } })
  {
    objects.staticObject = merged(parts);
    engine.update(objects, settings);
    EXPECT_GT(engine.statistics().invalidWalks, 0);
    EXPECT_LT(partShot(engine), 0.1);
  }
  objects.dynamicObjects.push_back(ball); // as it was, but it may move
  engine.update(objects, settings);
  EXPECT_LT(partShot(engine), 0.1);
  objects.dynamicObjects.pop_back();
  engine.update(objects, settings);
  EXPECT_LT(partShot(engine), 0.1);
}

// Lights are known by the numbers of their cells, which a part before them changes.
TEST(KeptParts, APartBeforeALampIsAFreshStart)
{
  const SceneObject room = litRoom(4).build(), other = block({ 3, 3, 0.3 }, { 0.2, 0.2, 0.2 }, 1);
  SceneObjects objects{ merged({ other, room }), { block({ 1, 3, 1 }, { 0.2, 0.2, 0.2 }, 1) } };
  UpdatedEngine engine(objects, Shoot(1000));
  objects.staticObject = merged({ room });
  engine.update(objects, Shoot(1000));
  EXPECT_EQ(engine.statistics().shotWalks, 1000);
  EXPECT_TRUE(isShownAsFresh(engine));
}

}
}
