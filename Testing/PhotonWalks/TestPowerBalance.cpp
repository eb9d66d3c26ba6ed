// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

namespace irradiance::test
{
namespace
{

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
