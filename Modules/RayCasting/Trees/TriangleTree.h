// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Geometry/UnitFrame.h"
#include "Progress/CancelPoint.h"
#include "Simd/LargePages.h"
#include "Trees/AxisPlanes.h"
#include "Trees/KdBounds.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

struct KdPrimitive;
struct KdTreeBuilder;

/**
 * A piece of a kd-tree: up to 15 of its planes, which separate up to 16 children. For each child it
 * keeps the box that its triangles fill. One SIMD step finds which of the 16 a ray visits.
 */
struct alignas(64) Treelet
{
  static constexpr unsigned kSize = 16;
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< set with the number of the first block
  static constexpr std::uint32_t kEmpty = 0xffffffffu; ///< no child
  static constexpr float kFar = 1e30F; ///< bounds of unused boxes: they end before they begin

  float bounds[2][3][kSize];                 ///< lower and upper ones
  std::array<std::uint32_t, kSize> children; ///< a treelet, a leaf, or kEmpty
  /// For each octant of directions (bit i: component i is negative) the children from far to near.
  /// There is such an order because the cells of a kd-tree do not overlap.
  alignas(16) std::uint8_t farToNear[8][kSize];

  KdBounds box(unsigned child) const
  {
    KdBounds box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = bounds[0][axis][child];
      box.upper[axis] = bounds[1][axis][child];
    }
    return box;
  }
};

/// Eight triangles of a leaf, as floats in the unit frame, for a test that only rejects.
struct alignas(64) TriangleBlock
{
  static constexpr unsigned kSize = 8;
  static constexpr std::uint32_t kMore = 0x80000000u; ///< in the last reference: one more block
  static constexpr std::uint32_t kNone = 0x7fffffffu; ///< unused place

  float corner[3][kSize];
  float edge1[3][kSize]; ///< from the corner; NaN in unused places, which no test passes
  float edge2[3][kSize];
  std::uint32_t references[kSize];

  std::uint32_t reference(unsigned lane) const { return references[lane] & ~kMore; }
  bool isLast() const { return (references[kSize - 1] & kMore) == 0; }
};

/// Calls visit(triangle) for all that a leaf lists, given its first block; returns what follows its
/// last one.
template <class Visit>
const TriangleBlock* forEachListed(const TriangleBlock* block, const Visit& visit)
{
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
  return block;
}

/**
 * A kd-tree over triangles as SIMD searches it. It is in float and only says which triangles may be
 * hit; their owner confirms hits in double. The tree knows triangles only by their numbers.
 */
class TriangleTree
{
public:
  TriangleTree() = default;
  /// `blurs`: the position errors of the triangles; empty if they are exact. `conditionNumber`:
  /// of the map to the space in which they are tested; 1 if they are tested in this one.
  TriangleTree(const std::vector<Triangle>& triangles, const std::vector<double>& blurs,
    double conditionNumber, const CancelPoint& cancelPoint);
  /// A tree over bodies: a search finds all whose boxes it may touch, as if each held a triangle
  /// that is known only up to that box. Empty if a box is not finite. `slack`: a hit may be this
  /// much closer than its box.
  TriangleTree(const std::vector<Box>& boxes, double slack, const CancelPoint& cancelPoint);

  /// Gives its triangles these numbers, which rise, in place of 0, 1, ...
  void renumber(const std::vector<std::uint32_t>& numbers);

  bool isEmpty() const { return blocks_.empty(); }
  const UnitFrame& frame() const { return frame_; }
  /// In the unit frame.
  const Box& bounds() const { return bounds_; }
  /// How far the distance of a confirmed hit may differ from the one in the tree, in the unit
  /// frame.
  double slack() const { return slack_; }
  /// The largest position error of the triangles, in the unit frame.
  double blur() const { return blur_; }

  /// True if the test in the other space may reject what floats take for a certain hit.
  bool isIllConditioned() const { return isIllConditioned_; }

  /// The planes across axes in which triangles lie, in the unit frame. Known only if the triangles
  /// are exact.
  const AxisPlanes& planes() const { return planes_; }

  std::uint32_t root() const { return root_; }
  const Treelet* treelets() const { return treelets_.data(); }
  std::size_t numberOfTreelets() const { return treelets_.size(); }
  const TriangleBlock* blocks() const { return blocks_.data(); }
  std::size_t numberOfBlocks() const { return blocks_.size(); }

private:
  class Packing;

  void pack(const std::vector<KdPrimitive>& primitives, const std::vector<Triangle>& unit,
    const KdTreeBuilder& builder);

  UnitFrame frame_;
  Box bounds_;
  double slack_ = 0;
  double blur_ = 0;
  bool isIllConditioned_ = false;
  AxisPlanes planes_;
  std::uint32_t root_ = Treelet::kEmpty;
  std::vector<Treelet, LargePages<Treelet>> treelets_;
  std::vector<TriangleBlock, LargePages<TriangleBlock>> blocks_;
};

/// Builds the tree of a mesh in the mesh's own space.
TriangleTree treeOf(const std::vector<Triangle>& triangles, const CancelPoint& cancelPoint = {});

}
