// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Trees/TriangleTree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// A point in the unit frame of a tree.
using UnitPoint = std::array<float, 3>;

inline UnitPoint unitPoint(const UnitFrame& frame, const Vector3& position)
{
  const Vector3 unit = frame(position);
  return { static_cast<float>(unit[0]), static_cast<float>(unit[1]), static_cast<float>(unit[2]) };
}

/// The squared distances, in the unit frame, from a point to the boxes of a treelet's children;
/// for unused places at least 1e30.
std::array<float, Treelet::kSize> squaredDistances(const Treelet& treelet, const UnitPoint& point);

/// No point of a triangle whose weights were rounded to floats lies farther than this from the box
/// of its leaf, in the unit frame: two weights and three coordinates, each off by 2^-24 of edges up
/// to 4 long.
constexpr float kStray = 0x1p-20F;

/**
 * The leaf whose box is nearest to a point, by the number of its first block. The box holds the
 * point, or all but holds it, if that lies on a triangle of the tree. Of several such leaves it is
 * always the same one. The tree must not be empty.
 */
std::uint32_t leafAt(const TriangleTree& tree, const UnitPoint& point);

/// Finds the leaves of points on triangles without a search of the tree: a triangle is listed in
/// one leaf or in few. (One that is in many is searched for.)
class LeafTable
{
public:
  LeafTable() = default;
  explicit LeafTable(const TriangleTree& tree);

  /// Of the leaves that list the triangle, the one whose box is nearest to a point on it. `tree`:
  /// the tree that the table was made from.
  std::uint32_t leafOf(
    const TriangleTree& tree, std::uint32_t triangle, const UnitPoint& point) const;
  std::size_t bytes() const;

private:
  static constexpr std::uint32_t kMany = 8; ///< leaves

  std::vector<KdBounds> boxes_;      ///< of leaves, by the number of the first block
  std::vector<std::uint32_t> begin_; ///< of the leaves of each triangle
  std::vector<std::uint32_t> leaves_;
};

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
