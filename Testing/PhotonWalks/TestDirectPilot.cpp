// SPDX-License-Identifier: BSD-3-Clause
// Whether light is gathered or shot, by what a few samples of static cells say.

#include "DirectLight/DirectPilot.h"
#include "TestScenes.h"

#include <gtest/gtest.h>

#include <optional>

namespace irradiance
{

namespace
{

using test::grey;
using test::ObjectBuilder;

ObjectBuilder walls()
{
  ObjectBuilder room;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), 14, grey(0.5), true);
  return room;
}

/// None if shooting costs less. Where half of the light returns, and so much is the power of a walk
/// that starts at a cell.
std::optional<double> walksPerSample(const ObjectBuilder& room, double returned = 0.5)
{
  const SceneObjects objects{ room.build(), {} };
  const LampPieces lamps(LightTable(objects, 1000));
  const DirectPilot pilot(objects, lamps);
  const auto [walks, cost] = pilot.best({ 1, returned, std::max(0.0625, returned) });
  return cost < 1 ? std::optional<double>(walks) : std::nullopt;
}

ObjectBuilder withPanel()
{
  ObjectBuilder room = walls();
  room.addQuad({ 1.4, 1.7, 2.95 }, { 0, 0.3, 0 }, { 1.2, 0, 0 }, 1, 4, grey(0, 100));
  return room;
}

}

// A sample of a panel is far better than a walk.
TEST(DirectPilot, LooksForAPanel)
{
  const std::optional<double> walks = walksPerSample(withPanel());
  ASSERT_TRUE(walks.has_value());
  EXPECT_GT(*walks, 16);
  EXPECT_LE(*walks, DirectPilot::kMostWalks);
}

// The less returns the more samples: what is gathered is nearly all light.
TEST(DirectPilot, TakesMoreSamplesWhereLittleReturns)
{
  double before = DirectPilot::kMostWalks + 1;
  for (const double returned : { 0.5, 0.2, 0.05, 0.0 })
  {
    const std::optional<double> walks = walksPerSample(withPanel(), returned);
    ASSERT_TRUE(walks.has_value()) << returned;
    EXPECT_LT(*walks, before) << returned;
    before = *walks;
  }
  EXPECT_EQ(before, DirectPilot::kFewestWalks);
}

// Facets of tubes just below a ceiling are told apart badly: walks from them have less noise.
TEST(DirectPilot, ShootsFromTubesOfManyFacets)
{
  ObjectBuilder room = walls();
  for (int tube = 0; tube < 4; ++tube)
  {
    room.addGrid(12, 4, grey(0.5, 100), [&](int i, int j) {
      const double angle = M_PI / 6 * (i % 12);
      return Vector3(
        0.8 + 0.6 * j, 0.5 + tube + 0.02 * std::cos(angle), 2.85 + 0.02 * std::sin(angle));
    });
  }
  EXPECT_FALSE(walksPerSample(room).has_value());
  // As a bulb far from all walls they are not.
  ObjectBuilder bulb = walls();
  bulb.addSphere({ 2, 2, 1.5 }, 0.1, 12, grey(0.5, 1000));
  EXPECT_TRUE(walksPerSample(bulb).has_value());
}

// Of walks from a lamp far away hardly any arrives: none is shot.
TEST(DirectPilot, LooksForWhatIsFarAway)
{
  ObjectBuilder room = walls();
  room.addSphere({ 2, 2, 2.85 }, 0.1, 40, grey(0.5, 1000));
  const SceneObjects objects{ room.build(), {} };
  const DirectPilot pilot(objects, LampPieces(LightTable(objects, 1000)));
  double before = 0;
  for (const double arrived : { 1e-6, 1e-3, 0.5, 1.0 })
  {
    const double cost = pilot.best({ arrived, 0.5, 0.5 }).cost;
    EXPECT_GT(cost, before);
    EXPECT_LT(cost, 10 * arrived);
    before = cost;
  }
}

// A lamp in a box with a slit lights little of what samples ask for.
TEST(DirectPilot, KnowsWhatStandsBetween)
{
  ObjectBuilder open = walls(), hidden = walls();
  for (ObjectBuilder* room : { &open, &hidden })
  {
    room->addQuad({ 1.9, 1.9, 2.9 }, { 0, 0.2, 0 }, { 0.2, 0, 0 }, 1, 1, grey(0, 1000));
  }
  hidden.addQuad({ 1, 1, 2.8 }, { 1.98, 0, 0 }, { 0, 2, 0 }, 1, 1, grey(0.5));
  ASSERT_TRUE(walksPerSample(open).has_value());
  const std::optional<double> walks = walksPerSample(hidden);
  EXPECT_TRUE(!walks || *walks < *walksPerSample(open));
}

// Without a static object nothing is known, and a sample counts as a walk.
TEST(DirectPilot, KnowsNothingWithoutStaticCells)
{
  ObjectBuilder lamp;
  lamp.addQuad({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, grey(0, 100));
  const SceneObjects objects{ test::nothing(), { lamp.build() } };
  const LampPieces lamps(LightTable(objects, 1000));
  EXPECT_NO_THROW(DirectPilot(objects, lamps).best({ 1, 0.5, 0.5 }));
}

}
