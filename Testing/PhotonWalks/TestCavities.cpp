// SPDX-License-Identifier: BSD-3-Clause
// Lamps and point lights on the inner walls of bodies with cavities, as CAD writes them: all fronts
// out of the material.

#include "Kit.h"

namespace irradiance::test
{
namespace
{

constexpr std::size_t kWall = 24; ///< cells of one shell
constexpr double kReflectance = 0.5;
constexpr std::uint32_t kCavityWalks = kIsSanitized ? 5000 : 20000;
constexpr double kCavityTolerance = kIsSanitized ? 0.35 : 0.1; ///< in W

void addChamber(ObjectBuilder& builder, const Vector3& low, const Vector3& high)
{
  const Vector3 thick = Vector3::Constant(0.25);
  builder.addBox(box(low, high), 2, grey(kReflectance), true);
  builder.addBox(box(low - thick, high + thick), 2, grey(kReflectance));
}

/// A chamber of 2 m.
ObjectBuilder chamber()
{
  ObjectBuilder builder;
  addChamber(builder, { 0, 0, 0 }, { 2, 2, 2 });
  return builder;
}

/// It shines down.
void addPanel(ObjectBuilder& builder, double low, double high, double z)
{
  builder.addQuad({ low, low, z }, { 0, high - low, 0 }, { high - low, 0, 0 }, 1, 1,
    grey(kReflectance, 1 / (high - low) / (high - low)));
}

/// All surfaces reflect half, so 2 W arrive on them of the 1 W that a light sheds in a cavity. None
/// on the outer walls, a shell's cells from `outer` on. The sum has a deviation of .02 W shot (2
/// hits a walk, variance 2), and over 20 seeds of up to .017 W gathered (fewer walks: .035 and .063
/// W). The tolerance is exceeded in less than 1 of 10^7 runs.
void expectLightInside(const SceneObjects& objects, const SceneCell& outer, const std::string& what)
{
  for (const bool isGathered : { false, true })
  {
    UpdatedEngine engine(objects, Shoot(kCavityWalks).gathered(isGathered));
    double watts = 0, outside = 0;
    engine.cells().numbers().forEach([&](const SceneCell& cell) {
      const bool isOutside =
        cell.object == outer.object && cell.cell >= outer.cell && cell.cell < outer.cell + kWall;
      (isOutside ? outside : watts) += wattsOn(engine, cell.object, cell.cell, cell.cell + 1);
    });
    EXPECT_NEAR(watts, 2, kCavityTolerance) << what << (isGathered ? " gathered" : "");
    EXPECT_EQ(outside, 0) << what << (isGathered ? " gathered" : "");
  }
}

/// Watts on the side walls and the floor of the cavity whose cells begin with `first`. The sum over
/// the ceiling, too, would tell nothing: a lamp that is taken for covered exchanges all of its
/// light with the ceiling.
double wattsBelow(
  const SceneObjects& objects, std::uint32_t object, std::size_t first, bool isGathered)
{
  constexpr std::size_t kCeiling = 4;
  UpdatedEngine engine(objects, Shoot(kCavityWalks).gathered(isGathered));
  return wattsOn(engine, object, first, first + kWall - kCeiling);
}

/// As from a lamp that hangs clear of the ceiling. At least 10,000 hits have a deviation of 2 % at
/// most, the difference of two such sums 3 %; 15 % are exceeded in 1 of 10^6 runs.
void expectAsHanging(const SceneObjects& objects, const SceneObjects& hanging, std::uint32_t object,
  const std::string& what, std::size_t first = 0)
{
  for (const bool isGathered : { false, true })
  {
    const double watts = wattsBelow(hanging, object, first, isGathered);
    EXPECT_GT(watts, 0.5) << what;
    EXPECT_NEAR(
      wattsBelow(objects, object, first, isGathered), watts, (kIsSanitized ? 0.5 : 0.15) * watts)
      << what << (isGathered ? " gathered" : "");
  }
}

TEST(Cavities, LampsOnTheCeiling)
{
  for (const double low : { 0.5, 0.0 }) // a small one, and one that fills the ceiling
  {
    const std::string which = low > 0 ? "small lamp, " : "large lamp, ";
    ObjectBuilder lamp, below, thing, all = chamber();
    addPanel(lamp, low, 2 - low, 2);
    addPanel(below, low + 0x1p-10, 2 - low - 0x1p-10, 2 - 0x1p-10);
    addPanel(all, low, 2 - low, 2);
    thing.addSphere({ 1, 1, 0.75 }, 0.25, 4, grey(kReflectance));
    const SceneObject none = nothing();
    const SceneObjects moving{ none, { chamber().build(), below.build() } };
    const SceneObjects resting{ chamber().build(), { below.build(), thing.build() } };
    const SceneObjects cases[] = { { lamp.build(), { chamber().build() } },
      { none, { chamber().build(), lamp.build() } }, { none, { all.build() } },
      { all.build(), { thing.build() } }, { chamber().build(), { lamp.build(), thing.build() } } };
    const char* names[] = { "the chamber moves", "both move", "as one thing", "a thing moves",
      "the lamp moves" };
    for (std::size_t i = 0; i < 5; ++i)
    {
      const std::uint32_t object = i < 3 ? 1 : 0;
      expectLightInside(cases[i], { object, kWall }, which + names[i]);
      expectAsHanging(cases[i], i < 3 ? moving : resting, object, which + names[i]);
    }
  }
}

TEST(Cavities, PointLightsOnTheirWalls)
{
  for (const Vector3& place : { Vector3(1, 1.1, 2), Vector3(0, 0, 0.9), Vector3(2, 2, 2) })
  {
    ObjectBuilder light, all = chamber();
    light.addPointLight(place, 1);
    all.addPointLight(place, 1);
    expectLightInside({ nothing(), { chamber().build(), light.build() } }, { 1, kWall }, "moving");
    expectLightInside({ all.build(), {} }, { 0, kWall }, "resting");
  }
}

// A chamber in a chamber. The light is between the two, then in the inner one.
TEST(Cavities, InCavities)
{
  for (const bool isInner : { false, true })
  {
    ObjectBuilder lamp, below;
    const double ceiling = isInner ? 1.25 : 2;
    addPanel(lamp, .5, 1.5, ceiling);
    addPanel(below, .5 + 0x1p-10, 1.5 - 0x1p-10, ceiling - 0x1p-10);
    ObjectBuilder both;
    addChamber(both, { .5, .5, .5 }, { 1.5, 1.5, 1.25 });
    addChamber(both, { 0, 0, 0 }, { 2, 2, 2 });
    for (const SceneObjects& objects : { SceneObjects{ lamp.build(), { both.build() } },
           SceneObjects{ both.build(), { lamp.build() } } })
    {
      const std::uint32_t object = objects.dynamicObjects[0].emits() ? 0 : 1;
      const SceneObjects hanging = object == 1 ? SceneObjects{ below.build(), { both.build() } }
                                               : SceneObjects{ both.build(), { below.build() } };
      expectAsHanging(
        objects, hanging, object, isInner ? "inner" : "outer", isInner ? 0 : 2 * kWall);
      UpdatedEngine engine(objects, Shoot(kCavityWalks));
      const double ofInner = wattsOn(engine, object, 0, kWall),
                   between = wattsOn(engine, object, kWall, 3 * kWall),
                   outside = wattsOn(engine, object, 3 * kWall, 4 * kWall),
                   ofLamp = wattsOn(engine, 1 - object, 0, 1);
      EXPECT_NEAR((isInner ? ofInner : between) + ofLamp, 2, kCavityTolerance);
      EXPECT_EQ((isInner ? between : ofInner) + outside, 0);
    }
  }
}

// The two shells of a chamber as things of their own, which move; the lamp or point light moves
// with the inner one, or alone.
TEST(Cavities, OfTwoThings)
{
  ObjectBuilder inner, outer, lamp, light;
  const Vector3 low(0, 0, 0), high(2, 2, 2), thick(.25, .25, .25);
  inner.addBox(box(low, high), 2, grey(kReflectance), true);
  outer.addBox(box(low - thick, high + thick), 2, grey(kReflectance));
  addPanel(lamp, .5, 1.5, 2);
  light.addPointLight({ 1, 1.1, 2 }, 1);
  ObjectBuilder withLamp = inner, withLight = inner;
  addPanel(withLamp, .5, 1.5, 2);
  withLight.addPointLight({ 1, 1.1, 2 }, 1);
  const SceneObject none = nothing();
  expectLightInside({ none, { outer.build(), withLamp.build() } }, { 1, 0 }, "with the lamp");
  expectLightInside({ none, { outer.build(), withLight.build() } }, { 1, 0 }, "with the light");
  expectLightInside(
    { none, { outer.build(), inner.build(), lamp.build() } }, { 1, 0 }, "beside the lamp");
  expectLightInside(
    { none, { outer.build(), inner.build(), light.build() } }, { 1, 0 }, "beside the light");
}

// A lamp on the outer lid of a chamber that rests, or moves, shines away from it.
TEST(Cavities, HaveNoLightFromOutside)
{
  ObjectBuilder lamp, light, panel = chamber(), bulb = chamber();
  lamp.addQuad({ .5, .5, 2.25 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(kReflectance, 1));
  panel.addQuad({ .5, .5, 2.25 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1, grey(kReflectance, 1));
  light.addPointLight({ 1, 1.1, 2.25 }, 1);
  bulb.addPointLight({ 1, 1.1, 2.25 }, 1);
  for (const SceneObjects& objects :
    { SceneObjects{ lamp.build(), { chamber().build() } }, SceneObjects{ panel.build(), {} },
      SceneObjects{ light.build(), { chamber().build() } }, SceneObjects{ bulb.build(), {} } })
  {
    UpdatedEngine engine(objects, Shoot(scaled(2000)));
    EXPECT_EQ(engine.balance().escaped.total(), engine.balance().emitted.total());
  }
}

}
}
