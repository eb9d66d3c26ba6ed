// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Meshes/ShellNesting.h"
#include "Surfaces/CoincidentTriangles.h"
#include "Surfaces/ObjectSides.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace irradiance
{

/**
 * Whether light may come to a place where two triangles coincide. None comes from solid matter in
 * which no lamp is, nor from where there is nothing at all: so the feet of what stands on a floor
 * need no rule.
 */
class ContactLight
{
public:
  /// The arguments must outlive it.
  ContactLight(const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint)
    : objects_(objects)
    , sides_(sides)
    , cancelPoint_(cancelPoint)
  {
    ThrottledCancelPoint pace(cancelPoint);
    for (std::uint32_t i = 0; i < objects.size(); ++i)
    {
      const SceneObject& object = objects[i];
      scene_.add(object.worldBounds());
      if (!object.isPresent || !object.emits())
      {
        continue;
      }
      for (const PointSource& source : object.emission->points)
      {
        const Vector3 place = object.worldFromObject(source.position);
        lamps_.push_back({ place, place });
      }
      for (std::uint32_t k = 0; k < object.mesh().size(); ++k)
      {
        pace.step();
        if (object.isLamp(k))
        {
          lamps_.push_back(worldTriangle(object, k).bounds());
        }
      }
    }
    for (const Box& lamp : lamps_)
    {
      scene_.add(lamp);
    }
    scene_.add(objects.sky ? objects.sky->lit : Box());
  }

  /// From either side of two triangles that coincide.
  bool mayCome(const TriangleId& s, const TriangleId& t)
  {
    if (objects_[s.object].isLamp(s.triangle) || objects_[t.object].isLamp(t.triangle))
    {
      return true;
    }
    const Vector3 normal = worldTriangle(objects_, s).areaVector().normalized();
    const auto isDark = [&](const Vector3& towards) {
      return proveDark(s, towards) || proveDark(t, towards);
    };
    return !isDark(normal) || !isDark(-normal);
  }

private:
  /// Whether a triangle proves that no light comes from the side to which a normal points.
  bool proveDark(const TriangleId& id, const Vector3& normal)
  {
    const Triangle triangle = worldTriangle(objects_, id);
    const double tolerance = 4 * kTouching * triangle.bounds().magnitude();
    const double farthest =
      normal.dot(scene_.center() - triangle.a) + 0.5 * normal.cwiseAbs().dot(scene_.extent());
    if (farthest <= tolerance)
    {
      return true; // nothing is there
    }
    const SolidSides& sides = sides_.of(objects_, id.object, cancelPoint_);
    const bool isInFront = triangle.areaVector().dot(normal) > 0;
    const SolidSide side = sides.of[id.triangle];
    return side == (isInFront ? SolidSide::InFront : SolidSide::Behind) &&
      isMatterDark(id.object, sides.shellOf[id.triangle]);
  }
  /// Whether there is light neither in a body nor outside a room.
  bool isMatterDark(std::uint32_t object, std::uint32_t shell)
  {
    const auto [found, isNew] = isDark_.try_emplace({ object, shell }, false);
    if (isNew)
    {
      found->second = isMatterDark(objects_[object], sides_[object].shells[shell]);
    }
    return found->second;
  }
  /// What the bounds of a room hold is known to be inside only if the room fills them.
  bool isMatterDark(const SceneObject& object, const Shell& shell) const
  {
    if (shell.isRoom && objects_.sky)
    {
      return false; // it is the outside
    }
    const Box bounds = touchedBox(movedBox(object.worldFromObject, shell.bounds));
    const bool isBox = shell.volume > (1 - 0x1p-20) * shell.bounds.extent().prod();
    const auto isElsewhere = [&](const Box& lamp) {
      return shell.isRoom ? isBox && holds(bounds, lamp) : bounds.intersection(lamp).isEmpty();
    };
    return std::all_of(lamps_.begin(), lamps_.end(), isElsewhere);
  }

  const SceneObjects& objects_;
  ObjectSides& sides_;
  const CancelPoint& cancelPoint_;
  Box scene_;              ///< of all that is there, and all lamps
  std::vector<Box> lamps_; ///< of each
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> isDark_; ///< by object and shell
};

}
