// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/Touching.h"

#include "Trees/LeafQuery.h"

namespace irradiance
{

std::array<const Vector3*, 3> cornersOf(const Triangle& triangle)
{
  return { &triangle.a, &triangle.b, &triangle.c };
}

std::array<Vector3, 3> inwardOf(const Triangle& t)
{
  const Vector3 normal = t.areaVector().normalized();
  return { normal.cross((t.b - t.a).normalized()), normal.cross((t.c - t.b).normalized()),
    normal.cross((t.a - t.c).normalized()) };
}

Box touchedBox(Box box)
{
  box.inflate(2 * kTouching * box.magnitude());
  return box;
}

Triangle worldTriangle(const SceneObject& object, std::uint32_t triangle)
{
  return transformed(object.worldFromObject, object.body->mesh()[triangle]);
}

Triangle worldTriangle(const SceneObjects& objects, const TriangleId& id)
{
  return worldTriangle(objects[id.object], id.triangle);
}

std::vector<std::uint32_t> trianglesNear(const SceneObject& object, const Box& world)
{
  if (object.isEmpty())
  {
    return {};
  }
  const Matrix3 inverse = object.worldFromObject.linear.inverse();
  const Vector3 center = inverse * (world.center() - object.worldFromObject.translation);
  // The second term is for rounding, here and in the poses.
  const Vector3 reach =
    inverse.cwiseAbs() * (0.5 * world.extent() + Vector3::Constant(kTouching * world.magnitude()));
  return trianglesNear(object.body->tree(), Box{ center - reach, center + reach });
}

}
