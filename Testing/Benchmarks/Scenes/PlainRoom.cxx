// SPDX-License-Identifier: BSD-3-Clause
#include "Scenes/PlainRoom.h"

#include "../../PhotonWalks/TestScenes.h"
#include "../../RayCasting/RandomVectors.h"

#include <cmath>
#include <memory>
#include <utility>

using namespace irradiance;

namespace
{

/// nu x nv quads in two triangles each, which are cells. What has no extent is left out.
template <class Corner>
SceneObject makeMesh(int nu, int nv, const Corner& corner)
{
  test::ObjectBuilder mesh;
  const auto add = [&](const Vector3& a, const Vector3& b, const Vector3& c) {
    if (a != b && b != c && c != a)
    {
      mesh.addCell({ { a, b, c } }, {});
    }
  };
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const Vector3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1),
                    d = corner(i, j + 1);
      add(a, b, c);
      add(a, c, d);
    }
  }
  return mesh.build();
}

SceneObject makeRing(double size)
{
  constexpr int kAround = 100, kAcross = 30;
  return makeMesh(kAround, kAcross, [&](int i, int j) {
    const double around = 2 * M_PI * (i % kAround) / kAround;
    const double across = 2 * M_PI * (j % kAcross) / kAcross;
    const double radius = size * (0.42 + 0.08 * std::cos(across));
    return Vector3(
      radius * std::cos(around), radius * std::sin(around), 0.08 * size * std::sin(across));
  });
}

SceneObject makeBall(double size, int aroundIt = 32, int upIt = 16)
{
  return makeMesh(aroundIt, upIt, [&](int i, int j) {
    const bool isPole = j == 0 || j == upIt;
    const double around = isPole ? 0 : 2 * M_PI * (i % aroundIt) / aroundIt, up = M_PI * j / upIt;
    const double radius = 0.5 * size * (0.85 + 0.15 * std::cos(3 * around) * std::sin(up));
    const double across = isPole ? 0 : std::sin(up);
    return Vector3(
      radius * Vector3(across * std::cos(around), across * std::sin(around), -std::cos(up)));
  });
}

constexpr int kCells = 14; // along a wall

void addWalls(test::ObjectBuilder& room)
{
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), kCells, {}, true);
}

void addLamp(test::ObjectBuilder& room)
{
  constexpr double kCell = 4.0 / kCells;
  room.addQuad(
    { 5 * kCell, 6 * kCell, 2.95 }, { 0, kCell, 0 }, { 4 * kCell, 0, 0 }, 1, 4, test::grey(0, 100));
}

void addPointLights(test::ObjectBuilder& room)
{
  for (const Vector3& place :
    { Vector3(1, 1, 2.8), Vector3(3, 1, 2.5), Vector3(1, 3, 2), Vector3(3, 3, 0.3) })
  {
    room.addPointLight(place, 8);
  }
}

/// The first `count` squares of n x n, below the ceiling.
void addPanels(test::ObjectBuilder& room, int n, int count, double edge)
{
  for (int i = 0; i < count; ++i)
  {
    const int column = i % n, row = i / n;
    const double x = 4 * (column + 0.5) / n, y = 4 * (row + 0.5) / n;
    room.addQuad({ x - edge / 2, y - edge / 2, 2.98 }, { 0, edge, 0 }, { edge, 0, 0 }, 1, 1,
      test::grey(0, 100));
  }
}

/// 5 cm wide, 5 cm over the floor, on which it shines.
void addSmallLamp(test::ObjectBuilder& room, double watts)
{
  room.addQuad(
    { 2.6, 2.6, 0.05 }, { 0, 0.05, 0 }, { 0.05, 0, 0 }, 1, 1, test::grey(0, watts / (0.05 * 0.05)));
}

/// 5 cm from a wall, on which it shines.
void addStrip(test::ObjectBuilder& room, double watts)
{
  room.addQuad(
    { 0.2, 0.05, 2 }, { 3.6, 0, 0 }, { 0, 0, 0.03 }, 1, 1, test::grey(0, watts / (3.6 * 0.03)));
}

SceneObject makeRoom()
{
  test::ObjectBuilder room;
  addWalls(room);
  addLamp(room);
  return room.build();
}

/// `reflectance(cell)` of each cell.
template <class Reflectance>
SceneObject reflecting(const SceneObject& object, const Reflectance& reflectance)
{
  Material material = *object.material;
  for (std::size_t cell = 0; cell < material.reflectance.size(); ++cell)
  {
    material.reflectance[cell] = reflectance(cell);
  }
  SceneObject own = object;
  own.material = std::make_shared<Material>(std::move(material));
  return own;
}

/// With a reflectance at random for each cell.
SceneObject painted(
  const SceneObject& object, test::RandomVectors& random, double lower = 0.05, double upper = 0.9)
{
  return reflecting(object, [&](std::size_t) { return random.uniform(lower, upper); });
}

