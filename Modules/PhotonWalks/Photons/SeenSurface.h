// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SeenSurface_h
#define irradiance_SeenSurface_h

#include "Photons/Foot.h"

namespace irradiance
{

/**
 * The surface of an object as a sensor sees it: which of its sides count, for photons and for area
 * alike. A side of a triangle counts if
 * - it faces as the sensor does, see Facing;
 * - it is inside of a body if the sensor's foot is, and outside if that is;
 * - the nearest point of the triangle is not in front of the plane of the foot while the foot is
 *   behind the plane of the triangle, or the other way round. So it is with sheets above and below,
 *   and with steps. Surface that bends has both in front, or both behind. What is in the plane but
 *   for a thousandth of the distance counts.
 */
class SeenSurface
{
public:
  /// All of them must outlive it.
  SeenSurface(const SceneObject& object, const SurfaceTree& surface, const PlacedTree& placed,
    const Foot& foot);

  /// 1: the front of the triangle counts; -1: the back; 0: neither.
  int side(std::uint32_t triangle) const;
  /// The world area of what counts within a sphere around the foot in the flattened world.
  double areaWithin(double radius) const;

private:
  bool isOtherSurface(const Vector3& normal, const Vector3& closest) const;
  double areaOf(std::size_t node, double radius) const;
  double areaOfTriangle(std::uint32_t triangle, double radius) const;
  Share shareOf(const SurfaceNode& node, double radius) const;
  Share within(const SurfaceNode& node, const Vector3& away, double radius) const;
  Share facing(const SurfaceNode& node) const;
  Share onSameSurface(const SurfaceNode& node, const Vector3& away) const;

  const SceneObject& object_;
  const SurfaceTree& surface_;
  const PlacedTree& placed_;
  const Foot& foot_;
  Facing facing_;
  AffineMap fromFoot_, flattened_; ///< from the object's space; the foot is the origin
  /// The height above the plane of the foot, world, is upward_ . (point in the object's space) +
  /// height_.
  Vector3 upward_;
  double height_;
  double blur_; ///< heights above a plane that mean nothing, world
  // The foot in the unit frame of the surface, directions only where the pose keeps angles.
  Vector3 position_, toLight_, normal_;
};

}

#endif
