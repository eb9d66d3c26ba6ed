#include "KdTreeBuilder.h"

#include "PolygonClip.h"

#include <algorithm>
#include <array>

namespace irradiance
{

namespace
{

/// A primitive as far as it lies in the current cell.
struct Item
{
  std::uint32_t primitive;
  Box bounds;
};

struct Split
{
  double cost;
  int axis = -1;
  float plane = 0;
  bool flatGoLeft = true; ///< side of the items that lie in the plane
};

float roundDown(double x)
{
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -HUGE_VALF) : f;
}

float roundUp(double x)
{
  const float f = static_cast<float>(x);
  return f < x ? std::nextafter(f, HUGE_VALF) : f;
}

/// Where the items of one axis begin, end, or lie flat; each sorted.
struct Events
{
  std::vector<double> begins, ends, flats;

  void collect(const std::vector<Item>& items, int axis)
  {
    begins.clear();
    ends.clear();
    flats.clear();
    for (const Item& item : items)
    {
      const double lower = item.bounds.lower[axis], upper = item.bounds.upper[axis];
      if (lower == upper)
      {
        flats.push_back(lower);
      }
      else
      {
        begins.push_back(lower);
        ends.push_back(upper);
      }
    }
    std::sort(begins.begin(), begins.end());
    std::sort(ends.begin(), ends.end());
    std::sort(flats.begin(), flats.end());
  }
};

std::size_t passEqual(const std::vector<double>& sorted, std::size_t& position, double value)
{
  const std::size_t first = position;
  while (position < sorted.size() && sorted[position] == value)
  {
    ++position;
  }
  return position - first;
}

class Build
{
public:
  Build(const KdTreeBuilder& config, const std::vector<KdPrimitive>& primitives)
    : config_(config)
    , primitives_(primitives)
  {
  }

  KdTree run()
  {
    std::vector<Item> items;
    for (std::uint32_t i = 0; i < primitives_.size(); ++i)
    {
      items.push_back({ i, primitives_[i].bounds });
      tree_.bounds.add(primitives_[i].bounds);
    }
    // Rounding of a clip is a few ulps of the coordinates; this is 2^8 of them.
    clipError_ = 0x1p-44 * tree_.bounds.magnitude();
    // Room behind the outermost walls, so that a plane can part them from the empty space inside.
    tree_.bounds.inflate(items.empty() ? 0.0 : 0x1p-10 * tree_.bounds.extent().maxCoeff());
    maxDepth_ = std::min<int>(KdTree::kMaxDepth,
      static_cast<int>(12 + 1.3 * std::log2(1.0 + static_cast<double>(items.size()))));
    tree_.nodes.resize(2); // the second is unused: siblings start at even places
    if (items.empty())
    {
      tree_.nodes[0] = KdNode::leaf(0, 0);
    }
    else
    {
      divide(0, items, tree_.bounds, 0);
    }
    return std::move(tree_);
  }

private:
  void divide(std::uint32_t node, std::vector<Item>& items, const Box& cell, int depth)
  {
    pollCheckpoint(items.size());
    const Split split = depth < maxDepth_ ? bestSplit(items, cell) : Split{ 0 };
    if (split.axis < 0)
    {
      makeLeaf(node, items);
      return;
    }
    Box leftCell = cell, rightCell = cell;
    leftCell.upper[split.axis] = rightCell.lower[split.axis] = split.plane;
    std::vector<Item> left, right;
    distribute(items, split, leftCell, rightCell, left, right);
    std::vector<Item>().swap(items); // the way down needs the memory

    const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.resize(child + 2);
    tree_.nodes[node] = KdNode::inner(split.axis, split.plane, child);
    divide(child, left, leftCell, depth + 1);
    divide(child + 1, right, rightCell, depth + 1);
  }

  void makeLeaf(std::uint32_t node, const std::vector<Item>& items)
  {
    const auto first = static_cast<std::uint32_t>(tree_.references.size());
    for (const Item& item : items)
    {
      tree_.references.push_back(item.primitive);
    }
    tree_.nodes[node] = KdNode::leaf(first, static_cast<std::uint32_t>(items.size()));
  }

  Split bestSplit(const std::vector<Item>& items, const Box& cell)
  {
    Split best{ config_.intersectionCost * static_cast<double>(items.size()) };
    for (int axis = 0; axis < 3; ++axis)
    {
      if (cell.lower[axis] < cell.upper[axis])
      {
        events_.collect(items, axis);
        sweep(axis, items.size(), cell, best);
      }
    }
    return best;
  }

