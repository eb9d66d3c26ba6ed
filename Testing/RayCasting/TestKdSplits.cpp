// SPDX-License-Identifier: BSD-3-Clause
#include "KdTreeWalk.h"
#include "RandomVectors.h"
#include "TestMeshes.h"
#include "Trees/KdBounds.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>

// Every split is the cheapest by the heuristic, in spite of the search's shortcuts, or cuts off a
// sheet where to cut off all sheets is cheaper.

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
    const KdItem item{ KdBounds({ point, point }), 0 };
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
    const double parted = static_cast<double>(l + r) / static_cast<double>(boxes.size()) - 1;
    return l == 0 || r == 0 ? builder.emptyFactor * sum : sum * (1 + builder.partingCost * parted);
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

/// The boxes that lie flat in the faces of their hull, a list for each face, and last all others.
std::array<std::vector<Box>, 7> sheetsOf(const std::vector<Box>& boxes)
{
  Box hull;
  for (const Box& box : boxes)
  {
    hull.add(box);
  }
  std::array<std::vector<Box>, 7> sheets;
  for (const Box& box : boxes)
  {
    std::size_t face = 0;
    for (; face < 6; ++face)
    {
      const auto axis = static_cast<int>(face / 2);
      const double place = (face % 2 == 0 ? hull.lower : hull.upper)[axis];
      if (box.lower[axis] == place && box.upper[axis] == place)
      {
        break;
      }
    }
    sheets[face].push_back(box);
  }
  return sheets;
}

/// The heuristic if a plane cuts off each sheet; infinite if there are none, or one is all.
double costOfCuttingSheets(
  const std::vector<Box>& boxes, const Box& cell, const KdTreeBuilder& builder)
{
  const std::array<std::vector<Box>, 7> sheets = sheetsOf(boxes);
  double cost = sheets[6].empty() ? 0 : -builder.traversalCost;
  int parts = 0;
  for (const std::vector<Box>& part : sheets)
  {
    Box hull;
    for (const Box& box : part)
    {
      hull.add(box);
    }
    if (!part.empty())
    {
      const int blocks =
        (static_cast<int>(part.size()) + builder.blockSize - 1) / builder.blockSize;
      cost +=
        builder.traversalCost + builder.intersectionCost * areaOf(hull) / areaOf(cell) * blocks;
      ++parts;
    }
  }
  return parts < 2 ? kInfinity : cost;
}

/// The planes, each by axis and place, that cut off a sheet.
std::set<std::pair<int, double>> planesOfSheets(const std::vector<Box>& boxes, const Box& cell)
{
  const std::array<std::vector<Box>, 7> sheets = sheetsOf(boxes);
  std::set<std::pair<int, double>> planes;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const std::size_t side : { std::size_t{ 0 }, std::size_t{ 1 } })
    {
      const std::vector<Box>& sheet = sheets[2 * static_cast<std::size_t>(axis) + side];
      if (!sheet.empty() && sheet[0].lower[axis] > cell.lower[axis] &&
        sheet[0].lower[axis] < cell.upper[axis])
      {
        planes.insert({ axis, sheet[0].lower[axis] });
      }
    }
  }
  return planes;
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

/// Returns how often a sheet was cut off.
int expectBestSplits(const std::vector<KdPrimitive>& primitives, int blockSize)
{
  int sheetsCut = 0;
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
    const double leaf = builder.intersectionCost * blocks;
    const double found =
      node.isLeaf() ? leaf : costOfSplit(boxes, cell, node.axis(), node.plane, builder);
    const double best = costOfBestSplit(boxes, cell, builder);
    const std::set<std::pair<int, double>> planes = planesOfSheets(boxes, cell);
    if (static_cast<int>(boxes.size()) > blockSize && !planes.empty() &&
      costOfCuttingSheets(boxes, cell, builder) < std::min(best, leaf) * (1 - 1e-5))
    {
      EXPECT_TRUE(!node.isLeaf() && planes.count({ node.axis(), node.plane }) > 0)
        << boxes.size() << " boxes";
      ++sheetsCut;
      return;
    }
    EXPECT_LE(found, best * (1 + 1e-9)) << boxes.size() << " boxes, block size " << blockSize;
  });
  return sheetsCut;
}

