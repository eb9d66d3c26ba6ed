// SPDX-License-Identifier: BSD-3-Clause
// Walks to look at where direct light is gathered.

#include "Kit.h"
#include "Views/WalkPaths.h"

namespace irradiance::test
{
namespace
{

constexpr std::size_t kAllWalks = 1000000; // more than any test shoots

EngineSettings pathSettings(std::uint32_t walks)
{
  EngineSettings settings = Shoot(walks).gathered().kept();
  settings.listRepaired = true;
  return settings;
}

std::int64_t bornIn(const WalkSet& set)
{
  std::int64_t born = 0;
  for (std::size_t i = 0; i < set.history().size(); ++i)
  {
    const BounceBlock& block = set.history().block(i);
    for (std::uint32_t walk = block.firstWalk(); walk < block.endWalk(); ++walk)
    {
      born += block.begin(walk) != BounceBlock::kNone ? 1 : 0;
    }
  }
  return born;
}

/// Whether a point lies on a light: the panel or the point light of the scene.
bool isOnLight(const Vector3& point)
{
  const bool isOnPanel =
    std::abs(point[2] - 3.75) < 1e-6 && (point - Vector3(1.5, 1.5, 3.75)).norm() < 0.71;
  return isOnPanel || (point - Vector3(3, 1, 2)).norm() < 1e-9;
}

// All walks that are born, of lights and parts of the scene alike; each goes from its light to
// where it starts, nothing stands between, and on over its hits.
TEST(FinalGatherPaths, BeginOnTheLight)
{
  const MovingScene scene(3, true, 34, true);
  const SceneObjects& objects = scene.objects();
  Execution serial;
  UpdatedEngine engine(objects, pathSettings(5000), serial);
  ASSERT_EQ(engine.walks().sets().size(), 1 + objects.dynamicObjects.size());
  std::int64_t born = 0, bornAtDynamic = 0;
  for (const WalkSet& set : engine.walks().sets())
  {
    EXPECT_TRUE(set.source().isDynamic() || bornIn(set) > 20);
    bornAtDynamic += set.source().isDynamic() ? bornIn(set) : 0;
    born += bornIn(set);
  }
  EXPECT_GT(bornAtDynamic, 50);
  const WalkPaths paths(engine);
  const std::vector<std::uint32_t> all = paths.first(kAllWalks);
  ASSERT_EQ(static_cast<std::int64_t>(all.size()), born);
  Power power;
  std::size_t segments = 0;
  for (const WalkPath& path : paths.paths(all, serial))
  {
    ASSERT_GE(path.points.size(), 3u) << "walk " << path.walk;
    EXPECT_TRUE(isOnLight(path.points[0])) << path.points[0].transpose();
    const Vector3 along = path.points[1] - path.points[0];
    const Hit hit = engine.scene().cast({ path.points[0] + 1e-6 * along, along, {} });
    EXPECT_NEAR(hit.distance, 1, 1e-4) << "walk " << path.walk;
    EXPECT_EQ(path.firstRepaired, path.points.size());
    power += path.power;
    segments += path.points.size() - 2;
  }
  EXPECT_EQ(static_cast<std::int64_t>(segments), engine.balance().segments);
  // As many quanta as all walks of these numbers, but for what is rounded.
  EXPECT_NEAR(static_cast<double>(power.total()) /
      (static_cast<double>(engine.walks().quantaPerWalk()) * static_cast<double>(born)),
    1, 0.02);
}

// Of some thousands a hundred from everywhere, in proportion. A motion replaces those that it ends,
// and few else.
TEST(FinalGatherPaths, FewAreSpreadAndStay)
{
  SceneObjects objects = MovingScene(1, true, 32).objects();
  UpdatedEngine engine(objects, pathSettings(20000));
  const auto chosen = [&] {
    const std::vector<std::uint32_t> walks = WalkPaths(engine).first(100);
    EXPECT_EQ(walks.size(), 100u);
    EXPECT_TRUE(std::is_sorted(walks.begin(), walks.end()));
    return walks;
  };
  const std::vector<std::uint32_t> before = chosen();
  const WalkSet& ofStatics = engine.walks().sets()[0];
  const double share = static_cast<double>(bornIn(ofStatics)) /
    static_cast<double>(WalkPaths(engine).first(kAllWalks).size());
  const auto few = static_cast<double>(std::count_if(before.begin(), before.end(),
    [&](std::uint32_t walk) { return walk < ofStatics.plan().endWalk(); }));
  EXPECT_NEAR(few / 100, share, 0.08);
  std::set<std::size_t> sixths;
  for (const std::uint32_t walk : before)
  {
    sixths.insert(std::size_t{ walk } * 6 / ofStatics.plan().endWalk());
  }
  EXPECT_GE(sixths.size(), 6u);
  objects.dynamicObjects[0].worldFromObject.translation += Vector3(0.05, 0, 0.02);
  engine.update(objects, pathSettings(20000));
  const std::vector<std::uint32_t> after = chosen();
  std::vector<std::uint32_t> both;
  std::set_intersection(
    before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(both));
  EXPECT_GT(both.size(), 85u);
}

// Of static cells: what stands before the first repaired point is as it was, and nothing else was
// shot again but the walks that were born.
TEST(FinalGatherPaths, SayWhatWasRepaired)
{
  MovingScene scene(1, true, 35, true);
  Execution serial;
  UpdatedEngine engine(scene.objects(), pathSettings(3000), serial);
  const auto shown = [&] {
    const WalkPaths paths(engine);
    std::map<std::uint32_t, WalkPath> all;
    for (const WalkPath& path : paths.paths(paths.first(kAllWalks), serial))
    {
      if (path.walk < engine.walks().sets()[0].plan().endWalk())
      {
        all.emplace(path.walk, path);
      }
    }
    return all;
  };
  const auto before = shown();
  scene.nextFrame();
  engine.update(scene.objects(), pathSettings(3000), serial);
  std::size_t again = 0, repaired = 0, born = 0;
  for (const auto& [walk, path] : shown())
  {
    const auto old = before.find(walk);
    if (old == before.end())
    {
      EXPECT_EQ(path.firstRepaired, 2u); // after the lamp and the cell
      again += path.points.size() - 2;
      ++born;
      continue;
    }
    const auto kept = static_cast<std::ptrdiff_t>(path.firstRepaired);
    ASSERT_GE(old->second.points.size(), path.firstRepaired);
    EXPECT_TRUE(
      std::equal(path.points.begin(), path.points.begin() + kept, old->second.points.begin()));
    EXPECT_TRUE(path.firstRepaired < path.points.size() || path.points == old->second.points);
    again += path.points.size() - path.firstRepaired;
    repaired += path.firstRepaired < path.points.size() ? 1 : 0;
  }
  EXPECT_GT(repaired, 20u);
  EXPECT_GT(born, 20u);
  EXPECT_EQ(
    static_cast<std::int64_t>(again), engine.walks().sets()[0].statistics().repairedSegments);
}

// Those that touch a cell are those whose points lie on it.
TEST(FinalGatherPaths, TouchingACell)
{
  ObjectBuilder room = plainRoom({ 2, 2, 2 }, 2, grey(0.6)), board;
  room.addQuad({ 0.5, 0.5, 1.9 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0.3, 5)); // cell 24
  board.addQuad({ -0.3, -0.3, 0 }, { 0.6, 0, 0 }, { 0, 0.6, 0 }, 1, 1, grey(0.5));
  Execution serial;
  UpdatedEngine engine(
    { room.build(), { board.build(shift({ 1, 1, 0.5 })) } }, pathSettings(3000), serial);
  const WalkPaths paths(engine);
  std::vector<std::uint32_t> low, onBoard, onLamp;
  const std::vector<std::uint32_t> all = paths.first(kAllWalks);
  for (const WalkPath& path : paths.paths(all, serial))
  {
    const auto touches = [&](double height, double from, double to) {
      return std::any_of(path.points.begin(), path.points.end(), [&](const Vector3& p) {
        return std::abs(p[2] - height) < 1e-6 && p[0] > from && p[0] < to && p[1] > from &&
          p[1] < to;
      });
    };
    touches(0, 0, 1) ? low.push_back(path.walk) : void();
    touches(0.5, 0.7, 1.3) ? onBoard.push_back(path.walk) : void();
    touches(1.9, 0.5, 1.5) ? onLamp.push_back(path.walk) : void();
  }
  EXPECT_EQ(onLamp, all) << "there is one lamp";
  EXPECT_EQ(paths.touching({ 0, 24 }, kAllWalks, serial), all);
  EXPECT_EQ(paths.touching({ 1, 0 }, kAllWalks, serial), onBoard);
  EXPECT_EQ(paths.touching({ 0, 16 }, kAllWalks, serial), low); // the lower side, by x and y
  EXPECT_GT(onBoard.size(), 100u);
  EXPECT_GT(low.size(), 100u);
}

}
}
