// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scene/Scene.h"
#include "Scene/SurfaceRecords.h"

#include "TestMeshes.h"

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

// Scenes of objects under difficult maps, inside each other and in walls; and brute force.

namespace irradiance::test
{

struct NamedScene
{
  std::string name;
  std::shared_ptr<const RigidObject> still;
  std::vector<PlacedBody> objects;

  Scene scene(
    TraversalMode mode, const std::vector<bool>& moved = {}, const Box& pointSources = {}) const
  {
    Scene made;
    made.setPointSources(pointSources);
    made.setStatic(still);
    made.setDynamic(objects);
    made.setTraversalMode(mode);
    made.commit(moved);
    return made;
  }
  SurfaceRecords records() const
  {
    SurfaceRecords records;
    records.update(still, objects);
    return records;
  }
};

inline void PrintTo(const NamedScene& scene, std::ostream* out)
{
  *out << scene.name;
}

/// The total order that makes the closest hit unique in whichever order triangles are visited.
inline bool isCloser(const Hit& a, const Hit& b)
{
  return std::tie(a.distance, a.id) < std::tie(b.distance, b.id);
}

/// The point of a hit. The normal is turned to the side from which a ray of this direction comes.
inline SurfacePoint surfaceAt(const Scene& scene, const Vector3& direction, const Hit& hit)
{
  SurfacePoint point = scene.surfaceOf(hit, true);
  point.turn(direction.dot(point.normal) <= 0);
  return point;
}

/// The closest hit among the chosen objects (0: static) without any tree, if closer than `best`.
inline Hit bruteForce(
  const NamedScene& scene, const Ray& ray, const std::vector<bool>& chosen, Hit best = {})
{
  for (std::uint32_t object = 0; object <= scene.objects.size(); ++object)
  {
    if (!chosen[object])
    {
      continue;
    }
    const RigidObject& body = object == 0 ? *scene.still : *scene.objects[object - 1].body;
    Vector3 origin = ray.origin, direction = ray.direction;
    if (object > 0)
    {
      const AffineMap& worldFromObject = scene.objects[object - 1].worldFromObject;
      const Matrix3 inverse = worldFromObject.linear.inverse();
      origin = inverse * (ray.origin - worldFromObject.translation);
      direction = inverse * ray.direction;
    }
    const ShearedRay sheared(origin, direction);
    for (std::uint32_t i = 0; i < body.mesh().size(); ++i)
    {
      Hit hit{ 0, { object, i } };
      Vector3 weights;
      if (sheared.intersects(body.mesh()[i], hit.distance, &weights) && hit.id != ray.start &&
        isCloser(hit, best))
      {
        best = hit;
        best.weights = { static_cast<float>(weights[1]), static_cast<float>(weights[2]) };
      }
    }
  }
  return best;
}

inline std::shared_ptr<const RigidObject> bodyOf(const Triangles& triangles)
{
  return std::make_shared<RigidObject>(TriangleMesh(triangles));
}

/// A body that rests, with trees of its details.
inline std::shared_ptr<const RigidObject> stillOf(const Triangles& triangles)
{
  return std::make_shared<RigidObject>(TriangleMesh(triangles), CancelPoint(), false);
}

inline Matrix3 stretch(double x, double y, double z)
{
  return Vector3(x, y, z).asDiagonal();
}

/// Rotated, sheared, reflected, flattened a million times; overlapping each other and the walls.
inline NamedScene hardMaps()
{
  RandomVectors random(11);
  const auto turn = [&] { return random.rotation(); };
  const auto box = bodyOf(boxOfCells({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 }, { 2, 2, 2 }));
  const auto ball = bodyOf(icosphere(1)), ring = bodyOf(torus(12, 6));
  const auto heap = bodyOf(randomSoup(60, 12));
  Matrix3 shear = Matrix3::Identity();
  shear(0, 1) = 1.5;
  shear(2, 0) = -0.7;
  return { "hard maps", bodyOf(room()),
    { { box, { turn(), { 1, 1, 1 } } }, { box, { shear, { 2, 1.5, 1 } } },
      { ball, { stretch(-0.6, 0.6, 0.6) * turn(), { 1.5, 1, 1.2 } } },
      { ring, { turn() * stretch(1, 1, 1e-6) * turn(), { 2, 1.2, 0.7 } } },
      { ball, { turn() * stretch(1e-6, 1e-6, 1.5) * turn(), { 2, 1.5, 1 } } },
      { heap, { stretch(0.5, 0.5, 0.5), { 3, 2, 1 } }, true },
      { ring, { turn() * stretch(1, 1e-3, 30) * turn(), { 2, 1.5, 1.2 } }, true },
      { box, { 1e-6 * turn(), { 2.2, 1.1, 0.4 } } },
      { box, { stretch(1, 1, 1), { 0.5, 0.5, 0.5 } } } } }; // its sides lie in the walls
}

/// More objects than any list of recent ones can hold, one of them empty.
inline NamedScene manyObjects()
{
  RandomVectors random(13);
  const auto box = bodyOf(boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 }));
  const auto ball = bodyOf(icosphere(1)), nothing = bodyOf({});
  NamedScene scene{ "many objects", bodyOf(boxOfCells({ 0, 0, 0 }, { 4, 3, 2.5 }, { 4, 3, 2 })),
    {} };
  for (int i = 0; i < 26; ++i)
  {
    const Vector3 center =
      Vector3(2, 1.5, 1.25) + Vector3(1.9, 1.4, 1.2).cwiseProduct(random.inCube());
    const Matrix3 linear = random.powerOfTwo(-3, 0) * random.rotation();
    scene.objects.push_back({ i == 5 ? nothing
        : i % 3 == 0                 ? ball
                                     : box,
      { linear, center }, i % 5 == 4 });
  }
  return scene;
}

