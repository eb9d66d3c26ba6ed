// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Simd/Prefetch.h"
#include "Trees/TriangleTree.h"

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

/// What differs from ray to ray of a TreeQuery, in rows of four that lanes are turned into.
struct PreparedQuery
{
  float origin[3];
  float limit; ///< nothing behind it matters; decreases as hits are found
  float direction[3];
  float pad;        ///< twice the error of the distances at which the ray passes planes
  float inverse[3]; ///< of the direction
  /// If the ray leaves a triangle that lies in a plane across an axis: a box is behind the ray
  /// whose farthest bound on that axis, with its sign, is at most `behind`.
  float behind;
  float originInverse[3]; ///< their product
  std::uint32_t skipped;  ///< the reference of the triangle that the ray leaves, or kNone
  std::uint32_t ray;      ///< its place in the columns
  int behindAxis;
};
static_assert(sizeof(PreparedQuery) == 72);

/**
 * A search of one ray in one tree, as the kernels see it: in the tree's unit frame, starting where
 * the ray enters the tree's box, with a direction whose largest component is 1.
 *
 * Law: no leaf that holds the closest hit is skipped, and no triangle that the test in double would
 * accept is rejected. In the frame every coordinate is at most about 1, so that constants bound all
 * rounding: positions on the ray are off by less than kBlur. Documentation/Theory.md, section 3,
 * derives these constants.
 */
struct TreeQuery : PreparedQuery
{
  static constexpr double kBlur = 0x1p-20;
  /// The error of an edge function is below kEdgeBlur * L + kLeastBlur; L = |edge1|_1 + |edge2|_1.
  static constexpr double kEdgeBlur = 0x1p-16;
  static constexpr double kLeastBlur = 0x1p-46;
  /// The error of a determinant is below kSizeBlur * L^2.
  static constexpr float kSizeBlur = 0x1p-19F;
  /// Floats are too coarse for directions with a smaller component.
  static constexpr double kSmallestComponent = 0x1p-12;
  static constexpr double kFarthest = 4; ///< no hit is farther, on a ray that starts in the frame
  /// A ray that starts this far from a plane, in the frame, and leaves it hits nothing behind it.
  static constexpr double kClearOfPlane = 0x1p-40;

  const TriangleTree* tree;
  float edgeBlur;   ///< error of an edge function, per unit of edge length
  float leastBlur;  ///< the part of that error that does not depend on the triangle
  float slack;      ///< a hit's distance may be off by this when the ray grazes
  float margin;     ///< from a hit to the limit behind it
  float behindSign; ///< 0 or -0
  unsigned octant;
};

/// Tests triangles at once, in double: few, where there is no room for more candidates or floats do
/// not serve.
class FrontTester
{
public:
  virtual void test(std::uint32_t ray, std::uint32_t reference) = 0;

protected:
  ~FrontTester() = default;
};

/// A triangle that a search found beside the first.
struct FurtherCandidate
{
  std::uint32_t ray, reference;
};

/// The corners of triangles, nine doubles, at equal distances in memory.
struct CornerRows
{
  const double* first;
  std::size_t stride; ///< doubles from one to the next

  const double* of(std::uint32_t triangle) const { return first + triangle * stride; }
  __attribute__((always_inline)) void prefetch(std::uint32_t triangle) const
  {
    prefetchLine(of(triangle));
    prefetchLine(of(triangle) + 8);
  }
};

/// Searches of a front in one tree, ready for the kernels, and where they write what they find.
struct FrontSearches
{
  const TriangleTree& tree;
  PreparedQuery* queries; ///< room for TreeRays::roomFor(count)
  std::uint32_t count;
  std::uint32_t* others; ///< rays that floats cannot follow, for searchExactly(); as much room
  std::uint32_t otherCount;
  std::uint32_t* candidate; ///< by ray, the first found
  FurtherCandidate* further;
  std::uint32_t furtherCount, furtherRoom;
  CornerRows corners; ///< to prefetch what is found
  FrontTester& tester;
};

}
