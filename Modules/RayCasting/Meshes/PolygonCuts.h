// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PolygonCuts_h
#define irradiance_PolygonCuts_h

#include "Meshes/TriangleMesh.h"

#include <optional>
#include <vector>

namespace irradiance
{

// Cuts polygons by the order of their corners alone.

/// A fan from the first corner.
std::vector<Triangle> cutFan(const std::vector<Vector3>& corners);

/// For a convex polygon. Cuts off every other corner, repeatedly: few triangles are slender.
std::vector<Triangle> cutConvex(const std::vector<Vector3>& corners);

/// For four corners. Cuts along diagonal 0-2, or 1-3 if only that lies inside; nothing if neither.
std::optional<std::vector<Triangle>> cutQuad(const std::vector<Vector3>& corners);

}

#endif
