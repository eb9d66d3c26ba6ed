// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TestScenes.h"

#include "../RayCasting/RandomVectors.h"

namespace irradiance::test
{

/// Scenes made of rooms, balls and blocks.

/// Walls from the origin on, n x n cells each.
inline ObjectBuilder plainRoom(const Vector3& size, int n, const Look& look, int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addBox(box({ 0, 0, 0 }, size), n, look, true);
  return builder;
}

/// A room of 4 x 4 x 3 m, n x n cells a wall, each wall with a reflectance of its own.
inline ObjectBuilder variedRoom(int n, int bands = 1, double specular = 0)
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

/// A square or oblong that shines down.
inline void addPanel(
  ObjectBuilder& room, const Vector3& corner, double x, double y, double exitance)
{
  room.addQuad(corner, { 0, y, 0 }, { x, 0, 0 }, 1, 1, grey(0, exitance));
}

/// Four tubes of many facets just below a ceiling at 3 m.
inline void addTubes(ObjectBuilder& room)
{
  for (int tube = 0; tube < 4; ++tube)
  {
    room.addGrid(12, 4, grey(0.5, 100), [&](int i, int j) {
      const double angle = M_PI / 6 * (i % 12);
      return Vector3(
        0.8 + 0.6 * j, 0.5 + tube + 0.02 * std::cos(angle), 2.85 + 0.02 * std::sin(angle));
    });
  }
}

/// A panel of 1.2 x .8 m below the ceiling: a cell more than the walls.
inline ObjectBuilder litRoom(int n, int bands = 1, double specular = 0)
{
  ObjectBuilder builder = variedRoom(n, bands, specular);
  addPanel(builder, { 1.2, 1.6, 2.9 }, 1.2, 0.8, 30);
  return builder;
}

inline SceneObject ball(
  const Vector3& at, double radius, int n, const Look& look = grey(0.5), int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addSphere({ 0, 0, 0 }, radius, n, look);
  return builder.build(shift(at));
}

inline SceneObject block(
  const Vector3& at, const Vector3& half, int n, const Look& look = grey(0.5), int bands = 1)
{
  ObjectBuilder builder(bands);
  builder.addBox(box(-half, half), n, look);
  return builder.build(shift(at));
}

/// The scene with a sky, which has a set of walks beside that of the lamps.
inline SceneObjects underSky(SceneObjects objects)
{
  Sky sky;
  sky.lit = objects.staticObject.worldBounds();
  sky.lit.inflate(1);
  sky.polarAngles = { 0, 90 };
  sky.azimuths = { 0 };
  sky.radiance = { 0.5, 0.5 };
  sky.bandWeights.assign(static_cast<std::size_t>(objects.staticObject.material->bands), 1);
  objects.sky = std::make_shared<const Sky>(sky);
  return objects;
}

/// Every cell emits what it does not reflect, 1 - reflectance, so E = 1 everywhere.
inline SceneObject furnace(ObjectBuilder builder, double reflectance, const AffineMap& pose = {})
{
  std::vector<double>& ofCells = builder.material().reflectance;
  std::fill(ofCells.begin(), ofCells.end(), reflectance);
  builder.emission().exitance.assign(ofCells.size(), 1 - reflectance);
  return builder.build(pose);
}

/// Every cell has a reflectance of its own in each band and emits what it does not reflect, so that
/// E = 1 everywhere. If `isGlossy`, a part of the reflectance is specular, with lobes from wide to
/// mirrors.
inline SceneObject furnace(
  ObjectBuilder builder, RandomVectors& random, bool isGlossy = false, const AffineMap& pose = {})
{
  std::vector<double>& reflectance = builder.material().reflectance;
  for (std::size_t i = 0; i < reflectance.size(); ++i)
  {
    reflectance[i] = random.uniform(0, 0.9);
    builder.emission().exitance[i] = 1 - reflectance[i];
  }
  SceneObject object = builder.build(pose);
  if (!isGlossy)
  {
    return object;
  }
  Material material = *object.material;
  const std::array<double, 5> exponents{ 0, 1, 15, 1000, kInfinity };
  std::vector<double> specular, chosen;
  for (double& part : material.reflectance)
  {
    specular.push_back(random.uniform(0, 1) * part);
    part -= specular.back();
  }
  for (std::size_t cell = 0; cell < material.numberOfCells; ++cell)
  {
    chosen.push_back(exponents[random.engine() % exponents.size()]);
  }
  material.setSpecular(specular, chosen);
  object.material = std::make_shared<Material>(material);
  return object;
}

/// A furnace of 4 x 3 x 5 m, 4 x 4 cells a wall, with a ball of n bands in it.
inline SceneObjects furnaceWithBall(unsigned seed, int n)
{
  RandomVectors random(seed);
  ObjectBuilder thing;
  thing.addSphere({ 0, 0, 0 }, 0.8, n, {});
  const SceneObject room = furnace(plainRoom({ 4, 3, 5 }, 4, {}), random);
  return { room, { furnace(thing, random, false, shift({ 1.5, 1.2, 2 })) } };
}

/// A light table of 2 m in the middle of a floor of 6 m, all at z = 0, a lamp in the lid of a box
/// that stands on the floor, and a ceiling.
inline SceneObject lightTable()
{
  ObjectBuilder floor;
  floor.addQuad({ -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 }, 3, 3, grey(0.3));
  floor.addQuad({ -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 5, 5, grey(0.5, 10));
  floor.addBox(box({ 1.5, 1.5, 0 }, { 2.5, 2.5, 1 }), 2, grey(0.6));
  floor.addQuad({ 1.75, 1.75, 1 }, { 0.5, 0, 0 }, { 0, 0.5, 0 }, 1, 1, grey(0.5, 20));
  floor.addQuad({ -3, -3, 3 }, { 0, 6, 0 }, { 6, 0, 0 }, 3, 3, grey(0.8));
  return floor.build();
}

/// A cube with a corner at the origin.
inline SceneObject makeBox(double size)
{
  ObjectBuilder builder;
  builder.addBox(box({ 0, 0, 0 }, { size, size, size }), 2, grey(0.7));
  return builder.build();
}

/// A closed room with a point light and a shade `height` m below the light: the less light is left,
/// the more walks a target takes.
inline SceneObjects shadedRoom(double height)
{
  static const SceneObjects objects = [] {
    ObjectBuilder room = plainRoom({ 4, 4, 4 }, 2, grey(0.3));
    room.addPointLight({ 2, 2, 2 }, 100);
    return SceneObjects{ room.build(), { block({ 0, 0, 0 }, { 0.5, 0.5, 0.02 }, 1, grey(0.1)) } };
  }();
  SceneObjects shaded = objects;
  shaded.dynamicObjects[0].worldFromObject = shift({ 2, 2, 2 - height });
  return shaded;
}

/// A point light and a ball in a room of 4 m around the origin.
inline SceneObjects ballInARoom(double ofRoom, double ofBall)
{
  ObjectBuilder room;
  room.addBox(box({ -2, -2, -2 }, { 2, 2, 2 }), 2, grey(ofRoom), true);
  room.addPointLight({ 1.5, 1.5, 1.5 }, 3);
  return { room.build(), { ball({ 0, 0, 0 }, 0.7, 4, grey(ofBall)) } };
}

/// A room of large cells with a lamp on its floor, a statue of small cells, and a coarse and a fine
/// part that move.
inline SceneObjects roomWithStatue(const Vector3& corner, int bands = 1)
{
  const AffineMap place = shift(corner);
  ObjectBuilder room(bands);
  const auto at = [&](const Vector3& lower, const Vector3& upper) {
    return box(place(lower), place(upper));
  };
  const Look shiny{ { 0.3, 0.3, 0.3 }, {}, { 0.3, 0.2, 0.1 }, 10 };
  room.addBox(at({ 0, 0, 0 }, { 4, 3, 4 }), 6, grey(0.6), true);
  room.addBox(at({ 0.5, 0.5, 0 }, { 1, 1, 0.25 }), 1, grey(0.5, 6));
  room.addBox(at({ 2, 1, 0.5 }, { 2.5, 1.5, 1.5 }), 5, bands > 1 ? shiny : grey(0.5));
  ObjectBuilder coarse(bands);
  coarse.addBox(box({ -0.25, -0.25, 0 }, { 0.25, 0.25, 0.5 }), 1, grey(0.4));
  return { room.build(),
    { coarse.build(shift(place({ 3, 2, 1 }))),
      ball(place({ 1, 2, 3 }), 0.3, 4, grey(0.7), bands) } };
}

/// A scene whose dynamic objects have small cells, which gather.
struct GatherTestScene
{
  const char* name;
  SceneObjects objects;
  /// What all of these receive where that is known by a closed form, W/m2; else 0.
  double truth = 0;
};

/// A spot of light that is smaller than the cells of the floor.
inline SceneObjects spotRoom(int n)
{
  ObjectBuilder builder = plainRoom({ 8, 8, 8 }, n, grey(0.6));
  addPanel(builder, { 4.7, 2.7, 1 }, 0.6, 0.6, 30);
  return { builder.build(), { ball({ 3.7, 4.9, 3.5 }, 0.7, 4) } };
}

/// What rays of a final gather may meet: closed forms, lamps of all kinds, corners, gloss, sides,
/// parts that cross.
inline std::vector<GatherTestScene> gatherScenes()
{
  const SceneObject small = ball({ 2.4, 1.5, 1 }, 0.4, 4);
  ObjectBuilder insideOfFurnace;
  insideOfFurnace.addSphere({ 0, 0, 0 }, 0.5, 4, {});
  std::vector<GatherTestScene> scenes{
    { "furnace",
      { furnace(plainRoom({ 4, 3, 5 }, 3, {}), 0.6),
        { furnace(insideOfFurnace, 0.7, shift({ 1, 1.5, 2 })) } },
      1 },
    { "area lamp", { litRoom(4).build(), { small } } }, { "spot", spotRoom(4) },
    { "gloss", { litRoom(4, 1, 0.4).build(), { small } } },
    { "bands", { litRoom(4, 3).build(), { ball({ 2.4, 1.5, 1 }, 0.4, 4, grey(0.5), 3) } } },
    { "corner", { litRoom(4).build(), { block({ 0.2, 0.2, 0.2 }, { 0.2, 0.2, 0.2 }, 2) } } },
    { "buried", { litRoom(4).build(), { block({ 2.4, 1.5, 0 }, { 0.3, 0.3, 0.3 }, 2) } } },
    { "crossing",
      { litRoom(4).build(),
        { block({ 2.4, 1.5, 1 }, { 0.3, 0.3, 0.3 }, 2),
          block({ 2.6, 1.6, 1.1 }, { 0.3, 0.3, 0.3 }, 2) } } }
  };
  ObjectBuilder points = variedRoom(4), strip = variedRoom(4), sheet;
  points.addPointLight({ 1, 1, 1.5 }, 30);
  points.addPointLight({ 3, 3, 2.5 }, 20);
  scenes.push_back({ "points", { points.build(), { small } } });
  strip.addQuad({ 0.5, 1.2, 0.04 }, { 0, 1.6, 0 }, { 0.08, 0, 0.08 }, 1, 1, grey(0, 100));
  scenes.push_back({ "near lamp", { strip.build(), { ball({ 1.9, 2, 0.6 }, 0.4, 4) } } });
  sheet.addQuad({ -0.3, -0.3, 0 }, { 0.6, 0, 0.2 }, { 0, 0.6, 0.1 }, 4, 4, grey(0.5));
  ObjectBuilder warm = plainRoom({ 4, 4, 3 }, 4, grey(0.5, 2));
  addPanel(warm, { 1.2, 1.6, 2.9 }, 1.2, 0.8, 60);
  scenes.push_back({ "warm walls", { warm.build(), { small } } });
  ObjectBuilder bulb = variedRoom(4);
  bulb.addSphere({ 2, 2, 2.8 }, 0.05, 8, grey(0.5, 500));
  scenes.push_back({ "bulb", { bulb.build(), { small } } });
  scenes.push_back({ "sheet", { litRoom(4).build(), { sheet.build(shift({ 2.4, 1.5, 1 })) } } });
  return scenes;
}

/**
 * A room of 4 x 4 x 4 m with a lamp and a point light, and six dynamic objects: a rigid box, a
 * sheared sphere, a mirrored box that sticks through a wall, a sphere that leaves the room and
 * comes back, one that deforms, and one with isFlattened set. In each frame some of them rest. If
 * `isGlossy`, the walls have a wide lobe, and the objects are mirrors in part.
 */
class MovingScene
{
public:
  static constexpr int kObjects = 6;

  MovingScene(int bands, bool isClosed, unsigned seed, bool isGlossy = false)
    : bands_(bands)
    , random_(seed)
  {
    if (isGlossy)
    {
      wallLook_.specular = { 0.3, 0.2, 0.4 };
      wallLook_.exponent = 12;
      objectLook_.specular = { 0.15, 0.7, 0.2 };
    }
    ObjectBuilder room(bands);
    const Box walls = box({ 0, 0, 0 }, { 4, 4, 4 });
    for (int side = 0; side < (isClosed ? 6 : 5); ++side)
    {
      room.addSide(walls, side, 3, wallLook_, true);
    }
    room.addQuad({ 1, 1, 3.75 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1, { {}, { 3, 2, 1 } });
    room.addPointLight({ 3, 1, 2 }, 2);
    objects_.staticObject = room.build();
    for (int i = 0; i < kObjects; ++i)
    {
      objects_.dynamicObjects.push_back(i == 4 ? deformed() : shape(i));
    }
    for (int i = 0; i < kObjects; ++i)
    {
      move(i);
    }
  }

  const SceneObjects& objects() const { return objects_; }

  /// Every object moves with probability 1/2.
  void nextFrame()
  {
    for (int i = 0; i < kObjects; ++i)
    {
      if (random_.engine() % 2 == 0)
      {
        move(i);
      }
    }
  }

private:
  SceneObject shape(int i)
  {
    ObjectBuilder builder(bands_);
    if (i % 2 == 0)
    {
      builder.addBox(box({ -0.5, -0.4, -0.3 }, { 0.5, 0.4, 0.3 }), 2, objectLook_);
    }
    else
    {
      builder.addSphere({ 0, 0, 0 }, 0.5, 4, objectLook_);
    }
    return builder.build({}, i == 5);
  }

  /// The same cells with other points.
  SceneObject deformed()
  {
    if (!deformingSurface_)
    {
      deformingSurface_ = shape(1).material;
    }
    ObjectBuilder builder(bands_);
    builder.addSphere({ 0, 0, 0 }, random_.uniform(0.2, 0.6), 4, objectLook_);
    SceneObject object = builder.build();
    object.material = deformingSurface_;
    return object;
  }

  void move(int i)
  {
    SceneObject& object = objects_.dynamicObjects[static_cast<std::size_t>(i)];
    AffineMap& pose = object.worldFromObject;
    pose.linear = random_.rotation();
    pose.translation = Vector3(2, 2, 2) + 1.3 * random_.inCube();
    switch (i)
    {
      case 1:
        pose.linear(0, 1) += random_.uniform(); // shear
        pose.linear.col(2) *= random_.uniform(0.5, 1.5);
        break;
      case 2:
        pose.linear.col(0) *= -1; // mirrored
        pose.translation[1] = random_.uniform(-0.2, 0.2);
        break;
      case 3:
        pose.translation[0] += random_.engine() % 2 == 0 ? 100 : 0;
        break;
      case 4:
        object = deformed();
        object.worldFromObject = shift(Vector3(2, 2, 2) + random_.inCube());
        break;
      default:
        break;
    }
  }

  Look wallLook_{ { 0.5, 0.7, 0.3 }, {} };
  Look objectLook_{ { 0.8, 0.2, 0.6 }, {} };
  int bands_;
  RandomVectors random_;
  SceneObjects objects_;
  std::shared_ptr<const Material> deformingSurface_;
};

/// A third of the cells of an object reflect otherwise, diffusely, and if `isGlossy` along lobes or
/// as mirrors; if not, no cell does.
inline void paint(SceneObject& object, RandomVectors& random, bool isGlossy = false)
{
  Material now = *object.material;
  const auto bands = static_cast<std::size_t>(now.bands);
  std::vector<double> specular(now.reflectance.size()), exponents(now.numberOfCells, 9);
  specular = now.isSpecular() ? now.specularReflectance : specular;
  exponents = now.isSpecular() ? now.phongExponent : exponents;
  for (std::size_t cell = 0; cell < now.numberOfCells; ++cell)
  {
    const bool isPainted = random.engine() % 3 == 0;
    for (std::size_t i = cell * bands; isPainted && i < (cell + 1) * bands; ++i)
    {
      now.reflectance[i] = random.uniform(0, 0.6);
      specular[i] = random.uniform(0, 0.4);
      exponents[cell] = random.engine() % 2 == 0 ? 9 : kInfinity;
    }
  }
  now.specularReflectance.clear();
  now.phongExponent.clear();
  if (isGlossy)
  {
    now.setSpecular(specular, exponents);
  }
  object.material = std::make_shared<const Material>(now);
}

/// One object of matte parts, as the static one of a filter. What equals `before` is kept.
inline SceneObject merged(
  const std::vector<SceneObject>& parts, const SceneObject& before = nothing())
{
  std::vector<Triangle> triangles;
  Material all;
  Emission emission;
  all.bands = emission.bands = parts.front().material->bands;
  for (const SceneObject& part : parts)
  {
    const Material& own = *part.material;
    all.firstCellOfPart.push_back(all.numberOfCells);
    for (std::size_t i = 0; i < part.mesh().size(); ++i)
    {
      triangles.push_back(transformed(part.worldFromObject, part.mesh()[i]));
      all.cellOfTriangle.push_back(
        static_cast<std::uint32_t>(all.numberOfCells) + own.cellOfTriangle[i]);
    }
    all.numberOfCells += own.numberOfCells;
    all.reflectance.insert(all.reflectance.end(), own.reflectance.begin(), own.reflectance.end());
    emission.exitance.resize(all.reflectance.size());
    if (part.emission)
    {
      std::copy_backward(
        part.emission->exitance.begin(), part.emission->exitance.end(), emission.exitance.end());
    }
  }
  SceneObject object = before;
  if (object.body->mesh().triangles() != triangles)
  {
    object.body = std::make_shared<RigidObject>(TriangleMesh(triangles), CancelPoint(), false);
  }
  if (!(*object.material == all))
  {
    object.material = std::make_shared<const Material>(std::move(all));
  }
  if (!object.emission || !(*object.emission == emission))
  {
    object.emission = std::make_shared<const Emission>(std::move(emission));
  }
  return object;
}

}
