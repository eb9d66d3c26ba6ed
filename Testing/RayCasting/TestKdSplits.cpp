// SPDX-License-Identifier: BSD-3-Clause
#include "KdTreeWalk.h"
#include "RandomVectors.h"
#include "TestMeshes.h"
#include "Trees/KdItem.h"

#include <gtest/gtest.h>

#include <set>

// Every split is the cheapest by the heuristic, in spite of the search's shortcuts.

namespace irradiance
{
namespace
{

using test::areaOf;
using test::build;
using test::builderFor;
using test::kBlockSizes;
using test::RandomVectors;
using test::walk;

TEST(KdItem, RoundsOutwardsToTheNextFloat)
{
  constexpr unsigned kSeed = 4;
  RandomVectors random(kSeed);
  for (int i = 0; i < 10000; ++i)
  {
    const Vector3 point = random.powerOfTwo(-50, 50) * random.inCube();
    const KdItem item = KdItem::of(0, { point, point });
    for (int axis = 0; axis < 3; ++axis)
    {
      const float lower = item.lower[axis], upper = item.upper[axis];
      ASSERT_TRUE(lower <= point[axis] && point[axis] <= upper) << point.transpose();
      ASSERT_LE(upper, std::nextafter(lower, HUGE_VALF)) << point.transpose();
    }
  }
}

/// The heuristic, counting all boxes for one plane; those in the plane go where they cost less.
double costOfSplit(const std::vector<Box>& boxes, const Box& cell, int axis, double plane,
  const KdTreeBuilder& builder)
{
  Box left = cell, right = cell;
  left.upper[axis] = right.lower[axis] = plane;
  int inLeft = 0, inRight = 0, flat = 0;
  for (const Box& box : boxes)
  {
    inLeft += box.lower[axis] < plane ? 1 : 0;
    inRight += box.upper[axis] > plane ? 1 : 0;
    flat += box.lower[axis] == plane && box.upper[axis] == plane ? 1 : 0;
  }
  const auto cost = [&](int l, int r) {
    const auto blocks = [&](int n) { return (n + builder.blockSize - 1) / builder.blockSize; };
    const double sum = builder.traversalCost +
      builder.intersectionCost * (areaOf(left) * blocks(l) + areaOf(right) * blocks(r)) /
        areaOf(cell);
    return l == 0 || r == 0 ? builder.emptyFactor * sum : sum;
  };
  return std::min(cost(inLeft + flat, inRight), cost(inLeft, inRight + flat));
}

double costOfBestSplit(const std::vector<Box>& boxes, const Box& cell, const KdTreeBuilder& builder)
{
  double best = kInfinity;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const Box& box : boxes)
    {
      for (const double plane : { box.lower[axis], box.upper[axis] })
      {
        if (plane > cell.lower[axis] && plane < cell.upper[axis])
        {
          best = std::min(best, costOfSplit(boxes, cell, axis, plane, builder));
        }
      }
    }
  }
  return best;
}

/// Boxes in clusters, some of them flat. Their corners are floats, so that planes are exactly where
/// they begin and end; on a coarse grid many lie in one plane.
std::vector<KdPrimitive> randomBoxes(int count, double grid, RandomVectors& random)
{
  const auto onGrid = [&](double x) {
    return grid > 0 ? grid * std::round(x / grid) : static_cast<double>(roundDown(x));
  };
  std::vector<KdPrimitive> boxes;
  Vector3 cluster = random.inCube();
  for (int i = 0; i < count; ++i)
  {
    cluster = i % 50 == 0 ? random.inCube() : cluster;
    const Vector3 center = cluster + random.powerOfTwo(-6, -1) * random.inCube();
    Vector3 half = random.powerOfTwo(-12, -2) * random.inCube().cwiseAbs();
    half[i % 3] = i % 4 == 0 ? 0 : half[i % 3];
    Box box;
    for (int axis = 0; axis < 3; ++axis)
    {
      box.lower[axis] = onGrid(center[axis] - half[axis]);
      box.upper[axis] = onGrid(center[axis] + half[axis]);
    }
    boxes.push_back({ box });
  }
  return boxes;
}

/// All primitives in the leaves below a node, each once.
std::set<std::uint32_t> primitivesBelow(const KdTree& tree, const KdNode& node)
{
  const std::uint32_t* first = tree.references.data() + node.index();
  if (node.isLeaf())
  {
    return { first, first + node.count };
  }
  std::set<std::uint32_t> all = primitivesBelow(tree, tree.nodes[node.index()]);
  all.merge(primitivesBelow(tree, tree.nodes[node.index() + 1]));
  return all;
}

