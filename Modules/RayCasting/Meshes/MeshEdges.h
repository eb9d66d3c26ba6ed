// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_MeshEdges_h
#define irradiance_MeshEdges_h

#include "Geometry/Triangle.h"
#include "Progress/CancelPoint.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// One of the three edges of a triangle.
struct MeshEdge
{
  std::uint64_t corners;  ///< the same for all edges between the same two corners
  std::uint32_t triangle; ///< index among the chosen ones
  int corner;             ///< where the edge begins: 0, 1, 2 for a, b, c
  bool isForward;         ///< of two edges between the same corners, whether they run alike
};

/// The edges of the chosen triangles, those between the same two corners in a row. Corners are the
/// same if their positions are exactly equal, and their triangles are of the same part. `partOf`:
/// of each triangle of the mesh; empty: there are no parts.
std::vector<MeshEdge> meshEdges(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& partOf,
  ThrottledCancelPoint& pace);

/// 0, 1, 2 for a, b, c; any other number counts on from there.
inline const Vector3& cornerOf(const Triangle& triangle, int number)
{
  const int corner = number % 3;
  return corner == 0 ? triangle.a : corner == 1 ? triangle.b : triangle.c;
}

}

#endif