/// The same box many times in one place: exactly, or turned by quarters, so that only rounding
/// separates the copies; and once more as static geometry.
inline NamedScene coincidentBoxes(const Matrix3& common, const char* name)
{
  const Triangles box = boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 2, 2, 2 });
  const Vector3 center(0.3, -0.2, 0.1);
  const AffineMap place{ common, center };
  NamedScene scene{ name, bodyOf(moved(box, place)), {} };
  const auto body = bodyOf(box);
  for (int i = 0; i < 12; ++i)
  {
    Matrix3 quarter = Matrix3::Identity();
    for (int k = 0; k < i % 4; ++k)
    {
      const Matrix3 turn = (Matrix3() << 0, -1, 0, 0, 0, 1, -1, 0, 0).finished();
      quarter = turn * quarter;
    }
    scene.objects.push_back({ body, { common * quarter, center }, i % 5 == 3 });
  }
  return scene;
}

inline NamedScene straightCoincidentBoxes()
{
  return coincidentBoxes(Matrix3::Identity(), "coincident boxes");
}

inline NamedScene turnedCoincidentBoxes()
{
  return coincidentBoxes(RandomVectors(14).rotation(), "coincident boxes, turned");
}

inline NamedScene withoutStatic()
{
  NamedScene scene = hardMaps();
  scene.name = "without static";
  scene.still = bodyOf({});
  return scene;
}

/// Far from the origin, where rounding moves a position far compared with the objects.
inline NamedScene farAway()
{
  NamedScene scene = hardMaps();
  scene.name = "far away";
  const Vector3 offset(3e4, -2e4, 1e4);
  scene.still = bodyOf(moved(room(), { Matrix3::Identity(), offset }));
  for (PlacedBody& object : scene.objects)
  {
    object.worldFromObject.translation += offset;
  }
  return scene;
}

/// Flattened so much that the round trip to model space moves a point by 2^-16 of the room. There
/// are few triangles, so that rays often pass where the bounds of an object end.
inline NamedScene nearlyFlat()
{
  RandomVectors random(15);
  const auto body = bodyOf(boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 }));
  NamedScene scene{ "nearly flat", bodyOf(boxOfCells({ 0, 0, 0 }, { 4, 3, 2.5 }, { 1, 1, 1 })),
    {} };
  for (int i = 0; i < 6; ++i)
  {
    const Matrix3 flat = random.rotation() * stretch(1, 1, 1e-11) * random.rotation();
    const Vector3 center = Vector3(2, 1.5, 1.25) + 0.5 * random.inCube();
    scene.objects.push_back({ body, { flat, center }, i % 3 == 0 });
  }
  return scene;
}

/// The round trip to model space moves a point by more than the room: a tree over all triangles
/// extends far beyond them.
inline NamedScene allButSingular()
{
  RandomVectors random(17);
  const Matrix3 flat = random.rotation() * stretch(1, 1, 2e-14) * random.rotation();
  NamedScene scene{ "all but singular", bodyOf(room()), {} };
  const auto body = bodyOf(icosphere(0));
  for (int i = 0; i < 3; ++i)
  {
    scene.objects.push_back({ body, { flat, Vector3(1 + i, 1, 1) } });
  }
  return scene;
}

