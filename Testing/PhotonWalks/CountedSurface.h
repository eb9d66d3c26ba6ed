// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleInSphere.h"
#include "Photons/Foot.h"
#include "Surfaces/Contacts.h"

#include <optional>
#include <vector>

namespace irradiance::test
{

/// Which surface counts for a sensor, by a look at all triangles and by the words of Theory.md,
/// 5.4.
class CountedSurface
{
public:
  explicit CountedSurface(const SceneObjects& objects)
    : objects_(objects)
  {
    for (std::uint32_t i = 0; i < objects.size(); ++i)
    {
      solid_.push_back(solidSidesInModel(objects[i], i == 0, {}));
    }
  }

  std::optional<Foot> footOf(const Sensor& sensor) const
  {
    std::optional<Foot> outside, inside;
    for (std::uint32_t object = 0; object < objects_.size(); ++object)
    {
      for (std::uint32_t i = 0; i < objects_[object].body->mesh().size(); ++i)
      {
        const TriangleId id{ object, i };
        const int side = sideFacing(sensor, id);
        if (side == 0 || !objects_[object].isPresent)
        {
          continue;
        }
        const Vector3 closest = closestPoint(seenFrom(sensor.position, id));
        std::optional<Foot>& nearest = isIn(id, side) ? inside : outside;
        if (!nearest || closest.norm() < nearest->distance)
        {
          nearest = Foot{ { sensor.position + closest, sensor.normal }, side * frontOf(id),
            isIn(id, side), closest.norm(), sizeOf(object) };
        }
      }
    }
    return outside && (!inside || outside->distance <= 2 * inside->distance) ? outside : inside;
  }

  bool counts(const Foot& foot, const TriangleId& id, int side) const
  {
    if (sideFacing(foot.sensor, id) != side || isIn(id, side) != foot.isInside)
    {
      return false;
    }
    const Vector3 closest = closestPoint(seenFrom(foot.sensor.position, id));
    const double blur = 0x1p-20 * (foot.size + sizeOf(id.object)) +
      0x1p-48 * foot.sensor.position.norm() + 0x1p-10 * closest.norm();
    const double itsHeight = foot.normal.dot(closest);
    const double ours = -side * frontOf(id).dot(closest);
    return std::abs(itsHeight) <= blur || std::abs(ours) <= blur || itsHeight * ours > 0;
  }

  /// 0: neither side faces as the sensor does.
  int sideFacing(const Sensor& sensor, const TriangleId& id) const
  {
    const double cosine = frontOf(id).dot(sensor.normal);
    return std::abs(cosine) < Facing::kLeastCosine ? 0 : cosine > 0 ? 1 : -1;
  }

private:
  Triangle seenFrom(const Vector3& position, const TriangleId& id) const
  {
    const SceneObject& object = objects_[id.object];
    return transformed(
      { object.worldFromObject.linear, object.worldFromObject.translation - position },
      object.body->mesh()[id.triangle]);
  }
  /// Corners far from the origin are rounded more than the normal.
  Vector3 frontOf(const TriangleId& id) const
  {
    return seenFrom(objects_[id.object].worldFromObject.translation, id).areaVector().normalized();
  }
  bool isIn(const TriangleId& id, int side) const
  {
    return isInside(solid_[id.object][id.triangle], side,
      objects_[id.object].worldFromObject.linear.determinant() < 0);
  }
  double sizeOf(std::uint32_t object) const
  {
    return objects_[object].worldBounds().extent().maxCoeff();
  }

  const SceneObjects& objects_;
  std::vector<std::vector<SolidSide>> solid_;
};

}
