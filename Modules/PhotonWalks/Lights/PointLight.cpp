// SPDX-License-Identifier: BSD-3-Clause
#include "Lights/PointLight.h"

#include "Sampling/DirectionSampling.h"
#include "Surfaces/CoincidentTriangles.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

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

std::vector<Vector3>::const_iterator firstBehind(
  const std::vector<Vector3>& openSides, const Vector3& direction)
{
  return std::find_if(openSides.begin(), openSides.end(),
    [&](const Vector3& side) { return side.dot(direction) < 0; });
}

constexpr int kMostMirrors = 256; // walls at an acute angle take several

Vector3 mirroredAt(const Vector3& normal, const Vector3& direction)
{
  return direction - 2 * normal.dot(direction) * normal;
}

/// Mirrors a direction at walls until it points to the open side of all; false if it never does.
bool mirrorInto(const std::vector<Vector3>& openSides, Vector3& direction)
{
  for (int i = 0; i < kMostMirrors; ++i)
  {
    const auto wall = firstBehind(openSides, direction);
    if (wall == openSides.end())
    {
      return true;
    }
    direction = mirroredAt(*wall, direction);
  }
  return false;
}

/// How many directions mirrorInto() takes to this one, itself among them.
int numberMirroredInto(
  const std::vector<Vector3>& openSides, const Vector3& direction, int mirrors = 0)
{
  int number = 1;
  for (auto wall = openSides.begin(); wall != openSides.end() && mirrors < kMostMirrors; ++wall)
  {
    const Vector3 before = mirroredAt(*wall, direction);
    if (firstBehind(openSides, before) == wall)
    {
      number += numberMirroredInto(openSides, before, mirrors + 1);
    }
  }
  return number;
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

PointLight::PointLight(const Vector3& position, const std::vector<Wall>& walls,
  std::shared_ptr<const IntensityDistribution> distribution)
  : ofLuminaire(std::move(distribution))
  , position_(position)
{
  for (const Wall& wall : walls)
  {
    position_ += std::max(0.0, wall.clearance - wall.distance) * wall.normal;
    openSides_.push_back(wall.normal);
  }
  Vector3 direction(0.48, 0.6, 0.64);
  if (!mirrorInto(openSides_, direction))
  {
    std::ostringstream text;
    text << "the point light at (" << position_.transpose()
         << ") lies in the planes of walls that leave it no side to shine into";
    throw std::runtime_error(text.str());
  }
}

Ray PointLight::leaving(
  const std::array<double, 2>& /*place*/, const std::array<double, 2>& direction) const
{
  if (ofLuminaire)
  {
    return { position_, ofLuminaire->sample(direction), {} };
  }
  Vector3 shining = sampleSphere(direction);
  mirrorInto(openSides_, shining);
  return { position_, shining, {} };
}

double PointLight::density(const Vector3& direction) const
{
  constexpr double kSphere = 4 * kPi;
  if (ofLuminaire)
  {
    return ofLuminaire->intensity(direction);
  }
  return firstBehind(openSides_, direction) == openSides_.end()
    ? numberMirroredInto(openSides_, direction) / kSphere
    : 0;
}

}
