// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PointFrame_h
#define irradiance_PointFrame_h

#include "Geometry/UnitFrame.h"
#include "Surfaces/SceneObjects.h"

namespace irradiance
{

/// The frame in which the points of walks are stored as floats. Its scale follows from the whole
/// scene. Its origin is the median of the triangles' corners, as floats are finest near 0: a far
/// light or vehicle does not move it. `bounds`: of all geometry and point lights.
UnitFrame pointFrame(const SceneObjects& objects, const Box& bounds);

}

#endif
