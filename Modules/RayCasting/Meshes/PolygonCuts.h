// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PolygonCuts_h
#define irradiance_PolygonCuts_h

#include "Meshes/TriangleMesh.h"

#include <optional>
#include <vector>

namespace irradiance
{

// Polygons that are cut by the order of their corners alone.

/// From the first corner.
std::vector<Triangle> cutFan(const std::vector<Vector3>& corners);

/// Of a convex polygon: cuts off every other corner, and again, so that few triangles are long and thin.
std::vector<Triangle> cutConvex(const std::vector<Vector3>& corners);

/// Of four corners: by the diagonal 0-2, unless only 1-3 lies inside. Nothing if neither does.
std::optional<std::vector<Triangle>> cutQuad(const std::vector<Vector3>& corners);

}

#endif