/// Small objects near the floor of a hall 1e9 times as large, and a flattened one as large as the
/// hall: what is negligible in one tree exceeds the size of another.
inline NamedScene crumbsInAHall()
{
  RandomVectors random(16);
  constexpr double kSize = 1e9;
  Triangles hall = boxOfCells({ -kSize, -kSize, -2 }, { kSize, kSize, kSize }, { 2, 2, 1 });
  append(hall, moved(icosphere(1), { Matrix3::Identity(), Vector3(3, 0, 0) }));
  const auto box = bodyOf(boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 }));
  const auto sail =
    bodyOf(grid(2, 2, [](int i, int j) { return Vector3(kSize * (i - 1), kSize * (j - 1), 0); }));
  NamedScene scene{ "crumbs in a hall", stillOf(hall), {} };
  for (int i = 0; i < 4; ++i)
  {
    scene.objects.push_back(
      { box, { random.powerOfTwo(-3, 0) * random.rotation(), 3 * random.inCube() }, i == 3 });
  }
  // Stretched along z only: the condition, by row sums of |M| |M^-1|, stays 1.
  scene.objects.push_back({ sail, { stretch(1, 1, 8), { 0, 0, -1 } }, true });
  return scene;
}

/// Fine static meshes in a hall of 300 m, which floats of the hall cannot resolve: one in the plane
/// of the floor, one on it, turned, one a thousand times finer near its corner, one twice in the
/// same place, one of equal triangles, and one at a wall. Small things move there.
inline NamedScene detailsInAHall()
{
  RandomVectors random(19);
  Triangles hall = boxOfCells({ -150, -150, 0 }, { 150, 150, 20 }, { 2, 2, 1 });
  const auto plate = [](double size) {
    return grid(8, 8, [size](int i, int j) { return Vector3(size * i / 8, size * j / 8, 0); });
  };
  append(hall, moved(plate(1e-3), { Matrix3::Identity(), Vector3(7, 9, 0) }));
  append(hall, moved(plate(1e-3), { random.rotation(), Vector3(7.0002, 9.0002, 1e-4) }));
  append(hall, moved(plate(1e-6), { random.rotation(), Vector3(7, 9, 2e-6) }));
  const Triangles ball = moved(icosphere(1), { 1e-4 * random.rotation(), Vector3(-40, 3, 5) });
  append(hall, ball);
  append(hall, ball);
  append(hall, Triangles(70, moved(plate(1e-5), { Matrix3::Identity(), Vector3(1, 2, 3) })[0]));
  append(hall, moved(plate(1e-4), { stretch(1, -1, 1), Vector3(150, 150, 20) }));
  NamedScene scene{ "details in a hall", stillOf(hall), {} };
  const auto box = bodyOf(boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 }));
  for (const Vector3& place : { Vector3(7, 9, 0), Vector3(-40, 3, 5), Vector3(7.001, 9.001, 0) })
  {
    scene.objects.push_back({ box, { random.powerOfTwo(-14, -11) * random.rotation(), place } });
  }
  scene.objects.push_back({ box, { 1e-4 * random.rotation(), { 7, 9.0005, 0 } }, true });
  return scene;
}

/// Makes a scene when a test asks for it: each process of tests lists all scenes, and their trees
/// take time.
struct SceneMaker
{
  std::string name;
  std::function<NamedScene()> make;
};

inline void PrintTo(const SceneMaker& maker, std::ostream* out)
{
  *out << maker.name;
}

inline std::vector<SceneMaker> sceneMakers()
{
  return { { "hard maps", hardMaps }, { "nearly flat", nearlyFlat },
    { "all but singular", allButSingular }, { "many objects", manyObjects },
    { "crumbs in a hall", crumbsInAHall }, { "details in a hall", detailsInAHall },
    { "coincident boxes", straightCoincidentBoxes },
    { "coincident boxes, turned", turnedCoincidentBoxes }, { "without static", withoutStatic },
    { "far away", farAway } };
}

inline std::vector<NamedScene> testScenes()
{
  std::vector<NamedScene> scenes;
  for (const SceneMaker& maker : sceneMakers())
  {
    scenes.push_back(maker.make());
  }
  return scenes;
}

}
