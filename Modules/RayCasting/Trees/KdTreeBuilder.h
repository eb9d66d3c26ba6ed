// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdTreeBuilder_h
#define irradiance_KdTreeBuilder_h

#include "Meshes/TriangleMesh.h"
#include "Progress/CancelPoint.h"
#include "Trees/KdTree.h"

namespace irradiance
{

/// What a tree is built over: a triangle, or just a box if `triangle` is null.
struct KdPrimitive
{
  Box bounds;                         ///< of the primitive, widened by `blur`
  const Triangle* triangle = nullptr; ///< lets the builder clip instead of using boxes
  double blur = 0;                    ///< the position error of the primitive
};

/// Builds by the surface-area heuristic with triangles clipped to their cells (Wald and Havran, "On
/// building fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006). Leaves are
/// tested in blocks, and a block that is not full costs as much as a full one.
struct KdTreeBuilder
{
  double traversalCost = 1.0;    ///< of an inner node
  double intersectionCost = 2.0; ///< of a block, in the unit of traversalCost
  int blockSize = 8;             ///< primitives tested at a time; 1: each costs the same
  double emptyFactor = 0.9;      ///< reward (<= 1) for cutting off empty space
  /// A split that parts all primitives costs this share more. A primitive that is listed twice
  /// takes more memory, so the caches hold less of the tree.
  double partingCost = 0.5;
  /// Rounds bounds to the nearest floats, not outwards. Then triangles that meet at a place across
  /// an axis still do, and a plane there parts none of them. The boxes that they fill must be
  /// widened to hold them, by at most one float.
  bool roundsToNearest = false;
  CancelPoint cancelPoint; ///< may be empty

  KdTree build(const std::vector<KdPrimitive>& primitives) const;
};

}

#endif
