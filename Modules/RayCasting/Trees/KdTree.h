// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdTree_h
#define irradiance_KdTree_h

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

}

#endif
