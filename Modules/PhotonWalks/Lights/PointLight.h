// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Lights/IntensityDistribution.h"
#include "Surfaces/ObjectSides.h"

#include <array>
#include <memory>
#include <vector>

namespace irradiance
{

/// A wall in whose plane a point lies.
struct Wall
{
  Vector3 normal;   ///< unit vector to the side where light can be
  double distance;  ///< from the plane to the point, along the normal
  double clearance; ///< distance from the plane at which light starts, as in SurfacePoint
};

/// The walls at each point source of each object; empty: there are none.
using LightWalls = std::vector<std::vector<std::vector<Wall>>>;

/// The walls in whose plane the point sources of a frame lie, except walls that let them shine to
/// both sides.
LightWalls lightWallsOf(
  const SceneObjects& objects, ObjectSides& sides, const CancelPoint& cancelPoint);

/// A point light, in world space: isotropic, or as a luminaire has it. In the plane of walls an
/// isotropic one shines to their open side alone: what would go behind a wall is mirrored at it. A
/// luminaire is moved clear of them.
class PointLight
{
public:
  /// Throws std::runtime_error if the walls leave no side open.
  PointLight(const Vector3& position, const std::vector<Wall>& walls,
    std::shared_ptr<const IntensityDistribution> distribution = nullptr);

  std::shared_ptr<const IntensityDistribution> ofLuminaire; ///< null: isotropic

  Box bounds() const { return { position_, position_ }; }
  /// The ray that leaves in the direction that a point of the unit square chooses; from one place.
  Ray leaving(const std::array<double, 2>& place, const std::array<double, 2>& direction) const;
  const Vector3& position() const { return position_; }
  /// Of the directions in which light leaves, per steradian: 1 / (4 pi) without walls. So it is the
  /// intensity for each W.
  double density(const Vector3& direction) const;

  friend bool operator==(const PointLight& a, const PointLight& b)
  {
    return a.position_ == b.position_ && a.openSides_ == b.openSides_ &&
      isSame(a.ofLuminaire, b.ofLuminaire);
  }

private:
  Vector3 position_;               ///< clear of the walls
  std::vector<Vector3> openSides_; ///< the normals of the walls, to the side that is lit
};

}
