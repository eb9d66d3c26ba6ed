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

/// The leaves whose boxes touch a box in the unit frame, by the numbers of their first blocks.
std::vector<std::uint32_t> leavesNear(const TriangleTree& tree, const Box& unit);

/// Calls visit(triangle) for all that a leaf lists, given the number of its first block.
template <class Visit>
void forEachListed(const TriangleTree& tree, std::uint32_t leaf, const Visit& visit)
{
  const TriangleBlock* block = tree.blocks() + leaf;
  for (bool isLast = false; !isLast; ++block)
  {
    isLast = block->isLast();
    for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
    {
      if (block->reference(lane) != TriangleBlock::kNone)
      {
        visit(block->reference(lane));
      }
    }
  }
}

/// The numbers of all triangles that touch a box in the space of the tree's triangles, and of some
/// of their neighbours, in ascending order, each once.
std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box);

}

#endif
