// SPDX-License-Identifier: BSD-3-Clause
#include "DirectLight/DarkSides.h"

#include "Kit.h"
#include "Skies.h"

// Sides of cells that no light can reach straight from the lights, and the cells that gather
// nothing.

namespace irradiance::test
{
namespace
{

/// A room with a panel of 1 W below the ceiling.
ObjectBuilder roomWithPanel()
{
  ObjectBuilder room = plainRoom({ 4, 4, 3 }, 4, grey(0.5));
  addPanel(room, { 1.5, 1.5, 2.9 }, 1, 1, 1);
  return room;
}

SceneObjects withMover(const ObjectBuilder& mover, const Vector3& at = { 0, 0, 0 })
{
  return { roomWithPanel().build(), { mover.build(shift(at)) } };
}

SceneObjects withBox(const Vector3& lower, const Vector3& upper, int n, bool isRoom = false)
{
  ObjectBuilder mover;
  mover.addBox(box(lower, upper), n, grey(0.5), isRoom);
  return withMover(mover);
}

/// Of dynamic cells: those dark on the front, on the back, and on both sides.
struct Counts
{
  std::size_t front = 0, back = 0, both = 0, all = 0;
  friend bool operator==(const Counts& a, const Counts& b)
  {
    return a.front == b.front && a.back == b.back && a.both == b.both && a.all == b.all;
  }
};

CellShapes shapesOf(const SceneObjects& objects)
{
  const UpdatedEngine engine(objects, Shoot(100).gathered());
  CellShapes shapes(engine.frame(), 0, objects.size());
  markDarkSides(shapes, engine.frame(), LightTable(objects, 100));
  return shapes;
}

Counts countsOf(const SceneObjects& objects)
{
  const CellShapes shapes = shapesOf(objects);
  Counts counts;
  shapes.numbers().forEach([&](const SceneCell& cell) {
    const CellShape& shape = shapes[shapes.numbers()[cell]];
    counts.all += cell.object > 0 ? 1 : 0;
    counts.front += shape.isFrontDark ? 1 : 0;
    counts.back += shape.isBackDark ? 1 : 0;
    counts.both += shape.isFrontDark && shape.isBackDark ? 1 : 0;
  });
  return counts;
}

// Nothing is outside of the walls of a room, until a box comes that is in part beyond one of them.
TEST(OuterSides, AreDarkUnlessSomethingIsInFront)
{
  for (const double beyond : { 4.0, 4.5 }) // in the wall at x = 4, then half a metre from it
  {
    const SceneObjects objects = withBox({ beyond - 1, 1, 1 }, { beyond, 2, 2 }, 1);
    CellShapes shapes = shapesOf(objects);
    for (std::size_t cell = 0; cell < shapes.size(); ++cell)
    {
      shapes.setDark(cell, false, false);
    }
    Box bounds = objects.staticObject.worldBounds();
    bounds.add(objects.dynamicObjects[0].worldBounds());
    markOuterSides(shapes, bounds, {});
    constexpr std::size_t kOfWall = 16;
    std::size_t backs = 0;
    for (std::size_t cell = 0; cell < 6 * kOfWall; ++cell)
    {
      EXPECT_FALSE(shapes[cell].isFrontDark) << "walls face inwards; cell " << cell;
      backs += shapes[cell].isBackDark ? 1 : 0;
    }
    EXPECT_EQ(backs, (beyond > 4 ? 5 : 6) * kOfWall);
  }
}

// Light from above the horizon comes to all walls of a house but the floor; that of a low sun to
// the roof and to two of them.
TEST(OuterSides, AreLitByTheSky)
{
  const SceneObjects objects = withBox({ 1, 1, 1 }, { 2, 2, 2 }, 1);
  const Box bounds = objects.staticObject.worldBounds();
  const DistantLight sky(skyOf(bounds, overcastSky)),
    sun = DistantLight::sunOf(sunOnly(bounds, skyDirection(80, 30), 700, 0.005));
  const auto litBacks = [&](const std::vector<const DistantLight*>& distant) {
    CellShapes shapes = shapesOf(objects);
    std::size_t backs = 0;
    for (std::size_t cell = 0; cell < 96; ++cell)
    {
      shapes.setDark(cell, false, false);
    }
    markOuterSides(shapes, bounds, distant);
    for (std::size_t cell = 0; cell < 96; ++cell)
    {
      backs += shapes[cell].isBackDark ? 0 : 1;
    }
    return backs;
  };
  EXPECT_EQ(litBacks({}), 0u);
  EXPECT_EQ(litBacks({ &sky }), 5 * 16u);
  EXPECT_EQ(litBacks({ &sun }), 3 * 16u);
  EXPECT_EQ(litBacks({ &sun, &sky }), 5 * 16u);
}

TEST(DarkSides, AreInsideAClosedBodyAndBelowIt)
{
  // Walls stand below the edges of the panel's bounds, so they turn away from all of it.
  const Vector3 low(1.5, 1.5, 1), high(2.5, 2.5, 2);
  EXPECT_EQ(countsOf(withBox(low, high, 2)), (Counts{ 20, 24, 20, 24 }));
  // The other way round.
  EXPECT_EQ(countsOf(withBox(low, high, 2, true)), (Counts{ 24, 20, 20, 24 }));
  // A smaller one: walls see the panel, the floor does not.
  const SceneObjects small = withBox({ 1.8, 1.8, 1 }, { 2.2, 2.2, 1.4 }, 2);
  EXPECT_EQ(countsOf(small), (Counts{ 4, 24, 4, 24 }));
}

TEST(DarkSides, AreNotWhereALightIsInsideOrNear)
{
  ObjectBuilder lantern, lampshade;
  const SceneObjects aboutThePanel = withBox({ 1.5, 1.5, 1 }, { 2.5, 2.5, 2.95 }, 2);
  EXPECT_EQ(countsOf(aboutThePanel), (Counts{ 0, 0, 0, 24 }));
  lantern.addBox(box({ 1, 1, 1 }, { 2, 2, 2 }), 1, grey(0.5));
  lantern.addPointLight({ 1.5, 1.5, 1.5 }, 1);
  EXPECT_EQ(countsOf(withMover(lantern)), (Counts{ 0, 0, 0, 6 }));
  lampshade.addBox(box({ 1, 1, 1 }, { 2, 2, 2 }), 1, grey(0.5, 1)); // it shines itself
  EXPECT_EQ(countsOf(withMover(lampshade)), (Counts{ 0, 0, 0, 6 }));
}

TEST(DarkSides, AreNotOfSheetsNorOfStaticBodies)
{
  ObjectBuilder sheet;
  sheet.addQuad({ 1, 1, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2, grey(0.5));
  EXPECT_EQ(countsOf(withMover(sheet)), (Counts{ 0, 0, 0, 4 }));
  ObjectBuilder room = roomWithPanel();
  room.addBox(box({ 1.5, 1.5, 1 }, { 2.5, 2.5, 2 }), 2, grey(0.5));
  EXPECT_EQ(countsOf({ room.build(), {} }), (Counts{ 0, 0, 0, 0 }));
}

/// Light that comes by way of walls arrives all the same, and a lamp that enters the body is seen.
TEST(DarkSides, FollowALampThatEntersTheBody)
{
  ObjectBuilder lamp;
  lamp.addPointLight({ 0, 0, 0 }, 1);
  SceneObjects objects{ roomWithPanel().build(),
    { block({ 2, 2, 1 }, { 0.5, 0.5, 0.5 }, 2), lamp.build() } };
  UpdatedEngine engine;
  for (const double x : { 3.2, 2.4, 2.0, 1.2 })
  {
    objects.dynamicObjects[1].worldFromObject = shift({ x, 2, 1 });
    engine.update(objects, Shoot(scaled(20000)).gathered().bySide());
    ASSERT_TRUE(isAsFresh(engine)) << "x = " << x;
    const bool isInside = x > 1.5 && x < 2.5;
    double inner = 0, outer = 0; // W/m2, of 24 cells
    for (std::uint32_t cell = 0; cell < 24; ++cell)
    {
      outer += engine.irradiance({ { 1, cell }, 0 }, 0);
      inner += engine.irradiance({ { 1, cell }, 1 }, 0);
    }
    EXPECT_GT(outer, 0.1);
    EXPECT_TRUE(isInside ? inner > 1 : inner == 0) << "x = " << x;
  }
}

/// A ring about the z axis, 16 cells along and 12 around. `section(v)`: x, z of its section.
template <class Section>
ObjectBuilder ring(const Section& section)
{
  ObjectBuilder builder;
  builder.addGrid(16, 12, grey(0.5), [&](int i, int k) {
    const double u = 2 * M_PI * (i % 16) / 16;
    const Vector3 s = section(2 * M_PI * (k % 12) / 12);
    return Vector3((.7 + s[0]) * std::cos(u), (.7 + s[0]) * std::sin(u), s[2]);
  });
  return builder;
}

// An eight has its front outside on one half, and inside on the other: no side of it is dark for
// certain.
TEST(DarkSides, AreNotOfARingThatCrossesItself)
{
  const ObjectBuilder round =
    ring([](double v) { return Vector3(.3 * std::cos(v), 0, .3 * std::sin(v)); });
  const ObjectBuilder eight =
    ring([](double v) { return Vector3(.3 * std::cos(v + .1), 0, .2 * std::sin(2 * v + .2)); });
  const Counts ofRound = countsOf(withMover(round, { 2, 2, 1 }));
  EXPECT_EQ(ofRound.front + ofRound.back, 192 + ofRound.both);
  const SceneObjects objects = withMover(eight, { 2, 2, 1 });
  EXPECT_EQ(countsOf(objects), (Counts{ 0, 0, 0, 192 }));
  // Both halves have light, shot and gathered.
  double watts[2][2];
  for (const bool isGathered : { false, true })
  {
    UpdatedEngine engine(objects, Shoot(scaled(40000)).gathered(isGathered).bySide());
    for (const int side : { 0, 1 })
    {
      watts[isGathered][side] = 0;
      for (std::size_t cell = 0; cell < 192; ++cell)
      {
        watts[isGathered][side] += engine.watts(engine.sums().sum({ 1, cell, side }, 0));
      }
    }
  }
  for (const int side : { 0, 1 })
  {
    EXPECT_GT(watts[0][side], .05);
    EXPECT_NEAR(watts[1][side], watts[0][side], (kIsSanitized ? .5 : .1) * watts[0][side]);
  }
}

}
}
