// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TriangleInSphere_h
#define irradiance_TriangleInSphere_h

#include "Geometry/Triangle.h"

namespace irradiance
{

/// The area of the part of a triangle that lies within a sphere around the origin; the radius may
/// be infinite. A sphere cuts a disc out of the triangle's plane.
double areaInSphere(const Triangle& triangle, double radius);

/// The point of a triangle that is closest to the origin.
Vector3 closestPoint(const Triangle& triangle);

}

#endif
