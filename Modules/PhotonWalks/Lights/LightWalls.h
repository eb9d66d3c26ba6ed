// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_LightWalls_h
#define irradiance_LightWalls_h

#include "Surfaces/ObjectSides.h"

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

}

#endif
