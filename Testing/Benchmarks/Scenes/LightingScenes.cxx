// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/LightingScenes.h"

#include "../../PhotonWalks/TestScenes.h"

#include <cmath>
#include <functional>
#include <utility>

using namespace irradiance;

namespace
{

constexpr double kReflectance = 0.5;
constexpr int kCells = 14; // along a side

/// Quads around an axis along x, and round ends.
void addTube(test::ObjectBuilder& room, const Vector3& start, double length, double radius,
  int around, int along, const test::Look& look)
{
  const auto ring = [&](int i, double x, double r) {
    const double angle = 2 * M_PI * (i % around) / around;
    return Vector3(start + Vector3(x, r * std::cos(angle), r * std::sin(angle)));
  };
  room.addGrid(
    around, along, look, [&](int i, int j) { return ring(i, length * j / along, radius); });
  room.addGrid(around, 1, look, [&](int i, int j) { return ring(i, 0, j == 0 ? 0 : radius); });
  room.addGrid(around, 1, look, [&](int i, int j) { return ring(i, length, j == 0 ? radius : 0); });
}

void addTubes(test::ObjectBuilder& room, int around, int along)
{
  for (int i = 0; i < 4; ++i)
  {
    addTube(room, { 0.8, 0.5 + i, 2.85 }, 2.4, 0.02, around, along, test::grey(kReflectance, 100));
  }
}

/// Squares that shine down.
void addPanels(test::ObjectBuilder& room, int n, double edge, double height, double exitance)
{
  for (int i = 0; i < n * n; ++i)
  {
    const double x = 4 * (i % n + 0.5) / n, y = 4 * (i / n + 0.5) / n;
    room.addQuad({ x - edge / 2, y - edge / 2, height }, { 0, edge, 0 }, { edge, 0, 0 }, 1, 1,
      test::grey(0, exitance));
  }
}

/// `look`: of all sides.
void addWalls(test::ObjectBuilder& room, const test::Look& look = test::grey(kReflectance))
{
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), kCells, look, true);
}

SceneObject makeBall(double diameter, int stacks, const test::Look& look)
{
  test::ObjectBuilder ball;
  ball.addSphere({ 0, 0, 0 }, diameter / 2, stacks, look);
  return ball.build();
}

using Lamps = std::function<void(test::ObjectBuilder&)>;

/// A ball of some 3,000 cells that moves from a place.
LightingScene makeScene(const std::string& name, SceneObject room, const Vector3& place,
  double diameter = 0.6, const test::Look& ofBall = test::grey(kReflectance), int stacks = 39)
{
  LightingScene scene;
  scene.name = name;
  scene.objects = { std::move(room), { makeBall(diameter, stacks, ofBall) } };
  const double step = diameter / 30;
  scene.place = [place, step](SceneObjects& placed, double time) {
    placed.dynamicObjects[0].worldFromObject =
      test::shift(place + Vector3(step * time / MovingScene::kFrame, 0, 0));
  };
  return scene;
}

LightingScene makeRoomWith(const std::string& name, const Lamps& addLamps,
  const test::Look& ofBall = test::grey(kReflectance))
{
  test::ObjectBuilder room;
  addWalls(room);
  addLamps(room);
  return makeScene(name, room.build(), { 1.2, 2.3, 1.1 }, 0.6, ofBall);
}

LightingScene makeFurnace()
{
  test::ObjectBuilder room;
  addWalls(room, test::grey(kReflectance, 1 - kReflectance));
  return makeScene(
    "furnace", room.build(), { 1.2, 2.3, 1.1 }, 0.6, test::grey(kReflectance, 1 - kReflectance));
}

LightingScene makeOven()
{
  test::ObjectBuilder room;
  addWalls(room, test::grey(kReflectance, 1e3));
  for (const double y : { 1.0, 2.8 })
  {
    room.addQuad({ 1.8, y, 2.9 }, { 0, 0.2, 0 }, { 0.4, 0, 0 }, 1, 1, test::grey(0, 5e4));
  }
  return makeScene("oven", room.build(), { 1.2, 2.3, 1.1 });
}

