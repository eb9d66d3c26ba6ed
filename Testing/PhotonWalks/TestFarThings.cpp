// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

// Law: far objects cost nothing near. The tests count the segments for which the verification casts
// a ray: those near the moving ball, even if something stands 1 km away or came back from there.

namespace irradiance::test
{
namespace
{

const Vector3 kAway(600, 0, 800); ///< 1 km

/// A small ball that moves in a room of 4 m without a ceiling, and a large one that rests.
struct FarScene
{
  SceneObjects objects;
  EngineSettings settings;
  UpdatedEngine engine;

  FarScene(const Vector3& light, double lampHeight)
  {
    ObjectBuilder room;
    for (int side = 0; side < 5; ++side)
    {
      room.addSide(box({ 0, 0, 0 }, { 4, 4, 4 }), side, 4, grey(0.5), true);
    }
    room.addQuad({ 1, 1, lampHeight }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 1));
    // A sliver, whose points are moved farthest off its edges.
    room.addQuad({ 0, 1, 1 }, { 0, 2, 0 }, { 0, 0, 1e-4 }, 1, 1, grey(0.5));
    room.addPointLight(light, 1);
    objects = { room.build(), { ball({}, 0.1, 5), ball({ 3, 3, 1 }, 0.3, 5) } };
    settings.numberOfWalks = scaled(20000);
    moveSmall(0);
  }

  void moveSmall(int frame)
  {
    objects.dynamicObjects[0].worldFromObject =
      shift(Vector3(2, 2, 1.5) + 0.8 * Vector3(std::cos(frame), std::sin(frame), 0));
  }
  void moveLarge(const Vector3& place) { objects.dynamicObjects[1].worldFromObject = shift(place); }

  void update(const std::string& what)
  {
    engine.update(objects, settings);
    ASSERT_TRUE(isAsFresh(engine)) << what;
  }

  /// Rays cast over six frames in which only the small ball moves.
  std::int64_t suspects(const std::string& what)
  {
    std::int64_t sum = 0;
    for (int frame = 1; frame <= 6; ++frame)
    {
      moveSmall(frame);
      update(what);
      EXPECT_EQ(engine.statistics().shootSeconds, 0) << "shot again";
      sum += engine.statistics().suspectSegments;
    }
    return sum;
  }
};

const Vector3 kLight(3, 1, 2);
constexpr double kLamp = 3.5;

std::int64_t suspectsOfNear()
{
  FarScene scene(kLight, kLamp);
  scene.update("near");
  const std::int64_t suspects = scene.suspects("near");
  EXPECT_GT(suspects, 0);
  return suspects;
}

std::int64_t limit(std::int64_t near)
{
  return near + near / 2 + 100;
}

TEST(FarThings, ABallThatGoesAwayAndComesBackTakesNothingAlong)
{
  const std::int64_t near = suspectsOfNear();
  FarScene scene(kLight, kLamp);
  scene.update("first");
  for (const double distances : { 1.0, 1e3, 1e6 }) // of 1 km
  {
    scene.moveLarge(distances * kAway);
    scene.update("goes");
    EXPECT_LE(scene.suspects("away"), limit(near)) << distances << " km away";
    scene.moveLarge({ 3, 3, 1 });
    scene.update("comes");
    if (distances == 1)
    {
      EXPECT_LE(scene.suspects("back"), limit(near)) << "back from there";
    }
  }
}

TEST(FarThings, ABallThatWasAlwaysAway)
{
  const std::int64_t near = suspectsOfNear();
  for (const double distances : { 1.0, 1e2, 1e4 })
  {
    FarScene scene(kLight, kLamp);
    scene.moveLarge(distances * kAway);
    scene.update("first");
    EXPECT_LE(scene.suspects("away"), limit(near)) << distances << " km away";
  }
}

TEST(FarThings, FarLights)
{
  const std::int64_t near = suspectsOfNear();
  for (const double distances : { 1.0, 1e2, 1e4 })
  {
    FarScene scene(distances * kAway, kLamp);
    scene.update("first");
    EXPECT_LE(scene.suspects("light"), limit(near)) << "light " << distances << " km away";
  }
  for (const double distances : { 1.0, 1e2 })
  {
    FarScene scene(kLight, 1e3 * distances);
    scene.update("first");
    EXPECT_LE(scene.suspects("lamp"), limit(near)) << "lamp " << distances << " km away";
  }
}

/// Of so many grains that all move: for each of them, and each frame.
double suspectsOfMany(int number)
{
  constexpr int kFrames = 3; // in the first all is shot
  FarScene scene(kLight, kLamp);
  scene.settings.numberOfWalks = 20000; // with sanitizers too: a few would tell nothing
  scene.objects.dynamicObjects.assign(static_cast<std::size_t>(number), ball({}, 0.03, 4));
  std::int64_t sum = 0;
  for (int frame = 0; frame < kFrames; ++frame)
  {
    for (int i = 0; i < number; ++i)
    {
      const auto at = [&](double step) { return 0.5 + 3 * std::fmod(step * i, 1.0); };
      scene.objects.dynamicObjects[static_cast<std::size_t>(i)].worldFromObject =
        shift({ at(0.8191725134), at(0.6710436067) + 0.05 * frame, at(0.5497004779) });
    }
    scene.update(std::to_string(number));
    sum += scene.engine.statistics().suspectSegments;
  }
  return static_cast<double>(sum) / number / (kFrames - 1);
}

class ManyMoved : public testing::TestWithParam<int>
{
};

// However many move, each makes no more segments suspect than among few.
TEST_P(ManyMoved, EachBringsItsShare)
{
  EXPECT_LE(suspectsOfMany(GetParam()), 1.3 * suspectsOfMany(8));
}

INSTANTIATE_TEST_SUITE_P(
  Objects, ManyMoved, testing::Values(9, 15, 16, 64, 129, 500), testing::PrintToStringParamName());

}
}
