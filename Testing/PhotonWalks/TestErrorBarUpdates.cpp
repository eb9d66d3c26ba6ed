// SPDX-License-Identifier: BSD-3-Clause
#include "Kit.h"

namespace irradiance::test
{
namespace
{

class ErrorBarUpdates : public BothModes
{
};

// A new target continues from the existing walks, and the old target returns to them.
TEST_P(ErrorBarUpdates, TurningTheDialEqualsAFreshStart)
{
  const SceneObjects objects = shadedRoom(1);
  EngineSettings settings = Shoot(scaled(1000)).errors(16).gathered(isGathered());
  settings.maximumNumberOfWalks = 64000;
  UpdatedEngine engine;
  std::vector<std::uint32_t> walks;
  for (const double target : { 0.5, 0.2, 0.1, 0.3, 0.0001, 0.5 })
  {
    settings.targetRelativeError = target;
    engine.update(objects, settings);
    EXPECT_TRUE(isShownAsFresh(engine)) << "target " << target;
    walks.push_back(engine.numberOfWalks());
    EXPECT_NEAR(engine.watts(engine.balance().emitted[0]), 100, 1e-9);
    expectBalance(engine);
  }
  EXPECT_LT(walks[0], walks[1]);
  EXPECT_LT(walks[1], walks[2]);
  EXPECT_LT(walks[3], walks[2]);
  EXPECT_EQ(walks[4], settings.maximumNumberOfWalks) << "cannot be reached";
  EXPECT_EQ(walks[5], walks[0]);
  settings.targetRelativeError = 0;
  engine.update(objects, settings);
  EXPECT_TRUE(isShownAsFresh(engine));
}

// A tenth of the area is the inside of a box that no light can reach.
TEST_P(ErrorBarUpdates, DarkCellsDoNotMakeTheDialRunForever)
{
  ObjectBuilder room;
  room.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), 2, grey(0.3), true);
  room.addBox(box({ -1.5, -1, -1 }, { -0.3, 1, 1 }), 1, grey(0.5));
  room.addBox(box({ -1.4, -0.9, -0.9 }, { -0.4, 0.9, 0.9 }), 2, grey(0.5), true);
  room.addPointLight({ 1, 0, 0 }, 100);
  const EngineSettings settings =
    Shoot(1000).errors(16).gathered(isGathered()).target(kIsSanitized ? 0.5 : 0.2, 4000000);
  UpdatedEngine engine({ room.build(), {} }, settings);
  EXPECT_LE(engine.reachedRelativeError(), settings.targetRelativeError);
  EXPECT_LT(engine.numberOfWalks(), settings.maximumNumberOfWalks);
}

INSTANTIATE_TEST_SUITE_P(ShotAndGathered, ErrorBarUpdates, testing::Bool(), nameOfMode);

}
}
