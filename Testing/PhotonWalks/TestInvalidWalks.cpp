// SPDX-License-Identifier: BSD-3-Clause
#include "FrontWorld.h"
#include "Kit.h"
#include "ShotWalk.h"

namespace irradiance::test
{
namespace
{

/// A scene into which walks are shot one by one, without an engine.
class TracedFrame : public FrontWorld
{
public:
  TracedFrame(const SceneObjects& objects, const Shoot& settings)
    : FrontWorld(
        objects, WalkPlan(settings.numberOfWalks, settings.numberOfWalks, 1), settings.seed)
  {
  }
  const std::vector<WalkSegment>& trace(std::uint32_t walk) const
  {
    traces_.resize(std::max<std::size_t>(traces_.size(), walk + 1));
    if (traces_[walk].empty())
    {
      traces_[walk] = shotWalk(tracer(), objects(), walk);
    }
    return traces_[walk];
  }
  bool isMoved(const TracedFrame& before, const Hit& hit) const
  {
    if (!hit || hit.id.object == 0)
    {
      return false;
    }
    const SceneObject &now = objects()[hit.id.object], &then = before.objects()[hit.id.object];
    return now.body != then.body || now.worldFromObject != then.worldFromObject;
  }

private:
  mutable std::vector<std::vector<WalkSegment>> traces_; ///< by walk, as far as they are known
};

/// Whether walks that are the same up to a segment differ in the next one.
bool differAfter(
  std::size_t i, const std::vector<WalkSegment>& a, const std::vector<WalkSegment>& b)
{
  const bool areLast = i + 1 == a.size();
  return areLast != (i + 1 == b.size()) ||
    (!areLast &&
      !(a[i + 1].ray.direction == b[i + 1].ray.direction && a[i + 1].power == b[i + 1].power));
}

struct InvalidCounts
{
  std::int64_t invalid = 0, repaired = 0;
};

/// By definition: a segment is stale if the object that it hit has moved, if a cast into the whole
/// new scene finds another hit, or if the walk leaves this otherwise.
InvalidCounts countByDefinition(
  const TracedFrame& before, const TracedFrame& now, std::uint32_t walks)
{
  InvalidCounts counts;
  for (std::uint32_t walk = 0; walk < walks; ++walk)
  {
    const std::vector<WalkSegment>&trace = before.trace(walk), &anew = now.trace(walk);
    for (std::uint32_t i = 0; i < trace.size(); ++i)
    {
      const Hit& old = trace[i].hit;
      if (now.isMoved(before, old) || now.scene().cast(trace[i].ray) != old ||
        differAfter(i, trace, anew))
      {
        ++counts.invalid;
        counts.repaired += anew.size() - i;
        break;
      }
    }
  }
  return counts;
}

// Not one walk too few or too many.
TEST(InvalidWalks, AreThoseThatChangedByDefinition)
{
  for (const bool isClosed : { true, false })
  {
    MovingScene scene(1, isClosed, 71, isClosed);
    Shoot settings(scaled(1000));
    UpdatedEngine engine(scene.objects(), settings);
    auto before = std::make_unique<TracedFrame>(scene.objects(), settings);
    for (int frame = 1; frame <= 12; ++frame)
    {
      scene.nextFrame();
      auto now = std::make_unique<TracedFrame>(scene.objects(), settings);
      engine.update(scene.objects(), settings);
      const InvalidCounts counts = countByDefinition(*before, *now, settings.numberOfWalks);
      EXPECT_EQ(engine.statistics().invalidWalks, counts.invalid) << "frame " << frame;
      EXPECT_EQ(engine.statistics().repairedSegments, counts.repaired) << "frame " << frame;
      before = std::move(now);
    }
  }
}

// Likewise where cells reflect otherwise, whether things move or not.
TEST(InvalidWalks, AreThoseThatOtherReflectancesChange)
{
  for (const int bands : { 1, 3 })
  {
    MovingScene scene(bands, true, 73);
    RandomVectors random(74);
    SceneObjects objects = scene.objects();
    const Shoot settings(scaled(250));
    UpdatedEngine engine(objects, settings);
    auto before = std::make_unique<TracedFrame>(objects, settings);
    for (std::size_t frame = 1; frame <= 6; ++frame)
    {
      scene.nextFrame();
      SceneObject& painted =
        frame % 2 == 0 ? objects.staticObject : objects.dynamicObjects[frame % 6];
      paint(painted, random, frame > 4);
      for (std::size_t i = 0; frame % 3 == 0 && i < objects.dynamicObjects.size(); ++i)
      {
        objects.dynamicObjects[i].worldFromObject =
          scene.objects().dynamicObjects[i].worldFromObject;
      }
      auto now = std::make_unique<TracedFrame>(objects, settings);
      engine.update(objects, settings);
      const InvalidCounts counts = countByDefinition(*before, *now, settings.numberOfWalks);
      EXPECT_EQ(engine.statistics().shootSeconds, 0);
      EXPECT_EQ(engine.statistics().invalidWalks, counts.invalid) << "frame " << frame;
      EXPECT_EQ(engine.statistics().repairedSegments, counts.repaired) << "frame " << frame;
      before = std::move(now);
    }
  }
}

// The balance is that of walks shot one by one.
TEST(PowerBalance, EqualsARecountOfTheWalks)
{
  for (const int bands : { 1, 3 })
  {
    MovingScene scene(bands, false, 12);
    const Shoot settings(scaled(1000));
    UpdatedEngine engine;
    for (int frame = 0; frame < 15; ++frame, scene.nextFrame())
    {
      engine.update(scene.objects(), settings);
      const TracedFrame traced(scene.objects(), settings);
      Power received, emitted, escaped, sum;
      std::int64_t segments = 0;
      for (std::uint32_t walk = 0; walk < settings.numberOfWalks; ++walk)
      {
        emitted += traced.stages().powerOf(walk);
        for (const WalkSegment& segment : traced.trace(walk))
        {
          ++segments;
          (segment.hit ? received : escaped) += segment.power;
        }
      }
      forEachSide(scene.objects(), false,
        [&](const CellSide& side, int band) { sum[band] += engine.sums().shot(side, band, 1); });
      EXPECT_EQ(sum, received);
      EXPECT_EQ(engine.balance().emitted, emitted);
      EXPECT_EQ(engine.balance().escaped, escaped);
      EXPECT_EQ(engine.balance().segments, segments);
    }
  }
}

/// A room with a point light and a box, all of one reflectance. An open room has no ceiling.
SceneObjects uniformRoom(double reflectance, bool isClosed)
{
  ObjectBuilder room;
  for (int side = 0; side < (isClosed ? 6 : 5); ++side)
  {
    room.addSide(box({ 0, 0, 0 }, { 3, 4, 5 }), side, 2, grey(reflectance), true);
  }
  room.addPointLight({ 1, 2, 3 }, 10);
  ObjectBuilder object;
  object.addBox(box({ -1, -1, -1 }, { 0, 0, 0 }), 1, grey(reflectance));
  return { room.build(), { object.build(shift({ 2, 3, 2 })) } };
}

TEST(PowerBalance, HoldsForAllReflectances)
{
  for (const auto& [reflectance, isClosed] :
    { std::pair(0.0, false), std::pair(0.5, false), std::pair(0.95, false), std::pair(1.0, false),
      std::pair(0.0, true), std::pair(0.5, true), std::pair(0.95, true) })
  {
    SceneObjects objects = uniformRoom(reflectance, isClosed);
    UpdatedEngine engine;
    for (int frame = 0; frame < 10; ++frame)
    {
      engine.update(objects, Shoot(scaled(isClosed ? 20000 : 3000)));
      expectBalance(engine);
      EXPECT_EQ(engine.balance().escaped.isZero(), isClosed);
      // At 1 every walk survives every hit, and keeps its power.
      EXPECT_EQ(engine.balance().absorbed.isZero(), reflectance == 1);
      EXPECT_TRUE(!isClosed || engine.watts(engine.balance().emitted[0]) == 10);
      objects.dynamicObjects[0].worldFromObject.translation[2] += 0.1;
    }
  }
}

// Light that cannot go anywhere is an error, not an endless run, and the engine stays usable. It
// comes within the first bounces, also where some walks end; and where walks leave at last, or are
// absorbed, none comes.
TEST(PowerBalance, ClosedRoomThatAbsorbsNothingEndsWithAClearError)
{
  Shoot settings(100000);
  UpdatedEngine engine;
  for (const bool gathers : { false, true })
  {
    settings.gathersDirectLight = gathers;
    for (const double reflectance : { gathers ? 1 - 1e-7 : 1.0, 1 - 1e-6 })
    {
      try
      {
        engine.update(uniformRoom(reflectance, true), settings);
        FAIL() << "no exception";
      }
      catch (const std::exception& error)
      {
        const std::string text = error.what();
        EXPECT_NE(text.find("reflectances there are too near 1"), std::string::npos) << text;
        EXPECT_NE(text.find("ended in their first 256 bounces"), std::string::npos) << text;
      }
    }
  }
  settings.numberOfWalks = scaled(4096);
  engine.update(uniformRoom(0.999, true), settings);
  EXPECT_GT(engine.balance().segments, settings.numberOfWalks / 2 * 1000);
  settings.numberOfWalks = 1000;
  engine.update(uniformRoom(1, false), settings);
  EXPECT_TRUE(isAsFresh(engine));
}

TEST(PowerBalance, ExcessIsBeyondNoise)
{
  EXPECT_TRUE(isExcess(1000, -251, 20));
  EXPECT_FALSE(isExcess(1000, -99, 20));
  EXPECT_FALSE(isExcess(1000, -1e-8, 0)) << "rounding";
  EXPECT_TRUE(isExcess(1000, -1e-3, 0));
  EXPECT_FALSE(isExcess(1000, 500, 1));
}

}
}
