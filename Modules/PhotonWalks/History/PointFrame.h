// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointFrame_h
#define irradiance_PointFrame_h

#include "Geometry/UnitFrame.h"
#include "Light/SceneObjects.h"

namespace irradiance
{

/// The frame in which the points of walks are stored as floats: its scale is that of all there is,
/// its origin amid most of the triangles, wherever a far light or vehicle may be, as floats are finest
/// near 0. `bounds`: of all geometry and point lights.
UnitFrame pointFrame(const SceneObjects& objects, const Box& bounds);

}

#endif
