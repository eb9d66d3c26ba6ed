// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PolygonClip_h
#define irradiance_PolygonClip_h

#include "Geometry/Triangle.h"

namespace irradiance
{

/// Bounds of the part of a triangle inside a box (Sutherland and Hodgman 1974); empty if there is
/// none. The error is a few ulps of the coordinates.
Box boundsOfClipped(const Triangle& triangle, const Box& box);

}

#endif
