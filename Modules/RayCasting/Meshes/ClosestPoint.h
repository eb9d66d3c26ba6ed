// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ClosestPoint_h
#define irradiance_ClosestPoint_h

#include "Geometry/Triangle.h"

namespace irradiance
{

/// The point of a triangle that is closest to the origin.
Vector3 closestPoint(const Triangle& triangle);

}

#endif
