// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/TradeScene.h"

#include "../../PhotonWalks/TestScenes.h"
#include "../../RayCasting/RandomVectors.h"

#include <algorithm>

using namespace irradiance;

namespace
{

std::vector<Triangle> quartered(const Triangle& t)
{
  const Vector3 ab = 0.5 * (t.a + t.b), bc = 0.5 * (t.b + t.c), ca = 0.5 * (t.c + t.a);
  return { { t.a, ab, ca }, { ab, t.b, bc }, { ca, bc, t.c }, { bc, ca, ab } };
}

/// Each of the pieces of its triangles is a cell, and looks like the cell it is cut from.
template <class Pieces>
SceneObject cut(const SceneObject& object, const Pieces& piecesOf)
{
  const Material& material = *object.material;
  test::ObjectBuilder builder;
  for (std::size_t i = 0; i < material.cellOfTriangle.size(); ++i)
  {
    const std::size_t cell = material.cellOfTriangle[i];
    const double* const exitance = object.exitanceOf(cell);
    for (const Triangle& piece : piecesOf(object.body->mesh()[i]))
    {
      builder.addCell({ piece }, test::grey(material.reflectance[cell], exitance ? *exitance : 0));
    }
  }
  return builder.build(object.worldFromObject);
}

template <class Change>
void changeAll(SceneObjects& objects, const Change& change)
{
  change(objects.staticObject);
  std::for_each(objects.dynamicObjects.begin(), objects.dynamicObjects.end(), change);
}

/// Round the middle of a room, turning.
auto circling(const Vector3& middle, double radius)
{
  return [=](SceneObjects& objects, double time) {
    const double angle = 2 * M_PI * time;
    objects.dynamicObjects[0].worldFromObject = {
      Eigen::AngleAxisd(angle, Vector3(1, 2, 2) / 3).toRotationMatrix(),
      middle + radius * Vector3(std::cos(angle), std::sin(angle), 0)
    };
  };
}

TradeScene makeBox()
{
  test::ObjectBuilder room, thing;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 4 }), 6, test::grey(0.5), true);
  room.addQuad({ 1, 1, 3.75 }, { 0, 2, 0 }, { 2, 0, 0 }, 4, 4, test::grey(0.5, 100));
  thing.addBox(test::box({ -0.5, -0.4, -0.3 }, { 0.5, 0.4, 0.3 }), 2, test::grey(0.7));
  return { { "box", { room.build(), { thing.build() } }, circling({ 2, 2, 2 }, 1) } };
}

/// Each wall cell shines with 1 - its reflectance. What reflects all light emits none, so that it
/// may move without a change of the lights.
TradeScene makeFurnace()
{
  test::RandomVectors random(91);
  test::ObjectBuilder room, thing;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 3, 5 }), 4, {}, true);
  Material& walls = room.material();
  for (std::size_t cell = 0; cell < walls.numberOfCells; ++cell)
  {
    walls.reflectance[cell] = random.uniform(0, 0.9);
    room.emission().exitance[cell] = 1 - walls.reflectance[cell];
  }
  thing.addSphere({ 0, 0, 0 }, 0.6, 6, test::grey(1));
  return { { "furnace", { room.build(), { thing.build() } }, circling({ 2, 1.5, 2.5 }, 0.7) },
    true };
}

}

std::vector<TradeScene> makeTradeScenes(const std::string& head)
{
  std::vector<TradeScene> scenes = { { makeMovingTeapot(head, 1, true) }, makeBox(),
    makeFurnace() };
  for (TradeScene& scene : scenes)
  {
    changeAll(scene.objects, [](SceneObject& object) {
      object = cut(object, [](const Triangle& whole) { return std::vector<Triangle>{ whole }; });
    });
  }
  return scenes;
}

SceneObjects subdivided(const SceneObjects& objects, int levels)
{
  SceneObjects pieces = objects;
  for (int level = 0; level < levels; ++level)
  {
    changeAll(pieces, [](SceneObject& object) { object = cut(object, quartered); });
  }
  return pieces;
}
