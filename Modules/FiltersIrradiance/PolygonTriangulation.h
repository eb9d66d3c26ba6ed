#ifndef irradiance_PolygonTriangulation_h
#define irradiance_PolygonTriangulation_h

#include "TriangleMesh.h"

namespace irradiance
{

/// Appends the triangles of a simple polygon, convex or not, with the polygon's orientation. Fewer
/// than three corners give none.
void triangulate(const std::vector<Vector3>& corners, std::vector<Triangle>& triangles);

}

#endif
