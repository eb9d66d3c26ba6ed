// SPDX-License-Identifier: BSD-3-Clause
#include "Surfaces/ObjectSides.h"

#include "Meshes/ShellNesting.h"
#include "Trees/SimpleShells.h"

#include <algorithm>
#include <utility>

namespace irradiance
{

namespace
{

/// A surface that lets light through anywhere is a sheet: there is light on both sides.
void open(const Material& material, SolidSides& sides)
{
  for (std::size_t i = 0; material.hasSheets() && i < sides.of.size(); ++i)
  {
    Shell& shell = sides.shells[sides.shellOf[i]];
    shell.isClosed = shell.isClosed && !material.transmits(material.cellOfTriangle[i]);
  }
  for (std::size_t i = 0; material.hasSheets() && i < sides.of.size(); ++i)
  {
    Shell& shell = sides.shells[sides.shellOf[i]];
    if (!shell.isClosed)
    {
      shell.isRoom = shell.isOutermost = false;
      sides.of[i] = SolidSide::None;
    }
  }
}

SolidSides solidSidesOf(const SceneObject& object, bool isStatic, const CancelPoint& cancelPoint)
{
  std::vector<Triangle> triangles = object.body->mesh().triangles();
  if (object.isMirrored())
  {
    std::for_each(triangles.begin(), triangles.end(), [](Triangle& t) { std::swap(t.b, t.c); });
  }
  std::vector<bool> lamps;
  std::vector<std::uint32_t> parts;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    lamps.push_back(object.isLamp(i));
    parts.push_back(object.material->partOfCell(object.material->cellOfTriangle[i]));
  }
  SolidSides sides = solidSides(triangles, parts, lamps, isStatic, cancelPoint);
  open(*object.material, sides);
  return sides;
}

}

std::vector<SolidSide> solidSidesInModel(
  const SceneObject& object, bool isStatic, const CancelPoint& cancelPoint)
{
  std::vector<SolidSide> sides = solidSidesOf(object, isStatic, cancelPoint).of;
  for (std::size_t i = 0; object.isMirrored() && i < sides.size(); ++i)
  {
    sides[i] = sides[i] == SolidSide::None ? SolidSide::None
      : sides[i] == SolidSide::Behind      ? SolidSide::InFront
                                           : SolidSide::Behind;
  }
  return sides;
}

const SolidSides& ObjectSides::of(
  const SceneObjects& objects, std::uint32_t object, const CancelPoint& cancelPoint)
{
  known_.resize(objects.size());
  Known& known = known_[object];
  if (!isSameThing(known.object, objects[object]) || known.sides.of.empty() ||
    known.object.isMirrored() != objects[object].isMirrored())
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

bool linesAnother(const SceneObjects& objects, std::uint32_t object, const Shell& shell,
  ObjectSides& sides, const CancelPoint& cancelPoint)
{
  const Box bounds = movedBox(objects[object].worldFromObject, shell.bounds);
  bool isInside = false;
  for (std::uint32_t i = 0; shell.isTurned && !isInside && i < objects.size(); ++i)
  {
    if (i != object && !objects[i].isEmpty() && holds(objects[i].worldBounds(), bounds))
    {
      const std::vector<Shell>& shells = sides.of(objects, i, cancelPoint).shells;
      isInside = std::any_of(shells.begin(), shells.end(), [&](const Shell& other) {
        return other.isClosed && !other.isTurned &&
          holds(movedBox(objects[i].worldFromObject, other.bounds), bounds);
      });
    }
  }
  return isInside;
}

}
