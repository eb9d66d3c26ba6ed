// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Trees/KdTreeBuilder.h"

#include <array>
#include <vector>

// Builds trees for tests, and visits all their nodes.

namespace irradiance::test
{

constexpr std::array<int, 3> kBlockSizes = { 1, 3, 8 };

inline std::vector<KdPrimitive> primitivesOf(const std::vector<Triangle>& triangles)
{
  std::vector<KdPrimitive> primitives;
  for (const Triangle& triangle : triangles)
  {
    primitives.push_back({ triangle.bounds(), &triangle });
  }
  return primitives;
}

/// Costs set here, so that tests do not depend on the tuned defaults.
inline KdTreeBuilder builderFor(int blockSize)
{
  KdTreeBuilder builder;
  builder.traversalCost = 1;
  builder.intersectionCost = 2;
  builder.emptyFactor = 0.8;
  builder.partingCost = 0.25;
  builder.blockSize = blockSize;
  return builder;
}

inline KdTree build(const std::vector<KdPrimitive>& primitives, int blockSize)
{
  return builderFor(blockSize).build(primitives);
}

inline KdTree build(const std::vector<Triangle>& triangles, int blockSize)
{
  return build(primitivesOf(triangles), blockSize);
}

/// Calls visit(node, cell, depth) for each node.
template <typename Visit>
void walk(const KdTree& tree, const Visit& visit, std::uint32_t index, const Box& cell, int depth)
{
  const KdNode node = tree.nodes[index];
  visit(node, cell, depth);
  if (!node.isLeaf())
  {
    Box left = cell, right = cell;
    left.upper[node.axis()] = right.lower[node.axis()] = node.plane;
    walk(tree, visit, node.index(), left, depth + 1);
    walk(tree, visit, node.index() + 1, right, depth + 1);
  }
}

template <typename Visit>
void walk(const KdTree& tree, const Visit& visit)
{
  walk(tree, visit, 0, tree.bounds, 0);
}

inline double areaOf(const Box& box)
{
  const Vector3 e = box.extent();
  return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

}
