// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FlatPolygon_h
#define irradiance_FlatPolygon_h

#include "Geometry/Triangle.h"

#include <optional>
#include <vector>

namespace irradiance
{

using Vector2 = Eigen::Vector2d;

/// In the unit frame: what is no wider than this is a line, up to rounding.
constexpr double kLineWidth = 0x1p-48;

/// The corners times the power of two that brings the largest coordinate to 1..2, rounded to
/// multiples of 2^-75, so that exact numbers stay short.
std::vector<Vector3> inUnitFrame(const std::vector<Vector3>& corners);

/// The direction from which the polygon appears largest and counter-clockwise: along its area
/// vector. If parts cancel, as a bow-tie's do, it is a normal of its plane, on either side. Zero if
/// all corners are on a line. Expects the unit frame.
Vector3 frontOf(const std::vector<Vector3>& corners);

/// True if no corner leaves the plane normal to `front` by more than `tolerance` polygon widths.
bool isPlanar(const std::vector<Vector3>& corners, const Vector3& front, double tolerance);

/// The polygon as seen from the front along a coordinate axis. Nothing is rounded, so that corners
/// on a line stay on a line.
std::vector<Vector2> seenAlongAxis(const std::vector<Vector3>& corners, const Vector3& front);

/// The polygon as seen from the front along `front` itself, on the plane normal to the same axis. A
/// polygon far from planar may cross itself when seen along the axis and not here.
std::vector<Vector2> seenFromFront(const std::vector<Vector3>& corners, const Vector3& front);

/// True if the polygon turns left at every corner, by more than 2^-20 rad, and goes around once.
bool isConvex(const std::vector<Vector2>& corners);

/// A fan from the first corner.
std::vector<Triangle> cutFan(const std::vector<Vector3>& corners);

/// For a convex polygon. Cuts off every other corner, repeatedly: few triangles are slender.
std::vector<Triangle> cutConvex(const std::vector<Vector3>& corners);

/// For four corners. Cuts along diagonal 0-2, or 1-3 if only that lies inside; nothing if neither.
std::optional<std::vector<Triangle>> cutQuad(const std::vector<Vector3>& corners);

}

#endif
