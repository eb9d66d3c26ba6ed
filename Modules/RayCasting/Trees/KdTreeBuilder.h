// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleMesh.h"
#include "Progress/CancelPoint.h"
#include "Trees/KdBounds.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// An inner node has a plane and two adjacent children, the left one at an even index. A leaf has a
/// range of references.
struct KdNode
{
  static constexpr std::uint32_t kLeaf = 3;

  union
  {
    float plane;         ///< inner
    std::uint32_t count; ///< leaf
  };
  std::uint32_t packed; ///< low 2 bits: axis or kLeaf; the rest: left child or first reference

  static KdNode inner(int axis, float plane, std::uint32_t leftChild)
  {
    KdNode node;
    node.plane = plane;
    node.packed = leftChild << 2 | static_cast<std::uint32_t>(axis);
    return node;
  }
  static KdNode leaf(std::uint32_t first, std::uint32_t count)
  {
    KdNode node;
    node.count = count;
    node.packed = first << 2 | kLeaf;
    return node;
  }
  bool isLeaf() const { return (packed & 3) == kLeaf; }
  int axis() const { return static_cast<int>(packed & 3); }
  std::uint32_t index() const { return packed >> 2; }
};

/**
 * A kd-tree over anything with bounds. It only says where to look: a leaf lists the primitives that
 * may touch its cell, and every leaf whose cell a primitive touches lists the primitive.
 */
struct KdTree
{
  static constexpr int kMaxDepth = 60;

  Box bounds;
  std::vector<KdNode> nodes;    ///< the root is nodes[0]
  std::vector<KdBounds> filled; ///< for each node, the part of its cell that the primitives fill
  std::vector<std::uint32_t> references;

  bool isEmpty() const { return references.empty(); }
};

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

  /// The expected cost of a ray that enters a leaf.
  double leafCost(std::uint32_t primitives) const
  {
    const auto size = static_cast<std::uint32_t>(blockSize);
    const std::uint32_t blocks = (primitives + size - 1) / size;
    return intersectionCost * blocks;
  }
  KdTree build(const std::vector<KdPrimitive>& primitives) const;
};

}
