// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Photons/PlacedTree.h"

#include <memory>
#include <optional>
#include <vector>

namespace irradiance
{

/// The surfaces of all objects, each in its own space, so that a motion changes nothing here.
class Surfaces
{
public:
  /// Updates them to a frame. The surface of an object with the same body and material stays.
  void update(const SceneObjects& objects, const CancelPoint& cancelPoint = {});

  /// Forgets the surfaces of objects that have another body or material, or are gone.
  void forgetOthers(const SceneObjects& objects);

  const SurfaceTree& of(std::uint32_t object) const { return known_[object].tree; }

private:
  /// Holds for this body and material.
  struct Known
  {
    std::shared_ptr<const RigidObject> body;
    std::shared_ptr<const Material> material;
    SurfaceTree tree;
  };

  std::vector<Known> known_;
};

/**
 * Where a sensor stands: the point, closest to it, of all surface that faces as it does. Its
 * photons are those nearest to that point. The surface there also tells which other surface counts,
 * see SeenSurface.
 */
struct Foot
{
  Sensor sensor;       ///< moved to that point
  Vector3 normal;      ///< world, unit vector, of the surface; to the side that receives
  bool isInside;       ///< that side is inside of a body
  double distance;     ///< from there to the sensor, world
  double size;         ///< of the object, world
  TriangleId id{};     ///< on which the sensor stands now
  bool isFront = true; ///< the front of that receives
};

/// Whether a side (1: front, -1: back, in the world) of a triangle is inside of a body. Where a
/// pose mirrors, what is in front of the triangle in its own space is behind it in the world.
inline bool isInside(SolidSide solid, int side, bool isMirrored)
{
  return solid == ((side > 0) != isMirrored ? SolidSide::InFront : SolidSide::Behind);
}

/**
 * Finds where a sensor stands, no farther than `maximumDistance`. Sides that are inside of a body
 * are taken only if they are less than half as far as others: a sensor near a thin object, but not
 * quite on it, stands outside. Of several places at one distance the first by object and triangle.
 * `placed`: the trees of the objects in their poses.
 */
std::optional<Foot> findFoot(const SceneObjects& objects, const Surfaces& surfaces,
  const std::vector<PlacedTree>& placed, const Sensor& sensor, double maximumDistance);

}