  /// Moves a plane over the axis, counting what lies on either side.
  void sweep(int axis, std::size_t count, const Box& cell, Split& best) const
  {
    std::size_t begin = 0, end = 0, flat = 0;
    std::size_t left = 0, right = count;
    while (
      begin < events_.begins.size() || end < events_.ends.size() || flat < events_.flats.size())
    {
      double x = kInfinity;
      x = begin < events_.begins.size() ? std::min(x, events_.begins[begin]) : x;
      x = end < events_.ends.size() ? std::min(x, events_.ends[end]) : x;
      x = flat < events_.flats.size() ? std::min(x, events_.flats[flat]) : x;
      const std::size_t ending = passEqual(events_.ends, end, x);
      const std::size_t lying = passEqual(events_.flats, flat, x);
      const std::size_t beginning = passEqual(events_.begins, begin, x);
      right -= ending + lying;
      // Rounded so that what ends here stays left of the plane, or what begins here right of it.
      const float plane = beginning > ending ? roundDown(x) : roundUp(x);
      if (plane > cell.lower[axis] && plane < cell.upper[axis])
      {
        consider({ 0, axis, plane, true }, left + lying, right, cell, best);
        if (lying > 0)
        {
          consider({ 0, axis, plane, false }, left, right + lying, cell, best);
        }
      }
      left += beginning + lying;
    }
  }

  void consider(
    Split split, std::size_t left, std::size_t right, const Box& cell, Split& best) const
  {
    const Vector3 extent = cell.extent();
    const double cap = extent[(split.axis + 1) % 3] * extent[(split.axis + 2) % 3];
    const double rim = extent[(split.axis + 1) % 3] + extent[(split.axis + 2) % 3];
    const double area = cap + rim * extent[split.axis];
    if (!(area > 0))
    {
      return;
    }
    const double leftArea = cap + rim * (split.plane - cell.lower[split.axis]);
    const double rightArea = cap + rim * (cell.upper[split.axis] - split.plane);
    split.cost = config_.traversalCost +
      config_.intersectionCost *
        (leftArea * static_cast<double>(left) + rightArea * static_cast<double>(right)) / area;
    if (left == 0 || right == 0)
    {
      split.cost *= config_.emptyFactor;
    }
    if (split.cost < best.cost)
    {
      best = split;
    }
  }

  /// Invariant: where a primitive touches a cell, its item there has bounds that contain the touch.
  void distribute(const std::vector<Item>& items, const Split& split, const Box& leftCell,
    const Box& rightCell, std::vector<Item>& left, std::vector<Item>& right) const
  {
    for (const Item& item : items)
    {
      const double lower = item.bounds.lower[split.axis], upper = item.bounds.upper[split.axis];
      if (lower == upper && lower == split.plane)
      {
        (split.flatGoLeft ? left : right).push_back(item);
      }
      else if (upper <= split.plane)
      {
        left.push_back(item);
      }
      else if (lower >= split.plane)
      {
        right.push_back(item);
      }
      else
      {
        addClipped(item, leftCell, left);
        addClipped(item, rightCell, right);
      }
    }
  }

  void addClipped(const Item& item, const Box& cell, std::vector<Item>& items) const
  {
    const KdPrimitive& primitive = primitives_[item.primitive];
    Box bounds = item.bounds.intersection(cell);
    if (primitive.triangle)
    {
      const double margin = clipError_ + primitive.margin;
      Box wider = cell;
      wider.inflate(margin);
      Box clipped = boundsOfClipped(*primitive.triangle, wider);
      clipped.inflate(margin);
      bounds = bounds.intersection(clipped);
    }
    if (!bounds.isEmpty())
    {
      items.push_back({ item.primitive, bounds });
    }
  }

  void pollCheckpoint(std::size_t work)
  {
    constexpr std::size_t kItemsBetween = 1u << 15;
    sincePoll_ += work;
    if (sincePoll_ >= kItemsBetween && config_.checkpoint)
    {
      sincePoll_ = 0;
      config_.checkpoint();
    }
  }

  const KdTreeBuilder& config_;
  const std::vector<KdPrimitive>& primitives_;
  KdTree tree_;
  Events events_;
  double clipError_ = 0;
  int maxDepth_ = 0;
  std::size_t sincePoll_ = 0;
};

}

KdTree KdTreeBuilder::build(const std::vector<KdPrimitive>& primitives) const
{
  return Build(*this, primitives).run();
}

}