LightingScene makeLuminousCeiling()
{
  test::ObjectBuilder room;
  const Box box = test::box({ 0, 0, 0 }, { 4, 4, 3 });
  for (int side = 0; side < 6; ++side)
  {
    room.addSide(box, side, side == 5 ? 20 : kCells,
      side == 5 ? test::grey(kReflectance, 100) : test::grey(kReflectance), true);
  }
  return makeScene("luminous ceiling", room.build(), { 1.2, 2.3, 1.1 });
}

/// Slats of .2 m, .2 m apart, below four panels.
void addLouvre(test::ObjectBuilder& room)
{
  addPanels(room, 2, 0.4, 2.95, 100);
  for (int i = 0; i < 19; ++i)
  {
    room.addQuad(
      { 0.2 + 0.2 * i, 0.1, 2.65 }, { 0, 3.8, 0 }, { 0, 0, 0.2 }, 19, 1, test::grey(kReflectance));
  }
}

/// A ledge .3 m below the ceiling along all walls, with a strip on it that lights the ceiling
/// alone.
void addCove(test::ObjectBuilder& room)
{
  for (int side = 0; side < 4; ++side)
  {
    const double angle = M_PI / 2 * side;
    const Vector3 along(std::cos(angle), std::sin(angle), 0),
      in(-std::sin(angle), std::cos(angle), 0);
    const Vector3 corner = Vector3(2, 2, 2.7) - 2 * along - 2 * in;
    room.addQuad(
      corner + 0.01 * in + 0.3 * along, 3.4 * along, 0.24 * in, 14, 1, test::grey(kReflectance));
    room.addQuad(corner + 0.25 * in + 0.3 * along, 3.4 * along, Vector3(0, 0, 0.1), 14, 1,
      test::grey(kReflectance));
    room.addQuad(corner + Vector3(0, 0, 0.02) + 0.1 * in + 0.35 * along, 3.3 * along, 0.05 * in, 1,
      1, test::grey(0, 400));
  }
}

