// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/LeafQuery.h"

#include <algorithm>
#include <limits>
#include <numeric>

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
  std::array<float, Treelet::kSize> squared = squaredDistances(treelet, point);
  const auto look = [&](unsigned child) {
    const std::uint32_t link = treelet.children[child];
    if ((link & Treelet::kLeaf) == 0)
    {
      visit(tree, link, point, nearest);
    }
    else if (link != Treelet::kEmpty)
    {
      nearest = { link & ~Treelet::kLeaf, squared[child] };
    }
    squared[child] = std::numeric_limits<float>::infinity();
  };
  // Nearly always the point is in a box.
  for (unsigned child = 0; child < Treelet::kSize; ++child)
  {
    if (squared[child] == 0 && nearest.squaredDistance > 0)
    {
      look(child);
    }
  }
  if (nearest.squaredDistance == 0)
  {
    return;
  }
  const auto next = [&] { return std::min_element(squared.begin(), squared.end()); };
  for (auto child = next(); *child < nearest.squaredDistance; child = next())
  {
    look(static_cast<unsigned>(child - squared.begin()));
  }
}

/// Calls visit(leaf, triangle) for all that leaves list.
template <class Visit>
void forEachInLeaves(const TriangleTree& tree, const Visit& visit)
{
  const TriangleBlock* block = tree.blocks();
  while (block != tree.blocks() + tree.numberOfBlocks())
  {
    const auto leaf = static_cast<std::uint32_t>(block - tree.blocks());
    block = forEachListed(block, [&](std::uint32_t triangle) { visit(leaf, triangle); });
  }
}

float squaredDistance(const KdBounds& box, const UnitPoint& point)
{
  float squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const float outside =
      std::max({ box.lower[axis] - point[axis], point[axis] - box.upper[axis], 0.0F });
    squared += outside * outside;
  }
  return squared;
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

LeafTable::LeafTable(const TriangleTree& tree)
  : boxes_(tree.numberOfBlocks())
{
  for (std::size_t i = 0; i < tree.numberOfTreelets(); ++i)
  {
    const Treelet& treelet = tree.treelets()[i];
    for (unsigned child = 0; child < Treelet::kSize; ++child)
    {
      const std::uint32_t link = treelet.children[child];
      if ((link & Treelet::kLeaf) != 0 && link != Treelet::kEmpty)
      {
        boxes_[link & ~Treelet::kLeaf] = treelet.box(child);
      }
    }
  }
  forEachInLeaves(tree, [&](std::uint32_t, std::uint32_t triangle) {
    begin_.resize(std::max<std::size_t>(begin_.size(), triangle + std::size_t{ 2 }));
    ++begin_[triangle + std::size_t{ 1 }];
  });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::uint32_t> next = begin_;
  leaves_.resize(begin_.empty() ? 0 : begin_.back());
  forEachInLeaves(
    tree, [&](std::uint32_t leaf, std::uint32_t triangle) { leaves_[next[triangle]++] = leaf; });
}

std::uint32_t LeafTable::leafOf(
  const TriangleTree& tree, std::uint32_t triangle, const UnitPoint& point) const
{
  const std::uint32_t begin = begin_[triangle], end = begin_[triangle + std::size_t{ 1 }];
  if (end - begin > kMany)
  {
    return leafAt(tree, point);
  }
  Nearest nearest{ leaves_[begin] };
  for (std::uint32_t i = begin; i < end && end - begin > 1; ++i)
  {
    const float squared = squaredDistance(boxes_[leaves_[i]], point);
    if (squared < nearest.squaredDistance)
    {
      nearest = { leaves_[i], squared };
    }
  }
  return nearest.leaf;
}

std::size_t LeafTable::bytes() const
{
  return boxes_.capacity() * sizeof(KdBounds) +
    (begin_.capacity() + leaves_.capacity()) * sizeof(std::uint32_t);
}

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
