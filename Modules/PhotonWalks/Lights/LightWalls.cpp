// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/LightWalls.h"

#include "Surfaces/Touching.h"

#include <algorithm>

namespace irradiance
{

namespace
{

bool liesOn(const Triangle& triangle, const Vector3& point, double tolerance)
{
  const auto corners = cornersOf(triangle);
  const auto inward = inwardOf(triangle);
  bool isOn = std::abs(triangle.areaVector().normalized().dot(point - triangle.a)) <= tolerance;
  for (std::size_t i = 0; i < 3; ++i)
  {
    isOn = isOn && inward[i].dot(point - *corners[i]) >= -4 * tolerance;
  }
  return isOn;
}

/// +1 if a mesh is on the front side of the triangle's plane alone, -1 if on the back side, else 0.
int sideOfAll(const TriangleMesh& mesh, const Triangle& triangle, double tolerance,
  const CancelPoint& cancelPoint)
{
  ThrottledCancelPoint pace(cancelPoint);
  const Vector3 normal = triangle.areaVector().normalized();
  bool isInFront = false, isBehind = false;
  for (const Triangle& other : mesh.triangles())
  {
    pace.step();
    for (const Vector3* corner : cornersOf(other))
    {
      const double distance = normal.dot(*corner - triangle.a);
      isInFront = isInFront || distance > 8 * tolerance;
      isBehind = isBehind || distance < -8 * tolerance;
    }
  }
  return (isInFront ? 1 : 0) - (isBehind ? 1 : 0);
}

std::vector<Wall> wallsAt(const SceneObjects& objects, const Vector3& light, ObjectSides& solid,
  const CancelPoint& cancelPoint)
{
  const TriangleMesh& building = objects.staticObject.body->mesh();
  std::vector<Wall> walls;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    for (const std::uint32_t i : trianglesNear(objects[object], touchedBox({ light, light })))
    {
      const Triangle triangle = worldTriangle(objects, { object, i });
      const double tolerance =
        kTouching * std::max(triangle.bounds().magnitude(), light.cwiseAbs().maxCoeff());
      if (!liesOn(triangle, light, tolerance))
      {
        continue;
      }
      const SolidSides& sides = solid.of(objects, object, cancelPoint);
      const Vector3 front = triangle.areaVector().normalized();
      const int open = sides.of[i] == SolidSide::None
        ? sideOfAll(building, triangle, tolerance, cancelPoint)
        : (sides.of[i] == SolidSide::Behind ? 1 : -1);
      // A body that encloses everything can only be a room.
      const bool isRoomAfterAll = object == 0 && sides.shell(i).isOutermost &&
        sideOfAll(building, triangle, tolerance, cancelPoint) == -open;
      const bool isCavity = sides.of[i] == SolidSide::InFront &&
        linesAnother(objects, object, sides.shell(i), solid, cancelPoint);
      const Vector3 normal = (isRoomAfterAll || isCavity ? -open : open) * front;
      const bool isKnown = std::any_of(walls.begin(), walls.end(),
        [&](const Wall& wall) { return (wall.normal - normal).squaredNorm() < 0x1p-40; });
      if (open != 0 && !isKnown)
      {
        walls.push_back({ normal, normal.dot(light - triangle.a), 0.5 * tolerance });
      }
    }
  }
  return walls;
}

}

LightWalls lightWallsOf(
  const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint)
{
  LightWalls walls(objects.size());
  for (std::uint32_t i = 0; i < objects.size(); ++i)
  {
    const SceneObject& object = objects[i];
    for (std::size_t k = 0;
         object.isPresent && object.emits() && k < object.emission->points.size(); ++k)
    {
      walls[i].push_back(wallsAt(
        objects, object.worldFromObject(object.emission->points[k].position), sides, cancelPoint));
    }
  }
  return walls;
}

}
