// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TreeRays_h
#define irradiance_TreeRays_h

#include "Geometry/Vector.h"

#include <cstdint>

namespace irradiance
{

/// Rays in the space of a tree, or in world space, as columns, and the best hits that are known of
/// them. The columns have room for a multiple of kLanes; what stands beyond `count` has no meaning
/// and may be changed.
struct TreeRays
{
  static constexpr std::uint32_t kLanes = 16;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  static constexpr std::uint32_t roomFor(std::uint32_t count)
  {
    return (count + kLanes - 1) / kLanes * kLanes;
  }

  std::uint32_t count;
  const double* origin[3];
  const float* direction[3];       ///< of length 1, up to rounding; or null, and there are
  const double* exactDirection[3]; ///< doubles, of any length
  const std::uint32_t* start;      ///< the number of the triangle that each leaves, or kNone
  /// In: the best hit so far, or infinite and kNone; nothing farther is looked for. Out: that or a
  /// closer one, by (distance, number).
  double* distance;
  std::uint32_t* hit;
  float* weight[2];            ///< of the second and third corner
  std::uint32_t first = 0;     ///< the number of the tree's first triangle
  std::uint32_t triangles = 0; ///< of the tree

  /// The triangle that a ray leaves, as the tree knows it.
  std::uint32_t skipped(std::uint32_t ray, std::uint32_t none) const
  {
    const std::uint32_t reference = start[ray] - first;
    return reference < triangles ? reference : none;
  }

  /// Keeps the hit of a ray on a triangle if it is the closer one. The distance is NaN if the ray
  /// misses.
  void keepCloser(
    std::uint32_t ray, std::uint32_t number, double found, double weightB, double weightC) const
  {
    double& best = distance[ray];
    if (found > 0 && (found < best || (found == best && number < hit[ray])))
    {
      best = found;
      hit[ray] = number;
      weight[0][ray] = static_cast<float>(weightB);
      weight[1][ray] = static_cast<float>(weightC);
    }
  }
};

inline Vector3 originOf(const TreeRays& rays, std::uint32_t ray)
{
  return { rays.origin[0][ray], rays.origin[1][ray], rays.origin[2][ray] };
}

inline Vector3 directionOf(const TreeRays& rays, std::uint32_t ray)
{
  return rays.direction[0]
    ? Vector3(rays.direction[0][ray], rays.direction[1][ray], rays.direction[2][ray])
    : Vector3(
        rays.exactDirection[0][ray], rays.exactDirection[1][ray], rays.exactDirection[2][ray]);
}

}

#endif
