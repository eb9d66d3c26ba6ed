// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ContactLight_h
#define irradiance_ContactLight_h

#include "Geometry/Ray.h"
#include "Surfaces/ObjectSides.h"

#include <map>
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
  ContactLight(const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint);

  /// From either side of two triangles that coincide.
  bool mayCome(const TriangleId& s, const TriangleId& t);

private:
  /// Whether a triangle proves that no light comes from the side to which a normal points.
  bool proveDark(const TriangleId& id, const Vector3& normal);
  /// Whether there is light neither in a body nor outside a room.
  bool isMatterDark(std::uint32_t object, std::uint32_t shell);
  bool isMatterDark(const SceneObject& object, const Shell& shell) const;

  const SceneObjects& objects_;
  ObjectSides& sides_;
  const CancelPoint& cancelPoint_;
  Box scene_;              ///< of all that is there, and all lamps
  std::vector<Box> lamps_; ///< of each
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> isDark_; ///< by object and shell
};

}

#endif
