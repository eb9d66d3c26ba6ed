// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FlatPolygon_h
#define irradiance_FlatPolygon_h

#include "Geometry/Vector.h"

#include <vector>

namespace irradiance
{

using Vector2 = Eigen::Vector2d;

/// In the unit frame: what is no wider is a line, rounded.
constexpr double kLineWidth = 0x1p-48;

/// The corners times the power of two that takes the largest coordinate to 1..2, and in multiples of
/// 2^-75: exact numbers stay short.
std::vector<Vector3> inUnitFrame(const std::vector<Vector3>& corners);

/// The direction from which the polygon is seen in full and counter-clockwise: that of its area
/// vector. A polygon whose parts cancel, as a bow-tie's do, is seen from either side of its plane.
/// Zero if all corners are on a line. In the unit frame.
Vector3 frontOf(const std::vector<Vector3>& corners);

/// Whether no corner leaves the plane across `front` by more than `tolerance`, in widths of the polygon.
bool isPlanar(const std::vector<Vector3>& corners, const Vector3& front, double tolerance);

/// Seen from the front along a coordinate axis. Nothing is rounded, so that corners on a line
/// stay on a line.
std::vector<Vector2> seenAlongAxis(const std::vector<Vector3>& corners, const Vector3& front);

/// Seen from the front along `front` itself, on the plane across the same axis. A polygon far from
/// planar can cross itself along the axis and not here.
std::vector<Vector2> seenFromFront(const std::vector<Vector3>& corners, const Vector3& front);

/// Whether the polygon turns to the left at every corner, by no less than 1e-6, and goes round once.
bool isConvex(const std::vector<Vector2>& corners);

}

#endif