TEST(KdTreeBuilder, SplitsAtTheCheapestPlane)
{
  constexpr unsigned kSeed = 2;
  RandomVectors random(kSeed);
  int sheetsCut = 0;
  for (const int count : { 2, 9, 16, 17, 40, 200, 600 / test::kFewer })
  {
    for (const double grid : { 0.0, 0x1p-4 })
    {
      for (const int blockSize : kBlockSizes)
      {
        sheetsCut += expectBestSplits(randomBoxes(count, grid, random), blockSize);
      }
    }
  }
  EXPECT_GT(sheetsCut, 10);
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

/// The walls of a room come off one by one, then what stands in it is alone.
TEST(KdTreeBuilder, CutsTheWallsOffARoom)
{
  const Vector3 size(4, 4, 3);
  const test::Triangles walls = test::boxOfCells(Vector3::Zero(), size, { 10, 10, 10 });
  std::vector<KdPrimitive> primitives = test::primitivesOf(walls);
  primitives.push_back({ Box{ { 1, 1, 1 }, { 1.5, 1.5, 1.5 } } });
  KdTreeBuilder builder;
  builder.roundsToNearest = true;
  const KdTree tree = builder.build(primitives);
  std::uint32_t node = 0;
  for (int wall = 0; wall < 6; ++wall)
  {
    ASSERT_FALSE(tree.nodes[node].isLeaf());
    const int axis = tree.nodes[node].axis();
    const float plane = tree.nodes[node].plane;
    EXPECT_TRUE(plane == 0 || plane == static_cast<float>(size[axis])) << wall;
    node = tree.nodes[node].index() + (plane == 0 ? 1 : 0);
  }
  EXPECT_EQ(primitivesBelow(tree, tree.nodes[node]), (std::set<std::uint32_t>{ 1200 }));
  EXPECT_EQ(tree.references.size(), primitives.size());
}

/// A line may lie in two sheets, and cutting off either takes it along.
TEST(KdTreeBuilder, KeepsLinesInTheEdgesOfSheets)
{
  for (unsigned seed = 1; seed <= 200; ++seed)
  {
    RandomVectors random(seed);
    std::vector<KdPrimitive> boxes;
    for (int i = 0; i < 400; ++i)
    {
      constexpr double kGrid = 4;
      Vector3 lower = (kGrid * random.inCube()).array().round();
      Vector3 upper = (kGrid * random.inCube()).array().round();
      upper[i % 3] = lower[i % 3];
      upper[(i + i / 3 % 2) % 3] = lower[(i + i / 3 % 2) % 3];
      boxes.push_back({ Box{ lower.cwiseMin(upper), lower.cwiseMax(upper) } });
    }
    for (const int blockSize : kBlockSizes)
    {
      const KdTree tree = builderFor(blockSize).build(boxes);
      ASSERT_EQ(primitivesBelow(tree, tree.nodes[0]).size(), boxes.size()) << "seed " << seed;
    }
  }
}

/// Triangles that meet at a place which is no float are parted by no plane there.
TEST(KdTreeBuilder, PartsNoCellsOfAGrid)
{
  const test::Triangles cells =
    test::grid(27, 21, [](int i, int j) { return Vector3(0.1 + i / 3.0, 0.2 + j / 7.0, 0.3); });
  for (const bool isNearest : { true, false })
  {
    KdTreeBuilder builder;
    builder.roundsToNearest = isNearest;
    const std::size_t references = builder.build(test::primitivesOf(cells)).references.size();
    EXPECT_EQ(references == cells.size(), isNearest) << references;
  }
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
