// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Progress/CancelPoint.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
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

/// 0, 1, 2 for a, b, c; any other number counts on from there.
inline const Vector3& cornerOf(const Triangle& triangle, int number)
{
  const int corner = number % 3;
  return corner == 0 ? triangle.a : corner == 1 ? triangle.b : triangle.c;
}

/// By the lower of their corners' numbers, then by the higher and by triangle. Each corner has few.
inline std::vector<MeshEdge> sortedByCorners(
  const std::vector<MeshEdge>& edges, std::size_t corners, ThrottledCancelPoint& pace)
{
  const auto lower = [](const MeshEdge& edge) { return edge.corners >> 32; };
  std::vector<std::size_t> ends(corners + 1, 0); // once filled, of the edges of each corner
  for (const MeshEdge& edge : edges)
  {
    ++ends[lower(edge) + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<MeshEdge> sorted(edges.size());
  for (const MeshEdge& edge : edges)
  {
    sorted[ends[lower(edge)]++] = edge;
    pace.step();
  }
  auto begin = sorted.begin();
  for (std::size_t corner = 0; corner < corners; ++corner)
  {
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(ends[corner]);
    std::sort(begin, end, [](const MeshEdge& a, const MeshEdge& b) {
      return std::tie(a.corners, a.triangle) < std::tie(b.corners, b.triangle);
    });
    pace.step(static_cast<std::size_t>(end - begin));
    begin = end;
  }
  return sorted;
}

/// The edges of the chosen triangles, those between the same two corners in a row. Corners are the
/// same if their positions are exactly equal, and their triangles are of the same part. `partOf`:
/// of each triangle of the mesh; empty: there are no parts.
inline std::vector<MeshEdge> meshEdges(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& partOf,
  ThrottledCancelPoint& pace)
{
  using Corner = std::pair<std::array<double, 3>, std::uint32_t>; // its position, and its part
  const auto hashOf = [](const Corner& corner) {
    std::size_t hash = corner.second;
    for (const double x : corner.first)
    {
      hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  };
  std::unordered_map<Corner, std::uint32_t, decltype(hashOf)> numbers(0, hashOf);
  std::vector<MeshEdge> edges;
  edges.reserve(3 * chosen.size());
  for (std::uint32_t i = 0; i < chosen.size(); ++i)
  {
    pace.step(16);
    std::array<std::uint64_t, 3> corners;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3& p = cornerOf(triangles[chosen[i]], k);
      const Corner corner{ { p[0] + 0.0, p[1] + 0.0, p[2] + 0.0 }, // turns -0 into 0
        partOf.empty() ? 0u : partOf[chosen[i]] };
      corners[static_cast<std::size_t>(k)] =
        numbers.emplace(corner, static_cast<std::uint32_t>(numbers.size())).first->second;
    }
    for (int k = 0; k < 3; ++k)
    {
      const std::uint64_t from = corners[static_cast<std::size_t>(k)],
                          to = corners[static_cast<std::size_t>((k + 1) % 3)];
      edges.push_back({ std::min(from, to) << 32 | std::max(from, to), i, k, from < to });
    }
  }
  return sortedByCorners(edges, numbers.size(), pace);
}

}
