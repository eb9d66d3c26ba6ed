#include "TriangleTree.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

namespace
{

/// That of a rotation is at most 3.
constexpr double kMostStretch = 4;
/// Boxes below 2^-500 are points; a scale must be finite.
constexpr int kSmallestExponent = -500;

}

UnitFrame::UnitFrame(const Box& box)
{
  if (!box.isEmpty())
  {
    center = box.center();
    int exponent = 0;
    std::frexp(0.5 * box.extent().maxCoeff(), &exponent);
    // A box of no extent is a point: any scale will do.
    scale =
      box.extent().maxCoeff() > 0 ? std::ldexp(1.0, -std::max(exponent, kSmallestExponent)) : 1.0;
  }
}

/// Collapses a binary tree into treelets and blocks.
class TriangleTree::Packing
{
public:
  Packing(TriangleTree& target, const KdTree& tree, const std::vector<Triangle>& triangles)
    : target_(target)
    , tree_(tree)
    , triangles_(triangles)
  {
  }

  std::uint32_t pack(std::uint32_t node)
  {
    return tree_.nodes[node].isLeaf() ? packLeaf(tree_.nodes[node]) : packInner(node);
  }

private:
  static constexpr std::uint32_t kAbsent = 0xffffffffu;

  std::uint32_t packInner(std::uint32_t node)
  {
    std::array<std::uint32_t, 32> heap;
    heap.fill(kAbsent);
    heap[1] = node;
    Treelet treelet;
    treelet.axes = 0;
    for (std::size_t i = 1; i < 16; ++i)
    {
      const bool isInner = heap[i] != kAbsent && !tree_.nodes[heap[i]].isLeaf();
      const std::uint32_t axis =
        isInner ? static_cast<std::uint32_t>(tree_.nodes[heap[i]].axis()) : Treelet::kNoPlane;
      treelet.axes |= axis << (2 * i);
      treelet.planes[i - 1] = isInner ? tree_.nodes[heap[i]].plane : Treelet::kFar;
      // What ends early stands on the left of planes that are not there.
      heap[2 * i] = isInner ? tree_.nodes[heap[i]].index() : heap[i];
      heap[2 * i + 1] = isInner ? tree_.nodes[heap[i]].index() + 1 : kAbsent;
    }
    for (unsigned octant = 0; octant < 8; ++octant)
    {
      treelet.farToNear[octant] = farToNear(treelet, octant);
    }
    const auto place = static_cast<std::uint32_t>(target_.treelets_.size());
    target_.treelets_.emplace_back();
    for (std::size_t i = 0; i < 16; ++i)
    {
      treelet.children[i] = heap[16 + i] == kAbsent ? Treelet::kEmpty : pack(heap[16 + i]);
    }
    target_.treelets_[place] = treelet;
    return place;
  }

  static std::uint64_t farToNear(const Treelet& treelet, unsigned octant)
  {
    std::uint64_t order = 0;
    for (unsigned place = 0; place < 16; ++place)
    {
      unsigned node = 1;
      for (int level = 3; level >= 0; --level)
      {
        const std::uint32_t axis = treelet.axis(node);
        const unsigned near = axis == Treelet::kNoPlane ? 0 : octant >> axis & 1;
        node = 2 * node + ((place >> level & 1) != 0 ? near : 1 - near);
      }
      order |= std::uint64_t{ node - 16 } << (4 * place);
    }
    return order;
  }

  std::uint32_t packLeaf(const KdNode& leaf)
  {
    if (leaf.count == 0)
    {
      return Treelet::kEmpty;
    }
    const auto first = static_cast<std::uint32_t>(target_.blocks_.size());
    for (std::uint32_t i = 0; i < leaf.count; i += TriangleBlock::kSize)
    {
      const std::uint32_t count = std::min(leaf.count - i, TriangleBlock::kSize);
      target_.blocks_.push_back(block(tree_.references.data() + leaf.index() + i, count));
      if (i + TriangleBlock::kSize < leaf.count)
      {
        target_.blocks_.back().references[TriangleBlock::kSize - 1] |= TriangleBlock::kMore;
      }
    }
    return Treelet::kLeaf | first;
  }

  TriangleBlock block(const std::uint32_t* references, std::uint32_t count) const
  {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    TriangleBlock block;
    for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
    {
      const bool isUsed = lane < count;
      const Triangle& triangle = triangles_[references[isUsed ? lane : 0]];
      for (int i = 0; i < 3; ++i)
      {
        block.corner[i][lane] = static_cast<float>(triangle.a[i]);
        block.edge1[i][lane] = isUsed ? static_cast<float>(triangle.b[i] - triangle.a[i]) : kNaN;
        block.edge2[i][lane] = isUsed ? static_cast<float>(triangle.c[i] - triangle.a[i]) : kNaN;
      }
      block.references[lane] = isUsed ? references[lane] : TriangleBlock::kNone;
    }
    return block;
  }

  TriangleTree& target_;
  const KdTree& tree_;
  const std::vector<Triangle>& triangles_;
};

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles,
  const std::vector<double>& margins, double stretch, const Checkpoint& checkpoint)
  : isStretched_(stretch > kMostStretch)
{
  Box box; // with the margins, which may be larger than all else: distances in the frame are small
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    Box bounds = triangles[i].bounds();
    bounds.inflate(margins.empty() ? 0.0 : margins[i]);
    box.add(bounds);
  }
  frame_ = UnitFrame(box);
  std::vector<Triangle> unit;
  unit.reserve(triangles.size()); // primitives point into it
  std::vector<KdPrimitive> primitives;
  primitives.reserve(triangles.size());
  double longestEdge = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const Triangle& triangle = triangles[i];
    unit.push_back({ frame_(triangle.a), frame_(triangle.b), frame_(triangle.c) });
    const double margin = margins.empty() ? 0.0 : margins[i] * frame_.scale;
    Box bounds = unit.back().bounds();
    longestEdge = std::max(longestEdge, bounds.extent().norm());
    bounds.inflate(margin);
    primitives.push_back({ bounds, &unit.back(), margin });
    blur_ = std::max(blur_, margin);
  }
  slack_ = 0x1p-8 * (isStretched_ ? 4.0 : std::min(4.0, stretch * longestEdge));
  KdTreeBuilder builder;
  builder.checkpoint = checkpoint;
  const KdTree tree = builder.build(primitives);
  bounds_ = tree.bounds;
  if (!tree.isEmpty())
  {
    root_ = Packing(*this, tree, unit).pack(0);
    treelets_.shrink_to_fit();
    blocks_.shrink_to_fit();
  }
}

std::size_t TriangleTree::bytes() const
{
  return treelets_.capacity() * sizeof(Treelet) + blocks_.capacity() * sizeof(TriangleBlock);
}

TriangleTree treeOf(const std::vector<Triangle>& triangles, const Checkpoint& checkpoint)
{
  return TriangleTree(triangles, {}, 1, checkpoint);
}

}
