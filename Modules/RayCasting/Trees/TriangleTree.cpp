// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/TriangleTree.h"

#include "Trees/KdTreeBuilder.h"
#include "Trees/TreeletPlan.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace irradiance
{

namespace
{

/// The condition number of a rotation is at most 3.
constexpr double kMostConditionNumber = 4;

}

/// Collapses a binary tree into treelets and blocks.
class TriangleTree::Packing
{
public:
  Packing(TriangleTree& target, const KdTree& tree, const std::vector<Triangle>& triangles,
    const CancelPoint& cancelPoint)
    : target_(target)
    , tree_(tree)
    , triangles_(triangles)
    , pace_(cancelPoint)
    , plan_(tree, cancelPoint)
  {
    std::size_t blocks = 0;
    for (const KdNode& node : tree.nodes)
    {
      blocks += node.isLeaf() ? (node.count + TriangleBlock::kSize - 1) / TriangleBlock::kSize : 0;
    }
    target.blocks_.reserve(blocks);
  }

  std::uint32_t pack(std::uint32_t number)
  {
    pace_.step(Treelet::kSize);
    const std::uint32_t node = forkAt(tree_, number);
    return tree_.nodes[node].isLeaf() ? packLeaf(tree_.nodes[node]) : packInner(node);
  }

  /// Widens the box of a child, and all below it, by at most two floats: to hold its triangles,
  /// whose bounds the builder rounded to the nearest floats, and where a plane would hide them.
  void widen(std::uint32_t child, KdBounds& box)
  {
    if ((child & Treelet::kLeaf) != 0)
    {
      const TriangleBlock* block = target_.blocks_.data() + (child & ~Treelet::kLeaf);
      holdTriangles(block, box);
      return separate(block, box);
    }
    pace_.step(Treelet::kSize);
    Treelet& treelet = target_.treelets_[child];
    for (unsigned lane = 0; lane < Treelet::kSize; ++lane)
    {
      if (treelet.children[lane] != Treelet::kEmpty)
      {
        KdBounds below = treelet.box(lane);
        widen(treelet.children[lane], below);
        setBox(treelet, lane, below);
        box.add(below);
      }
    }
  }

private:
  /// A kd-tree node within a treelet.
  struct Part
  {
    std::uint32_t node;
    int axis;               ///< of its plane; negative if it is a child of the treelet
    unsigned left, right;   ///< the parts on either side of the plane
    std::uint8_t place = 0; ///< the lane of a child
  };

  /// Returns the index of the node's part.
  unsigned addParts(std::uint32_t number, unsigned mostChildren, std::vector<Part>& parts) const
  {
    const std::uint32_t fork = forkAt(tree_, number);
    const auto part = static_cast<unsigned>(parts.size());
    parts.push_back({ fork, -1, 0, 0 });
    const KdNode& node = tree_.nodes[fork];
    const unsigned onLeft = plan_.onLeft(fork, mostChildren);
    if (onLeft != 0)
    {
      const unsigned left = addParts(node.index(), onLeft, parts);
      const unsigned right = addParts(node.index() + 1, mostChildren - onLeft, parts);
      parts[part] = { fork, node.axis(), left, right };
    }
    return part;
  }

  std::uint32_t packInner(std::uint32_t node)
  {
    std::vector<Part> parts;
    addParts(node, Treelet::kSize, parts);
    Treelet treelet = emptyTreelet();
    std::vector<std::uint32_t> children;
    for (Part& part : parts)
    {
      if (part.axis < 0)
      {
        part.place = static_cast<std::uint8_t>(children.size());
        setBox(treelet, part.place, tree_.filled[part.node]);
        children.push_back(part.node);
      }
    }
    for (unsigned octant = 0; octant < 8; ++octant)
    {
      std::uint8_t* const order = treelet.farToNear[octant];
      std::iota(sortFarToNear(parts, 0, octant, order), order + Treelet::kSize,
        static_cast<std::uint8_t>(children.size()));
    }
    const auto place = static_cast<std::uint32_t>(target_.treelets_.size());
    target_.treelets_.emplace_back();
    for (std::size_t i = 0; i < children.size(); ++i)
    {
      treelet.children[i] = pack(children[i]);
    }
    target_.treelets_[place] = treelet;
    return place;
  }

  static Treelet emptyTreelet()
  {
    Treelet treelet;
    treelet.children.fill(Treelet::kEmpty);
    std::fill_n(&treelet.bounds[0][0][0], 3 * Treelet::kSize, Treelet::kFar);
    std::fill_n(&treelet.bounds[1][0][0], 3 * Treelet::kSize, -Treelet::kFar);
    return treelet;
  }

  void holdTriangles(const TriangleBlock* block, KdBounds& box) const
  {
    const KdBounds rounded = box;
    forEachListed(block, [&](std::uint32_t reference) {
      const Box whole = triangles_[reference].bounds();
      for (int axis = 0; axis < 3; ++axis)
      {
        if (static_cast<float>(whole.lower[axis]) == rounded.lower[axis])
        {
          box.lower[axis] = std::min(box.lower[axis], roundDown(whole.lower[axis]));
        }
        if (static_cast<float>(whole.upper[axis]) == rounded.upper[axis])
        {
          box.upper[axis] = std::max(box.upper[axis], roundUp(whole.upper[axis]));
        }
      }
    });
  }

  /// Widens the box of a leaf where a plane would hide triangles in it.
  void separate(const TriangleBlock* block, KdBounds& box) const
  {
    KdBounds wider = box;
    forEachListed(block, [&](std::uint32_t reference) {
      const Box whole = triangles_[reference].bounds();
      for (int axis = 0; axis < 3; ++axis)
      {
        if (target_.planes_.hide(axis, -1, box.lower[axis], whole))
        {
          wider.lower[axis] = std::nextafter(box.lower[axis], -HUGE_VALF);
        }
        if (target_.planes_.hide(axis, 1, box.upper[axis], whole))
        {
          wider.upper[axis] = std::nextafter(box.upper[axis], HUGE_VALF);
        }
      }
    });
    box = wider;
  }

  static void setBox(Treelet& treelet, unsigned place, const KdBounds& bounds)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      treelet.bounds[0][axis][place] = bounds.lower[axis];
      treelet.bounds[1][axis][place] = bounds.upper[axis];
    }
  }

  /// Writes the lanes of the children of a part from far to near; returns the end.
  static std::uint8_t* sortFarToNear(
    const std::vector<Part>& parts, unsigned number, unsigned octant, std::uint8_t* order)
  {
    const Part& part = parts[number];
    if (part.axis < 0)
    {
      *order = part.place;
      return order + 1;
    }
    const bool isLeftNear = (octant >> part.axis & 1) == 0;
    order = sortFarToNear(parts, isLeftNear ? part.right : part.left, octant, order);
    return sortFarToNear(parts, isLeftNear ? part.left : part.right, octant, order);
  }

  std::uint32_t packLeaf(const KdNode& leaf)
  {
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
  ThrottledCancelPoint pace_;
  TreeletPlan plan_;
};