void expectBestSplits(const std::vector<KdPrimitive>& primitives, int blockSize)
{
  const KdTreeBuilder builder = builderFor(blockSize);
  const KdTree tree = builder.build(primitives);
  walk(tree, [&](const KdNode& node, const Box& cell, int depth) {
    constexpr int kLeastMaxDepth = 12;
    if (node.isLeaf() && depth >= kLeastMaxDepth)
    {
      return;
    }
    std::vector<Box> boxes;
    for (const std::uint32_t i : primitivesBelow(tree, node))
    {
      boxes.push_back(primitives[i].bounds.intersection(cell));
    }
    const int blocks = (static_cast<int>(boxes.size()) + blockSize - 1) / blockSize;
    const double found = node.isLeaf() ? builder.intersectionCost * blocks
                                       : costOfSplit(boxes, cell, node.axis(), node.plane, builder);
    const double best = costOfBestSplit(boxes, cell, builder);
    EXPECT_LE(found, best * (1 + 1e-9)) << boxes.size() << " boxes, block size " << blockSize;
  });
}

TEST(KdTreeBuilder, SplitsAtTheCheapestPlane)
{
  constexpr unsigned kSeed = 2;
  RandomVectors random(kSeed);
  for (const int count : { 2, 9, 16, 17, 40, 200, 600 / test::kFewer })
  {
    for (const double grid : { 0.0, 0x1p-4 })
    {
      for (const int blockSize : kBlockSizes)
      {
        expectBestSplits(randomBoxes(count, grid, random), blockSize);
      }
    }
  }
}

/// Two heaps of `each` unit boxes, separated along x.
std::vector<KdPrimitive> twoHeaps(int each)
{
  std::vector<KdPrimitive> boxes;
  for (int i = 0; i < 2 * each; ++i)
  {
    const double x = i < each ? 0 : 100;
    boxes.push_back({ Box{ { x, 0, 0 }, { x + 1, 1, 1 } } });
  }
  return boxes;
}

std::vector<std::uint32_t> countsOfLeaves(const KdTree& tree)
{
  std::vector<std::uint32_t> counts;
  walk(tree, [&](const KdNode& node, const Box&, int) {
    if (node.isLeaf() && node.count > 0)
    {
      counts.push_back(node.count);
    }
  });
  return counts;
}

TEST(KdTreeBuilder, PartsWhatFillsBlocks)
{
  EXPECT_EQ(countsOfLeaves(build(twoHeaps(8), 8)), (std::vector<std::uint32_t>{ 8, 8 }));
  // Both heaps fit in one block, so separating them gains nothing.
  EXPECT_EQ(countsOfLeaves(build(twoHeaps(4), 8)), (std::vector<std::uint32_t>{ 8 }));
  EXPECT_EQ(countsOfLeaves(build(twoHeaps(4), 1)), (std::vector<std::uint32_t>{ 4, 4 }));
}

TEST(KdTreeBuilder, CutsOffEmptySpace)
{
  const Box tiny{ { 0, 0, 0 }, { 1, 1, 1 } }, far{ { 100, 100, 100 }, { 101, 101, 101 } };
  const KdTree tree = build({ { tiny }, { tiny }, { far } }, 1);
  double area = 0;
  walk(tree, [&](const KdNode& node, const Box& cell, int) {
    area += node.isLeaf() && node.count > 0 ? areaOf(cell) : 0;
  });
  EXPECT_LT(area, 20);
}

TEST(KdTreeBuilder, PutsFlatItemsWhereTheyCostLess)
{
  for (const int below : { 7, 8 })
  {
    // One flat box between 7 and 8 others either fills a block or begins one.
    std::vector<KdPrimitive> boxes = { { Box{ { 0, 0, 1 }, { 1, 1, 1 } } } };
    for (int i = 0; i < 15; ++i)
    {
      const double z = i < below ? 0 : 1;
      boxes.push_back({ Box{ { 0, 0, z }, { 1, 1, z + 1 } } });
    }
    EXPECT_EQ(countsOfLeaves(build(boxes, 8)), (std::vector<std::uint32_t>{ 8, 8 })) << below;
  }
}

}
}
