// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/SolidSides.h"
#include "Surfaces/SceneObjects.h"

#include <vector>

namespace irradiance
{

/// The solid sides of an object's triangles, of their fronts in its own space. The static object
/// may hold rooms.
std::vector<SolidSide> solidSidesInModel(
  const SceneObject& object, bool isStatic, const CancelPoint& cancelPoint);

/// The solid sides of all objects, of fronts as a pose leaves them: one that mirrors turns them
/// over. Bounds are in an object's own space. They are found when first asked for, and hold while
/// its body, material and emission stay.
class ObjectSides
{
public:
  const SolidSides& of(
    const SceneObjects& objects, std::uint32_t object, const CancelPoint& cancelPoint);

  /// Those of the dynamic objects, for the operator below, with which of their shells are simple.
  void find(const SceneObjects& objects, const CancelPoint& cancelPoint);
  /// Must be known.
  const SolidSides& operator[](std::uint32_t object) const { return known_[object].sides; }

private:
  struct Known
  {
    SceneObject object; ///< as it was
    SolidSides sides;
    bool isSimpleKnown = false; ///< which of the shells are simple
  };

  std::vector<Known> known_;
};

/// Whether a shell lines a cavity in another thing: its front is inside, and a body is around it.
bool linesAnother(const SceneObjects& objects, std::uint32_t object, const Shell& shell,
  ObjectSides& sides, const CancelPoint& cancelPoint);

}