/// Two rooms of 4 x 4 x 3 m with a door of 1 x 2 m in between; the lamp is in the other one than
/// the ball.
LightingScene makeTwoRooms()
{
  test::ObjectBuilder rooms;
  const test::Look look = test::grey(kReflectance);
  rooms.addBox(test::box({ 0, 0, 0 }, { 8, 4, 3 }), 20, look, true);
  rooms.addQuad({ 4, 0, 0 }, { 0, 1.5, 0 }, { 0, 0, 3 }, 5, 10, look);
  rooms.addQuad({ 4, 2.5, 0 }, { 0, 1.5, 0 }, { 0, 0, 3 }, 5, 10, look);
  rooms.addQuad({ 4, 1.5, 2 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3, look);
  rooms.addQuad({ 5.5, 1.5, 2.95 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, test::grey(0, 100));
  return makeScene("two rooms", rooms.build(), { 1.2, 2.3, 1.1 });
}

/// 1 km of road, a lamp every 10 m.
LightingScene makeStreet()
{
  test::ObjectBuilder street;
  street.addQuad({ 0, 0, 0 }, { 1000, 0, 0 }, { 0, 10, 0 }, 400, 4, test::grey(0.3));
  for (int i = 0; i < 100; ++i)
  {
    street.addQuad({ 10.0 * i + 5, 5, 6 }, { 0, 0.3, 0 }, { 0.3, 0, 0 }, 1, 1, test::grey(0, 1e4));
  }
  return makeScene("street", street.build(), { 503, 4.3, 1.1 }, 1);
}

/// Of 2 x 2 x 2 m on a field, with a lamp of 40 W, below a lamp that is a thousand times as strong.
LightingScene makeHut()
{
  const auto build = [](bool hasSun) {
    test::ObjectBuilder field;
    const Box hut = test::box({ 0, 0, 0.01 }, { 2, 2, 2 });
    const Box outer = test::box({ -0.1, -0.1, 0 }, { 2.1, 2.1, 2.1 });
    field.addBox(hut, 10, test::grey(kReflectance), true);
    field.addQuad({ 0.8, 0.8, 1.9 }, { 0, 0.4, 0 }, { 0.4, 0, 0 }, 1, 1, test::grey(0, 250));
    field.addBox(outer, 4, test::grey(kReflectance));
    field.addQuad({ -9, -9, -0.1 }, { 20, 0, 0 }, { 0, 20, 0 }, 20, 20, test::grey(kReflectance));
    field.addQuad({ 0, 0, 20 }, { 0, 2, 0 }, { 2, 0, 0 }, 1, 1, test::grey(0, hasSun ? 1e4 : 0));
    return field.build();
  };
  LightingScene scene = makeScene("hut with a weak lamp", build(true), { 0.7, 1.2, 0.8 }, 0.4);
  scene.truthIn = build(false);
  return scene;
}

/// A part of 18,000 cells in a hall of 15,000.
LightingScene makeHall()
{
  test::ObjectBuilder hall;
  hall.addBox(test::box({ 0, 0, 0 }, { 40, 40, 8 }), 50, test::grey(kReflectance), true);
  for (int i = 0; i < 25; ++i)
  {
    hall.addQuad({ 8.0 * (i % 5) + 3.5, 8.0 * (i / 5) + 3.5, 7.9 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1,
      test::grey(0, 1000));
  }
  return makeScene(
    "fine part in a hall", hall.build(), { 17, 20.3, 1.1 }, 0.6, test::grey(kReflectance), 95);
}

/// 40 rows of 100 m, 2 m wide and tilted by 30 degrees, 5 m apart, below a panel that shines as a
/// sky does; one module of 2 x 1 m in the middle one moves along it.
LightingScene makeRows()
{
  const Vector3 along(1, 0, 0), up(0, std::cos(M_PI / 6), std::sin(M_PI / 6));
  test::ObjectBuilder field, module;
  field.addQuad({ -10, -10, 0 }, { 120, 0, 0 }, { 0, 220, 0 }, 60, 110, test::grey(0.25));
  for (int i = 0; i < 40; ++i)
  {
    const Vector3 corner(0, 5.0 * i, 1);
    const double half = i == 20 ? 48 : 50; // of the middle one: with place for the module
    field.addQuad(corner, half * along, 2 * up, 48, 2, test::grey(0.1));
    field.addQuad(corner + (100 - half) * along, half * along, 2 * up, 48, 2, test::grey(0.1));
  }
  field.addQuad({ -10, -10, 60 }, { 0, 220, 0 }, { 120, 0, 0 }, 1, 1, test::grey(0, 100));
  module.addQuad({ 0, 0, 0 }, along, 2 * up, 40, 80, test::grey(0.1));
  LightingScene scene;
  scene.name = "module in long rows";
  scene.objects = { field.build(), { module.build() } };
  scene.place = [](SceneObjects& placed, double time) {
    placed.dynamicObjects[0].worldFromObject =
      test::shift({ 49 + 0.02 * time / MovingScene::kFrame, 100, 1 });
  };
  return scene;
}

}

std::vector<LightingScene> makeLightingScenes()
{
  return {
    makeRoomWith("panel",
      [](auto& room) {
        room.addQuad({ 1.4, 1.7, 2.95 }, { 0, 0.3, 0 }, { 1.2, 0, 0 }, 1, 4, test::grey(0, 100));
      }),
    makeRoomWith("tubes of 48", [](auto& room) { addTubes(room, 12, 4); }),
    makeRoomWith("tubes of 2000", [](auto& room) { addTubes(room, 40, 50); }),
    makeRoomWith("bulb of 2000",
      [](auto& room) {
        room.addSphere({ 2, 2, 2.5 }, 0.1, 32, test::grey(kReflectance, 1000));
      }),
    makeRoomWith("400 LEDs", [](auto& room) { addPanels(room, 20, 0.02, 2.98, 1000); }),
    makeLuminousCeiling(), makeFurnace(), makeOven(), makeRoomWith("louvre", addLouvre),
    makeRoomWith("cove", addCove), makeTwoRooms(), makeStreet(),
    makeRoomWith("point lights",
      [](auto& room) {
        for (const Vector3& place :
          { Vector3(1, 1, 2.8), Vector3(3, 1, 2.5), Vector3(1, 3, 2), Vector3(3, 3, 0.3) })
        {
          room.addPointLight(place, 8);
        }
      }),
    makeRoomWith(
      "emitting mover", [](auto&) {}, test::grey(kReflectance, 100)),
    makeHut(), makeHall(), makeRows()
  };
}
