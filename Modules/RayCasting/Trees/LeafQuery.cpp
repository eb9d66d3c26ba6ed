// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/LeafQuery.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

std::array<float, Treelet::kSize> squaredDistances(const Treelet& treelet, const UnitPoint& point)
{
  std::array<float, Treelet::kSize> squared{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (unsigned child = 0; child < Treelet::kSize; ++child)
    {
      const float below = treelet.bounds[0][axis][child] - point[axis];
      const float above = point[axis] - treelet.bounds[1][axis][child];
      // Unused boxes end before they begin, so they are far from everything.
      const float outside = std::max(std::max(below, above), 0.0F);
      squared[child] += outside * outside;
    }
  }
  return squared;
}

namespace
{

struct Nearest
{
  std::uint32_t leaf = 0;
  float squaredDistance = std::numeric_limits<float>::infinity();
};

/// Children are visited by their distance, then by their place; the first of the nearest leaves
/// stays.
void visit(const TriangleTree& tree, std::uint32_t node, const UnitPoint& point, Nearest& nearest)
{
  const Treelet& treelet = tree.treelets()[node];
  std::array<float, Treelet::kSize> distances = squaredDistances(treelet, point);
  for (;;)
  {
    const auto next = std::min_element(distances.begin(), distances.end());
    const std::uint32_t child =
      treelet.children[static_cast<std::size_t>(next - distances.begin())];
    if (!(*next < nearest.squaredDistance) || child == Treelet::kEmpty)
    {
      return;
    }
    if ((child & Treelet::kLeaf) != 0)
    {
      nearest = { child & ~Treelet::kLeaf, *next };
    }
    else
    {
      visit(tree, child, point, nearest);
    }
    *next = std::numeric_limits<float>::infinity();
  }
}

}

std::uint32_t leafAt(const TriangleTree& tree, const UnitPoint& point)
{
  if ((tree.root() & Treelet::kLeaf) != 0)
  {
    return tree.root() & ~Treelet::kLeaf;
  }
  Nearest nearest;
  visit(tree, tree.root(), point, nearest);
  return nearest.leaf;
}

}
