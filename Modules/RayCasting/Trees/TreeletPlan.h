// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Progress/CancelPoint.h"
#include "Trees/KdTreeBuilder.h"
#include "Trees/TriangleTree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// The node itself or, if its plane only cuts off empty space, the first below that does not.
inline std::uint32_t forkAt(const KdTree& tree, std::uint32_t node)
{
  while (!tree.nodes[node].isLeaf())
  {
    const std::uint32_t left = tree.nodes[node].index();
    const bool isLeftEmpty = tree.filled[left].isEmpty();
    if (!isLeftEmpty && !tree.filled[left + 1].isEmpty())
    {
      break;
    }
    node = left + (isLeftEmpty ? 1 : 0);
  }
  return node;
}

/**
 * Says which nodes of a kd-tree form each treelet. How often rays enter a treelet is about
 * proportional to the surface area of its box, so of all ways to cover the tree with treelets this
 * finds the one with the least sum of areas, by dynamic programming from the leaves to the root.
 */
class TreeletPlan
{
public:
  explicit TreeletPlan(const KdTree& tree, const CancelPoint& cancelPoint = {})
    : tree_(tree)
    , pace_(cancelPoint)
    , onLeft_(tree.nodes.size())
  {
    plan(0);
  }

  /// How many of the at most `most` children that a node has in a treelet are left of its plane; 0
  /// if the node is itself a child. Only for nodes that forkAt() returns.
  unsigned onLeft(std::uint32_t node, unsigned most) const { return onLeft_[node][most - 1]; }

private:
  static constexpr unsigned kSize = Treelet::kSize;
  /// The least sums of areas below a node that provides at most 1 .. 16 children of a treelet.
  using Areas = std::array<float, kSize>;

  Areas plan(std::uint32_t node)
  {
    pace_.step(kSize);
    node = forkAt(tree_, node);
    if (tree_.nodes[node].isLeaf())
    {
      return {};
    }
    Areas areas = part(node);
    const float asTreelet = areas[kSize - 1] + tree_.filled[node].halfArea();
    for (unsigned most = 1; most < kSize; ++most)
    {
      if (most == 1 || asTreelet <= areas[most - 1])
      {
        areas[most - 1] = asTreelet;
        onLeft_[node][most - 1] = 0;
      }
    }
    return areas;
  }
  /// The sums if the plane of the node is in the treelet; needs two children.
  Areas part(std::uint32_t node)
  {
    const std::uint32_t child = tree_.nodes[node].index();
    const Areas left = plan(child), right = plan(child + 1);
    Areas areas{};
    for (unsigned most = 2; most <= kSize; ++most)
    {
      unsigned best = 1;
      const auto area = [&](
                          unsigned onLeft) { return left[onLeft - 1] + right[most - onLeft - 1]; };
      for (unsigned onLeft = 2; onLeft < most; ++onLeft)
      {
        best = area(onLeft) < area(best) ? onLeft : best;
      }
      areas[most - 1] = area(best);
      onLeft_[node][most - 1] = static_cast<std::uint8_t>(best);
    }
    return areas;
  }

  const KdTree& tree_;
  ThrottledCancelPoint pace_;
  std::vector<std::array<std::uint8_t, kSize>> onLeft_;
};

}
