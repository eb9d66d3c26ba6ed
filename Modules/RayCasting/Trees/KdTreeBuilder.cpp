// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/KdTreeBuilder.h"

#include "Meshes/PolygonClip.h"
#include "Trees/KdSplitSearch.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace irradiance
{

namespace
{

/// A range of the item arena.
struct Range
{
  std::size_t begin = 0, end = 0;

  std::size_t size() const { return end - begin; }
};

class Build
{
public:
  Build(const KdTreeBuilder& config, const std::vector<KdPrimitive>& primitives)
    : config_(config)
    , primitives_(primitives)
    , search_(config)
    , pace_(config.cancelPoint)
  {
    assert(config.blockSize > 0);
  }

  KdTree run()
  {
    items_.reserve(primitives_.size() + primitives_.size() / 2 + 1);
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
    {
      pace_.step();
      const KdItem item = config_.roundsToNearest ? KdItem::nearest(i, primitives_[i].bounds)
                                                  : KdItem{ KdBounds(primitives_[i].bounds), i };
      if (!item.isEmpty())
      {
        items_.push_back(item);
        tree_.bounds.add(primitives_[i].bounds);
      }
    }
    const Range all{ 0, items_.size() };
    // Clipping rounds by a few ulps of the coordinates; this is 2^8 ulps. A cell may begin or end
    // half a float away from a triangle whose bounds were rounded to the same float.
    clipError_ = (config_.roundsToNearest ? 0x1p-23 : 0x1p-44) * tree_.bounds.magnitude();
    // Leaves room behind the outermost walls, so that a plane can cut off the empty space inside.
    tree_.bounds.inflate(all.size() == 0 ? 0.0 : 0x1p-10 * tree_.bounds.extent().maxCoeff());
    maxDepth_ = depthFor(all.size());
    addPair(); // the second is unused: siblings start at even indices
    divide(0, all, tree_.bounds, 0, std::min(kCopies * all.size(), kMostReferences - all.size()));
    return std::move(tree_);
  }

private:
  /// Limits the extra references to split primitives, for input that no plane separates well.
  static constexpr std::size_t kCopies = 64;
  static constexpr std::size_t kMostReferences = std::size_t{ 1 } << 30; ///< of a KdNode

  int depthFor(std::size_t size) const
  {
    constexpr double kFarthest = 0x1p126; // differences of floats beyond may be infinite
    const double depth = 12 + 1.3 * std::log2(1.0 + static_cast<double>(size));
    return tree_.bounds.magnitude() < kFarthest
      ? std::min(KdTree::kMaxDepth, static_cast<int>(depth))
      : 0;
  }

  /// `spare` is how many items the node and all below it may add by splitting items.
  void divide(std::uint32_t node, Range range, const Box& cell, int depth, std::size_t spare)
  {
    const KdItems own{ items_.data() + range.begin, items_.data() + range.end };
    const KdSplit split = depth < maxDepth_ ? search_.best(own, cell) : KdSplit{ 0 };
    const std::size_t items = std::size_t{ split.left } + split.right;
    if (split.axis < 0 || items > range.size() + spare)
    {
      makeLeaf(node, range);
      return;
    }
    Box cells[2] = { cell, cell };
    cells[0].upper[split.axis] = cells[1].lower[split.axis] = split.plane;
    Range sides[2];
    const int kept = split.left > split.right ? 0 : 1;
    distribute(range, split, cells, kept, sides);

    const std::uint32_t child = addPair();
    tree_.nodes[node] = KdNode::inner(split.axis, split.plane, child);
    spare -= items - range.size();
    for (const int side : { 1 - kept, kept })
    {
      divide(child + side, sides[side], cells[side], depth + 1, spare * sides[side].size() / items);
      tree_.filled[node].add(tree_.filled[child + side]);
    }
  }

  /// Returns the first of two new nodes.
  std::uint32_t addPair()
  {
    const std::size_t first = tree_.nodes.size();
    tree_.nodes.resize(first + 2);
    tree_.filled.resize(first + 2);
    return static_cast<std::uint32_t>(first);
  }

  void makeLeaf(std::uint32_t node, Range range)
  {
    const auto first = static_cast<std::uint32_t>(tree_.references.size());
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      tree_.references.push_back(items_[i].primitive);
      tree_.filled[node].add(items_[i]);
    }
    tree_.nodes[node] = KdNode::leaf(first, static_cast<std::uint32_t>(range.size()));
  }

  /// The larger side stays where the items are, the other goes behind them. That other side is
  /// finished first, so that the arena holds little more than the items of one level of the tree.
  void distribute(Range range, const KdSplit& split, const Box cells[2], int kept, Range sides[2])
  {
    // One more, for the item that is written but not counted.
    const std::size_t end = range.end + std::min(split.left, split.right) + 1;
    items_.resize(std::max(items_.size(), end));
    sides[kept] = { range.begin, range.begin };
    sides[1 - kept] = { range.end, range.end };
    for (std::size_t i = range.begin; i < range.end; ++i)
    {
      pace_.step();
      const KdItem item = items_[i];
      if (split.parts(item))
      {
        appendParts(item, split.axis, cells, sides);
        continue;
      }
      // Both sides get the item, one counts it: half the branches would be mispredicted.
      const bool isLeft = split.isLeft(item);
      items_[sides[0].end] = item;
      items_[sides[1].end] = item;
      sides[0].end += isLeft ? 1 : 0;
      sides[1].end += isLeft ? 0 : 1;
    }
    assert(sides[1 - kept].end < end);
  }

  void appendParts(const KdItem& item, int axis, const Box cells[2], Range sides[2])
  {
    for (int side = 0; side < 2; ++side)
    {
      const KdItem part = clipped(item, cells[side], axis);
      if (!part.isEmpty())
      {
        items_[sides[side].end++] = part;
      }
    }
  }

  /// Invariant: where a primitive touches a cell, its item's bounds there contain the touch.
  KdItem clipped(const KdItem& item, const Box& cell, int axis) const
  {
    const KdPrimitive& primitive = primitives_[item.primitive];
    KdItem part = item;
    part.lower[axis] = std::max(part.lower[axis], roundDown(cell.lower[axis]));
    part.upper[axis] = std::min(part.upper[axis], roundUp(cell.upper[axis]));
    if (primitive.triangle)
    {
      const double pad = clipError_ + primitive.blur;
      Box wider = cell;
      wider.inflate(pad);
      Box bounds = boundsOfClipped(*primitive.triangle, wider);
      bounds.inflate(pad);
      part.intersect(KdBounds(bounds));
    }
    return part;
  }

  const KdTreeBuilder& config_;
  const std::vector<KdPrimitive>& primitives_;
  KdSplitSearch search_;
  KdTree tree_;
  std::vector<KdItem> items_;
  double clipError_ = 0;
  int maxDepth_ = 0;
  ThrottledCancelPoint pace_;
};

}

KdTree KdTreeBuilder::build(const std::vector<KdPrimitive>& primitives) const
{
  return Build(*this, primitives).run();
}

}