/// Each wall of a room, the floor, the ceiling, and all that hangs in it have a reflectance each.
double reflectanceOfReal(std::size_t cell)
{
  constexpr double kSides[] = { 0.6, 0.6, 0.5, 0.5, 0.3, 0.8 };
  const std::size_t side = cell / (kCells * kCells);
  return side < 6 ? kSides[side] : 0.5;
}

/// With a lobe on that share of the cells.
std::shared_ptr<const Material> glossy(Material material, double share, test::RandomVectors& random)
{
  std::vector<double> specular;
  for (const double diffuse : material.reflectance)
  {
    specular.push_back(random.uniform(0, 1) < share ? 0.5 * (1 - diffuse) : 0.0);
  }
  material.setSpecular(specular, std::vector<double>(material.numberOfCells, 50.0));
  return std::make_shared<const Material>(std::move(material));
}

}

MovingScene makePlainRoom(double size)
{
  test::RandomVectors random(5);
  SceneObjects objects{ painted(makeRoom(), random),
    { painted(makeRing(size), random), painted(makeBall(0.8), random) } };
  return { "plain room", std::move(objects), [](SceneObjects& placed, double time) {
            // 2 cm and 1.5 degrees a frame, beside the ball and aside of the lamp.
            const double angle = 0.5 * M_PI * (1 + time);
            placed.dynamicObjects[0].worldFromObject = {
              Eigen::AngleAxisd(angle, Vector3(1, 2, 2) / 3).toRotationMatrix(),
              Vector3(2 + 0.8 * std::cos(angle), 2 + 0.8 * std::sin(angle), 1)
            };
            placed.dynamicObjects[1].worldFromObject = test::shift({ 3.2, 1, 0.6 });
          } };
}

std::vector<MovingScene> makeGatheringRooms()
{
  const auto lit = [](const std::string& name, const auto& addLights) {
    test::RandomVectors random(5);
    test::ObjectBuilder room;
    addWalls(room);
    addLights(room);
    MovingScene scene = makePlainRoom();
    scene.name = name;
    scene.objects.staticObject = painted(room.build(), random);
    return scene;
  };
  const auto between = [](const std::string& name, double lower, double upper) {
    test::RandomVectors random(5);
    MovingScene scene = makePlainRoom();
    scene.name = name;
    scene.objects.staticObject = painted(scene.objects.staticObject, random, lower, upper);
    for (SceneObject& object : scene.objects.dynamicObjects)
    {
      object = painted(object, random, lower, upper);
    }
    return scene;
  };
  MovingScene real = makePlainRoom();
  real.name = "real";
  real.objects.staticObject = reflecting(real.objects.staticObject, reflectanceOfReal);
  for (SceneObject& object : real.objects.dynamicObjects)
  {
    object = reflecting(object, [](std::size_t) { return 0.5; });
  }
  return { makePlainRoom(), real, between("bright", 0.7, 0.9), between("dark", 0.1, 0.3),
    lit("points", addPointLights),
    lit("lamps64",
      [](test::ObjectBuilder& room) {
        addPanels(room, 8, 64, 0.15);
        addSmallLamp(room, 2.25);
      }),
    lit("lamps16", [](test::ObjectBuilder& room) {
      addPanels(room, 4, 14, 0.25);
      addSmallLamp(room, 6.25);
      addStrip(room, 6.25);
    }) };
}

MovingScene makeRoomOfMovers(int movers, double size)
{
  test::RandomVectors random(7);
  const SceneObject ball = painted(makeBall(size, 20, 9), random);
  SceneObjects objects{ painted(makeRoom(), random), {} };
  objects.dynamicObjects.assign(static_cast<std::size_t>(movers), ball);
  return { std::to_string(movers) + " movers", std::move(objects),
    [](SceneObjects& placed, double time) {
      // Each on a circle of its own, 2 cm a frame.
      int i = 0;
      for (SceneObject& object : placed.dynamicObjects)
      {
        const auto at = [&](double step) { return std::fmod(step * ++i, 1.0); };
        const Vector3 middle(
          0.5 + 3 * at(0.8191725134), 0.5 + 3 * at(0.6710436067), 0.2 + 2.5 * at(0.5497004779));
        const double angle = 2 * M_PI * at(0.4301597090) + 5 * time;
        object.worldFromObject =
          test::shift(middle + 0.24 * Vector3(std::cos(angle), std::sin(angle), 0));
      }
    } };
}

MovingScene makeGlossyRoom(double share, double size)
{
  test::RandomVectors random(6);
  MovingScene room = makePlainRoom(size);
  SceneObjects& objects = room.objects;
  objects.staticObject.material = glossy(*objects.staticObject.material, share, random);
  for (SceneObject& object : objects.dynamicObjects)
  {
    object.material = glossy(*object.material, share, random);
  }
  return room;
}
