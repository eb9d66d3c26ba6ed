// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_TriangleTree_h
#define irradiance_TriangleTree_h

#include "Geometry/Triangle.h"
#include "Geometry/UnitFrame.h"
#include "Progress/CancelPoint.h"
#include "Simd/LargePages.h"
#include "Trees/AxisPlanes.h"
#include "Trees/Treelet.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

struct KdPrimitive;
struct KdTreeBuilder;

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
  const TriangleBlock* blocks() const { return blocks_.data(); }
  std::size_t numberOfBlocks() const { return blocks_.size(); }
  std::size_t bytes() const;

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

#endif
