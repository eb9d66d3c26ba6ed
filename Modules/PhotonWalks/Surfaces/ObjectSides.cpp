// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ObjectSides.h"

#include "Trees/SimpleShells.h"

namespace irradiance
{

SolidSides solidSidesOf(const SceneObject& object, bool isStatic, const CancelPoint& cancelPoint)
{
  const std::vector<Triangle>& triangles = object.body->mesh().triangles();
  std::vector<bool> lamps;
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    lamps.push_back(object.isLamp(i));
    parts.push_back(object.material->partOfCell(object.material->cellOfTriangle[i]));
  }
  return solidSides(triangles, parts, lamps, isStatic, cancelPoint);
}

const SolidSides& ObjectSides::of(
  const SceneObjects& objects, std::uint32_t object, const CancelPoint& cancelPoint)
{
  known_.resize(objects.size());
  Known& known = known_[object];
  if (!isSameThing(known.object, objects[object]) || known.sides.of.empty())
  {
    known = { objects[object], solidSidesOf(objects[object], object == 0, cancelPoint), false };
  }
  return known.sides;
}

void ObjectSides::find(const SceneObjects& objects, const CancelPoint& cancelPoint)
{
  for (std::uint32_t object = 1; object < objects.size(); ++object)
  {
    of(objects, object, cancelPoint);
    Known& known = known_[object];
    if (!known.isSimpleKnown)
    {
      const RigidObject& body = *objects[object].body;
      markSimpleShells(known.sides, body.mesh().triangles(), body.tree(), cancelPoint);
      known.isSimpleKnown = true;
    }
  }
}

}
