// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_test_FinalGatherScenes_h
#define irradiance_test_FinalGatherScenes_h

#include "DirectRuns.h"

namespace irradiance::test
{

/// A scene whose dynamic objects have small cells, which gather.
struct GatherTestScene
{
  const char* name;
  SceneObjects objects;
  /// What all of these receive where that is known by a closed form, W/m2; else 0.
  double truth = 0;
};

namespace detail
{

/// A room of 4 x 4 x 3 m, n x n cells a wall, each wall with a reflectance of its own.
inline ObjectBuilder room(int n, int bands = 1, double specular = 0)
{
  ObjectBuilder builder(bands);
  const double reflectances[] = { 0.6, 0.4, 0.7, 0.5, 0.3, 0.8 };
  for (int side = 0; side < 6; ++side)
  {
    Look look = grey((1 - specular) * reflectances[side]);
    look.reflectance[1] *= 0.5;
    look.specular[0] = look.specular[1] = look.specular[2] = specular * reflectances[side];
    look.exponent = 10;
    builder.addSide(box({ 0, 0, 0 }, { 4, 4, 3 }), side, n, look, true);
  }
  return builder;
}

/// A panel of 1.2 x .8 m below the ceiling.
inline ObjectBuilder litRoom(int n, int bands = 1, double specular = 0)
{
  ObjectBuilder builder = room(n, bands, specular);
  builder.addQuad({ 1.2, 1.6, 2.9 }, { 0, 0.8, 0 }, { 1.2, 0, 0 }, 1, 1, grey(0, 30));
  return builder;
}

inline SceneObject ball(const Vector3& at, double radius, int n, int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addSphere({ 0, 0, 0 }, radius, n, grey(0.5));
  return builder.build(shift(at));
}

inline SceneObject block(const Vector3& at, const Vector3& half, int n)
{
  ObjectBuilder builder;
  builder.addBox(box(-half, half), n, grey(0.5));
  return builder.build(shift(at));
}

/// A spot of light that is smaller than the cells of the floor.
inline SceneObjects spotRoom(int n)
{
  ObjectBuilder builder;
  builder.addBox(box({ 0, 0, 0 }, { 8, 8, 8 }), n, grey(0.6), true);
  builder.addQuad({ 4.7, 2.7, 1 }, { 0, 0.6, 0 }, { 0.6, 0, 0 }, 1, 1, grey(0, 30));
  return { builder.build(), { ball({ 3.7, 4.9, 3.5 }, 0.7, 4) } };
}

inline SceneObjects furnaceRoom()
{
  ObjectBuilder builder, inside;
  builder.addBox(box({ 0, 0, 0 }, { 4, 3, 5 }), 3, {}, true);
  inside.addSphere({ 0, 0, 0 }, 0.5, 4, {});
  return { furnace(builder, 0.6, false), { furnace(inside, 0.7, false, shift({ 1, 1.5, 2 })) } };
}

}

/// What rays of a final gather may meet: closed forms, lamps of all kinds, corners, gloss, sides,
/// parts that cross.
inline std::vector<GatherTestScene> gatherScenes()
{
  using namespace detail;
  std::vector<GatherTestScene> scenes{ { "furnace", furnaceRoom(), 1 },
    { "area lamp", { litRoom(4).build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4) } } },
    { "spot", spotRoom(4) },
    { "gloss", { litRoom(4, 1, 0.4).build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4) } } },
    { "bands", { litRoom(4, 3).build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4, 3) } } },
    { "corner", { litRoom(4).build(), { block({ 0.2, 0.2, 0.2 }, { 0.2, 0.2, 0.2 }, 2) } } },
    { "buried", { litRoom(4).build(), { block({ 2.4, 1.5, 0 }, { 0.3, 0.3, 0.3 }, 2) } } },
    { "crossing",
      { litRoom(4).build(),
        { block({ 2.4, 1.5, 1 }, { 0.3, 0.3, 0.3 }, 2),
          block({ 2.6, 1.6, 1.1 }, { 0.3, 0.3, 0.3 }, 2) } } } };
  ObjectBuilder points = room(4), strip = room(4), sheet;
  points.addPointLight({ 1, 1, 1.5 }, 30);
  points.addPointLight({ 3, 3, 2.5 }, 20);
  scenes.push_back({ "points", { points.build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4) } } });
  strip.addQuad({ 0.5, 1.2, 0.04 }, { 0, 1.6, 0 }, { 0.08, 0, 0.08 }, 1, 1, grey(0, 100));
  scenes.push_back({ "near lamp", { strip.build(), { ball({ 1.9, 2, 0.6 }, 0.4, 4) } } });
  sheet.addQuad({ -0.3, -0.3, 0 }, { 0.6, 0, 0.2 }, { 0, 0.6, 0.1 }, 4, 4, grey(0.5));
  ObjectBuilder warm;
  warm.addBox(box({ 0, 0, 0 }, { 4, 4, 3 }), 4, grey(0.5, 2), true);
  warm.addQuad({ 1.2, 1.6, 2.9 }, { 0, 0.8, 0 }, { 1.2, 0, 0 }, 1, 1, grey(0, 60));
  scenes.push_back({ "warm walls", { warm.build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4) } } });
  ObjectBuilder bulb = room(4);
  bulb.addSphere({ 2, 2, 2.8 }, 0.05, 8, grey(0.5, 500));
  scenes.push_back({ "bulb", { bulb.build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4) } } });
  scenes.push_back({ "sheet", { litRoom(4).build(), { sheet.build(shift({ 2.4, 1.5, 1 })) } } });
  return scenes;
}

}

#endif
