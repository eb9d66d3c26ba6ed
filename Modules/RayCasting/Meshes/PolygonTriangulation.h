// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleMesh.h"

#include <vector>

namespace irradiance
{

/// Appends the triangles of a polygon, with the polygon's orientation, which its area vector gives.
///
/// A polygon may be concave, not quite planar, and may touch itself: its inside is what it goes
/// around once. So a hole connected to the outline by an edge walked there and back stays a hole,
/// and a spike vanishes. The result may contain triangles without area.
///
/// False if the polygon crosses itself. Then the triangles cover everything that it goes around, in
/// either direction, and crossings of edges become new corners. A polygon that crosses itself too
/// often, or is far from planar and appears to cross itself, becomes a fan.
///
/// Scaling the corners by a power of two scales the triangles exactly. Coordinates are finite.
[[nodiscard]] bool triangulate(
  const std::vector<Vector3>& corners, std::vector<Triangle>& triangles);

}
