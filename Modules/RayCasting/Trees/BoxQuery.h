// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_BoxQuery_h
#define irradiance_BoxQuery_h

#include "Trees/TriangleTree.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/// Bounds, in the unit frame of a tree, of a box in the space of its triangles.
Box unitBounds(const TriangleTree& tree, const Box& box);

/// For each child of a treelet whether its box touches a box in the unit frame.
std::array<bool, Treelet::kSize> childrenNear(const Treelet& treelet, const Box& unit);

/// Calls visit(triangle), in any order and perhaps more than once, for all that the leaves below a
/// node list whose boxes touch a box in the unit frame.
template <class Visit>
void forEachBelow(const TriangleTree& tree, std::uint32_t node, const Box& unit, const Visit& visit)
{
  if (node == Treelet::kEmpty)
  {
    return;
  }
  if ((node & Treelet::kLeaf) != 0)
  {
    forEachListed(tree.blocks() + (node & ~Treelet::kLeaf), visit);
    return;
  }
  const Treelet& treelet = tree.treelets()[node];
  const std::array<bool, Treelet::kSize> isNear = childrenNear(treelet, unit);
  for (unsigned child = 0; child < Treelet::kSize; ++child)
  {
    if (isNear[child])
    {
      forEachBelow(tree, treelet.children[child], unit, visit);
    }
  }
}

/// Calls visit(triangle), in any order and perhaps more than once, for all triangles that touch a
/// box in the space of the tree's triangles, and for some of their neighbours.
template <class Visit>
void forEachNear(const TriangleTree& tree, const Box& box, const Visit& visit)
{
  if (!tree.isEmpty() && !box.isEmpty())
  {
    forEachBelow(tree, tree.root(), unitBounds(tree, box), visit);
  }
}

/// The same triangles, in ascending order, each once.
std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box);

}

#endif
