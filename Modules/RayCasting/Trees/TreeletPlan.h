// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TreeletPlan_h
#define irradiance_TreeletPlan_h

#include "Progress/CancelPoint.h"
#include "Trees/KdTreeBuilder.h"
#include "Trees/TriangleTree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// The node itself or, if its plane only cuts off empty space, the first below that does not.
std::uint32_t forkAt(const KdTree& tree, std::uint32_t node);

/**
 * Says which nodes of a kd-tree form each treelet. How often rays enter a treelet is about
 * proportional to the surface area of its box, so of all ways to cover the tree with treelets this
 * finds the one with the least sum of areas, by dynamic programming from the leaves to the root.
 */
class TreeletPlan
{
public:
  explicit TreeletPlan(const KdTree& tree, const CancelPoint& cancelPoint = {});

  /// How many of the at most `most` children that a node has in a treelet are left of its plane; 0
  /// if the node is itself a child. Only for nodes that forkAt() returns.
  unsigned onLeft(std::uint32_t node, unsigned most) const { return onLeft_[node][most - 1]; }

private:
  static constexpr unsigned kSize = Treelet::kSize;
  /// The least sums of areas below a node that provides at most 1 .. 16 children of a treelet.
  using Areas = std::array<float, kSize>;

  Areas plan(std::uint32_t node);
  /// The sums if the plane of the node is in the treelet; needs two children.
  Areas part(std::uint32_t node);

  const KdTree& tree_;
  ThrottledCancelPoint pace_;
  std::vector<std::array<std::uint8_t, kSize>> onLeft_;
};

}

#endif
