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

SceneObject makeRoom()
{
  constexpr int kCells = 14;
  constexpr double kCell = 4.0 / kCells;
  test::ObjectBuilder room;
  room.addBox(test::box({ 0, 0, 0 }, { 4, 4, 3 }), kCells, {}, true);
  room.addQuad(
    { 5 * kCell, 6 * kCell, 2.95 }, { 0, kCell, 0 }, { 4 * kCell, 0, 0 }, 1, 4, test::grey(0, 100));
  return room.build();
}

/// With a reflectance at random for each cell.
SceneObject painted(const SceneObject& object, test::RandomVectors& random)
{
  Material material = *object.material;
  for (double& reflectance : material.reflectance)
  {
    reflectance = random.uniform(0.05, 0.9);
  }
  SceneObject own = object;
  own.material = std::make_shared<Material>(std::move(material));
  return own;
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
