// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/BoxQuery.h"

#include <algorithm>

namespace irradiance
{

namespace
{

void addLeaf(const TriangleTree& tree, std::uint32_t first, std::vector<std::uint32_t>& found)
{
  const TriangleBlock* block = tree.blocks() + first;
  for (bool isLast = false; !isLast; ++block)
  {
    isLast = block->isLast();
    for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
    {
      if (block->reference(lane) != TriangleBlock::kNone)
      {
        found.push_back(block->reference(lane));
      }
    }
  }
}

/// `box` is in the unit frame.
void addNear(
  const TriangleTree& tree, std::uint32_t node, const Box& box, std::vector<std::uint32_t>& found)
{
  if (node == Treelet::kEmpty)
  {
    return;
  }
  if ((node & Treelet::kLeaf) != 0)
  {
    addLeaf(tree, node & ~Treelet::kLeaf, found);
    return;
  }
  const Treelet& treelet = tree.treelets()[node];
  for (unsigned child = 0; child < Treelet::kSize; ++child)
  {
    bool isNear = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isNear = isNear && treelet.bounds[0][axis][child] <= box.upper[axis] &&
        treelet.bounds[1][axis][child] >= box.lower[axis];
    }
    if (isNear)
    {
      addNear(tree, treelet.children[child], box, found);
    }
  }
}

}

std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box)
{
  std::vector<std::uint32_t> found;
  if (tree.isEmpty() || box.isEmpty())
  {
    return found;
  }
  Box unit{ tree.frame()(box.lower), tree.frame()(box.upper) };
  unit.inflate(0x1p-20); // the boxes of the tree are floats
  addNear(tree, tree.root(), unit, found);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}
