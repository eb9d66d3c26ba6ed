// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/BoxQuery.h"

#include <algorithm>

namespace irradiance
{

namespace
{

void addNear(
  const TriangleTree& tree, std::uint32_t node, const Box& unit, std::vector<std::uint32_t>& leaves)
{
  if (node == Treelet::kEmpty)
  {
    return;
  }
  if ((node & Treelet::kLeaf) != 0)
  {
    leaves.push_back(node & ~Treelet::kLeaf);
    return;
  }
  const Treelet& treelet = tree.treelets()[node];
  for (unsigned child = 0; child < Treelet::kSize; ++child)
  {
    bool isNear = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isNear = isNear && treelet.bounds[0][axis][child] <= unit.upper[axis] &&
        treelet.bounds[1][axis][child] >= unit.lower[axis];
    }
    if (isNear)
    {
      addNear(tree, treelet.children[child], unit, leaves);
    }
  }
}

}

Box unitBounds(const TriangleTree& tree, const Box& box)
{
  Box unit{ tree.frame()(box.lower), tree.frame()(box.upper) };
  unit.inflate(0x1p-20); // the boxes of the tree are floats
  return unit;
}

std::vector<std::uint32_t> leavesNear(const TriangleTree& tree, const Box& unit)
{
  std::vector<std::uint32_t> leaves;
  if (!tree.isEmpty())
  {
    addNear(tree, tree.root(), unit, leaves);
  }
  return leaves;
}

std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box)
{
  std::vector<std::uint32_t> found;
  if (tree.isEmpty() || box.isEmpty())
  {
    return found;
  }
  for (const std::uint32_t leaf : leavesNear(tree, unitBounds(tree, box)))
  {
    forEachListed(tree, leaf, [&](std::uint32_t triangle) { found.push_back(triangle); });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}
