// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/BoxQuery.h"

#include <algorithm>

namespace irradiance
{

std::array<bool, Treelet::kSize> childrenNear(const Treelet& treelet, const Box& unit)
{
  std::array<bool, Treelet::kSize> isNear;
  isNear.fill(true);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (unsigned child = 0; child < Treelet::kSize; ++child)
    {
      isNear[child] &= (treelet.bounds[0][axis][child] <= unit.upper[axis]) &
        (treelet.bounds[1][axis][child] >= unit.lower[axis]);
    }
  }
  return isNear;
}

Box unitBounds(const TriangleTree& tree, const Box& box)
{
  Box unit{ tree.frame()(box.lower), tree.frame()(box.upper) };
  unit.inflate(0x1p-20); // the boxes of the tree are floats
  return unit;
}

std::vector<std::uint32_t> trianglesNear(const TriangleTree& tree, const Box& box)
{
  std::vector<std::uint32_t> found;
  forEachNear(tree, box, [&](std::uint32_t triangle) { found.push_back(triangle); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}
