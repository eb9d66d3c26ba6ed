// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TreeletPlan_h
#define irradiance_TreeletPlan_h

#include "Progress/Checkpoint.h"
#include "Trees/KdTree.h"
#include "Trees/Treelet.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// The node itself or, where planes only cut off empty space, the first behind them that does not.
std::uint32_t forkAt(const KdTree& tree, std::uint32_t node);

/**
 * Which nodes of a kd-tree a treelet of several levels is made of. A ray enters a treelet about as
 * often as its box is large, so of all ways to cover the tree with treelets this finds the one with
 * the least sum of surface areas, by dynamic programming from the leaves to the root.
 */
class TreeletPlan
{
public:
  explicit TreeletPlan(const KdTree& tree, const Checkpoint& checkpoint = {});

  /// How many of the `most` children that a node may have in a treelet are on the left of its
  /// plane; 0: the node is to be a child itself. For nodes that forkAt() returns.
  unsigned onLeft(std::uint32_t node, unsigned most) const { return onLeft_[node][most - 1]; }

private:
  static constexpr unsigned kSize = Treelet::kSize;
  /// The least sums of areas below a node that may be 1 .. 16 children of a treelet.
  using Areas = std::array<float, kSize>;

  Areas plan(std::uint32_t node);
  /// With the plane of the node in the treelet; needs two children.
  Areas part(std::uint32_t node);

  const KdTree& tree_;
  CheckpointPace pace_;
  std::vector<std::array<std::uint8_t, kSize>> onLeft_;
};

}

#endif
