#ifndef irradiance_TriangleTree_h
#define irradiance_TriangleTree_h

#include "KdTreeBuilder.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// unit = (position - center) * scale, with a power of two for a scale: a tree's box becomes about
/// [-1, 1]^3, so that floats serve at every scale and place, and scaling a scene by 2^k changes
/// nothing.
struct UnitFrame
{
  Vector3 center = Vector3::Zero();
  double scale = 1;

  UnitFrame() = default;
  explicit UnitFrame(const Box& box);

  Vector3 operator()(const Vector3& position) const { return (position - center) * scale; }
};

/**
 * Four levels of a kd-tree: 15 planes and 16 children, numbered as in a heap (the children of node
 * i are 2i and 2i + 1; the planes are 1..15, the children 16..31). One SIMD step decides which of
 * the 16 a ray visits.
 */
struct alignas(64) Treelet
{
  static constexpr std::uint32_t kLeaf = 0x80000000u;  ///< and the number of the first block
  static constexpr std::uint32_t kEmpty = 0xffffffffu; ///< nothing is there
  static constexpr std::uint32_t kNoPlane = 3;         ///< axis of a plane with all on its left
  static constexpr float kFar = 1e30F;                 ///< place of such a plane

  std::uint32_t axes; ///< 2 bits for each plane: axis of plane i in bits 2i and 2i + 1
  std::array<float, 15> planes;
  std::array<std::uint32_t, 16> children; ///< a treelet, a leaf, or nothing
  /// For each octant of directions (bit i: component i is negative) the 16 children from far to
  /// near, 4 bits for each. Bit l of a place says whether the child is on the near side of its
  /// plane at level 3 - l.
  std::array<std::uint64_t, 8> farToNear;

  std::uint32_t axis(unsigned plane) const { return axes >> (2 * plane) & 3; }
  float plane(unsigned plane) const { return planes[plane - 1]; }
};

/// Eight triangles of a leaf in the unit frame, in float, for a test that only rejects.
struct alignas(64) TriangleBlock
{
  static constexpr unsigned kSize = 8;
  static constexpr std::uint32_t kMore = 0x80000000u; ///< in the last reference: a block follows
  static constexpr std::uint32_t kNone = 0x7fffffffu; ///< unused place

  float corner[3][kSize];
  float edge1[3][kSize]; ///< from the corner; NaN in unused places, which no test passes
  float edge2[3][kSize];
  std::uint32_t references[kSize];

  std::uint32_t reference(unsigned lane) const { return references[lane] & ~kMore; }
  bool isLast() const { return (references[kSize - 1] & kMore) == 0; }
};

/**
 * A kd-tree over triangles as SIMD searches it. It is float and only says which triangles may be
 * hit; the owner of the triangles decides in double. Triangle i is known by its number alone.
 */
class TriangleTree
{
public:
  TriangleTree() = default;
  /// `margin`: how far the triangles may be off. `isStretched`: they are tested in another space,
  /// see slack().
  TriangleTree(const std::vector<Triangle>& triangles, const std::vector<double>& margins,
    bool isStretched, const Checkpoint& checkpoint);

  bool isEmpty() const { return blocks_.empty(); }
  const UnitFrame& frame() const { return frame_; }
  /// In the unit frame.
  const Box& bounds() const { return bounds_; }
  /// How far behind a hit others that might be closer are looked for, in the unit frame.
  double slack() const { return slack_; }
  /// How far off the triangles may be, in the unit frame.
  double blur() const { return blur_; }

  std::uint32_t root() const { return root_; }
  const Treelet* treelets() const { return treelets_.data(); }
  const TriangleBlock* blocks() const { return blocks_.data(); }
  std::size_t bytes() const;

private:
  class Packing;

  UnitFrame frame_;
  Box bounds_;
  double slack_ = 0;
  double blur_ = 0;
  std::uint32_t root_ = Treelet::kEmpty;
  std::vector<Treelet> treelets_;
  std::vector<TriangleBlock> blocks_;
};

/// The tree of a mesh in the mesh's own space.
TriangleTree treeOf(const std::vector<Triangle>& triangles, const Checkpoint& checkpoint = {});

}

#endif