TriangleTree::TriangleTree(const std::vector<Triangle>& triangles, const std::vector<double>& blurs,
  double conditionNumber, const CancelPoint& cancelPoint)
  : isIllConditioned_(conditionNumber > kMostConditionNumber)
{
  ThrottledCancelPoint pace(cancelPoint);
  Box box; // includes the blurs, which may dominate, so that distances in the frame stay small
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    Box bounds = triangles[i].bounds();
    bounds.inflate(blurs.empty() ? 0.0 : blurs[i]);
    box.add(bounds);
    pace.step();
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
    const double blur = blurs.empty() ? 0.0 : blurs[i] * frame_.scale;
    Box bounds = unit.back().bounds();
    longestEdge = std::max(longestEdge, bounds.extent().norm());
    bounds.inflate(blur);
    primitives.push_back({ bounds, &unit.back(), blur });
    blur_ = std::max(blur_, blur);
    pace.step();
  }
  slack_ = 0x1p-8 * (isIllConditioned_ ? 4.0 : std::min(4.0, conditionNumber * longestEdge));
  if (blurs.empty())
  {
    planes_ = AxisPlanes(unit, cancelPoint);
  }
  KdTreeBuilder builder;
  builder.cancelPoint = cancelPoint;
  builder.roundsToNearest = blurs.empty();
  pack(primitives, unit, builder);
}

TriangleTree::TriangleTree(
  const std::vector<Box>& boxes, double slack, const CancelPoint& cancelPoint)
{
  Box all;
  for (const Box& box : boxes)
  {
    all.add(box);
  }
  if (!std::isfinite(all.magnitude()))
  {
    return;
  }
  frame_ = UnitFrame(all);
  std::vector<KdPrimitive> primitives(boxes.size());
  std::transform(boxes.begin(), boxes.end(), primitives.begin(), [&](const Box& box) {
    return KdPrimitive{ { frame_(box.lower), frame_(box.upper) } };
  });
  constexpr double kBeyondTheFrame = 0x1p20;
  blur_ = kBeyondTheFrame; // no test rejects
  slack_ = slack * frame_.scale;
  KdTreeBuilder builder;
  builder.cancelPoint = cancelPoint;
  builder.blockSize = 1;
  pack(primitives,
    std::vector<Triangle>(boxes.size(), { Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY() }),
    builder);
}

void TriangleTree::pack(const std::vector<KdPrimitive>& primitives,
  const std::vector<Triangle>& unit, const KdTreeBuilder& builder)
{
  const KdTree tree = builder.build(primitives);
  bounds_ = tree.bounds;
  if (!tree.isEmpty())
  {
    Packing packing(*this, tree, unit, builder.cancelPoint);
    root_ = packing.pack(0);
    if (builder.roundsToNearest)
    {
      KdBounds box;
      packing.widen(root_, box);
    }
    treelets_.shrink_to_fit();
  }
}

void TriangleTree::renumber(const std::vector<std::uint32_t>& numbers)
{
  for (TriangleBlock& block : blocks_)
  {
    for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
    {
      if (block.reference(lane) != TriangleBlock::kNone)
      {
        block.references[lane] =
          numbers[block.reference(lane)] | (block.references[lane] & TriangleBlock::kMore);
      }
    }
  }
  planes_.renumber(numbers);
}

TriangleTree treeOf(const std::vector<Triangle>& triangles, const CancelPoint& cancelPoint)
{
  return TriangleTree(triangles, {}, 1, cancelPoint);
}

}
