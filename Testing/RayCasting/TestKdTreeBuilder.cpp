#include "KdTreeBuilder.h"

#include "KdItem.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <stdexcept>

// The tree lists what it must, costs what the heuristic says, and stays small for any input.

namespace irradiance
{
namespace
{

using test::NamedMesh;
using test::RandomVectors;
using test::Triangles;

constexpr std::array<int, 3> kBlockSizes = { 1, 3, 8 };

std::vector<KdPrimitive> primitivesOf(const Triangles& triangles)
{
  std::vector<KdPrimitive> primitives;
  for (const Triangle& triangle : triangles)
  {
    primitives.push_back({ triangle.bounds(), &triangle });
  }
  return primitives;
}

/// The costs do not hang on what is measured to be fast.
KdTreeBuilder builderFor(int blockSize)
{
  KdTreeBuilder builder;
  builder.traversalCost = 1;
  builder.intersectionCost = 2;
  builder.emptyFactor = 0.8;
  builder.blockSize = blockSize;
  return builder;
}

KdTree build(const std::vector<KdPrimitive>& primitives, int blockSize)
{
  return builderFor(blockSize).build(primitives);
}

KdTree build(const Triangles& triangles, int blockSize)
{
  return build(primitivesOf(triangles), blockSize);
}

/// Calls visit(node, cell, depth) for each node.
template <typename Visit>
void walk(const KdTree& tree, const Visit& visit, std::uint32_t index, const Box& cell, int depth)
{
  const KdNode node = tree.nodes[index];
  visit(node, cell, depth);
  if (!node.isLeaf())
  {
    Box left = cell, right = cell;
    left.upper[node.axis()] = right.lower[node.axis()] = node.plane;
    walk(tree, visit, node.index(), left, depth + 1);
    walk(tree, visit, node.index() + 1, right, depth + 1);
  }
}

template <typename Visit>
void walk(const KdTree& tree, const Visit& visit)
{
  walk(tree, visit, 0, tree.bounds, 0);
}

/// Whether a leaf whose cell, made wider, contains the point lists the primitive.
bool isListedAt(const KdTree& tree, const Vector3& point, double slack, std::uint32_t primitive,
  std::uint32_t index = 0)
{
  const KdNode& node = tree.nodes[index];
  if (node.isLeaf())
  {
    const std::uint32_t* first = tree.references.data() + node.index();
    return std::find(first, first + node.count, primitive) != first + node.count;
  }
  const double x = point[node.axis()];
  return (x <= node.plane + slack && isListedAt(tree, point, slack, primitive, node.index())) ||
    (x >= node.plane - slack && isListedAt(tree, point, slack, primitive, node.index() + 1));
}

double areaOf(const Box& box)
{
  const Vector3 e = box.extent();
  return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

bool haveSameBits(const KdNode& a, const KdNode& b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

class KdTreeOfMesh : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(KdTreeOfMesh, ListsEveryPrimitiveWhereItIs)
{
  constexpr unsigned kSeed = 1;
  RandomVectors random(kSeed);
  const Triangles& triangles = GetParam().triangles;
  for (const int blockSize : kBlockSizes)
  {
    const KdTree tree = build(triangles, blockSize);
    const double slack = 0x1p-48 * tree.bounds.magnitude(); // the rounding of a point
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
    {
      const auto& [a, b, c] = triangles[i];
      for (int k = 0; k < 200 / test::kFewer; ++k)
      {
        // Every third in a corner or on an edge.
        const double s = k % 3 == 0 ? k / 3 % 2 : random.uniform(0, 1);
        const double t = k % 3 == 1 ? 0.0 : random.uniform(0, 1 - s);
        const Vector3 point = a + s * (b - a) + t * (c - a);
        ASSERT_TRUE(isListedAt(tree, point, slack, i))
          << "triangle " << i << " s " << s << " t " << t << " block size " << blockSize;
      }
    }
  }
}

TEST_P(KdTreeOfMesh, ListsWhatIsNearerThanItsMargin)
{
  constexpr unsigned kSeed = 5;
  RandomVectors random(kSeed);
  const Triangles& triangles = GetParam().triangles;
  std::vector<KdPrimitive> primitives = primitivesOf(triangles);
  for (KdPrimitive& primitive : primitives)
  {
    primitive.margin = 0x1p-6 * random.uniform(0, 1) * primitive.bounds.extent().maxCoeff();
    primitive.bounds.inflate(primitive.margin);
  }
  const KdTree tree = build(primitives, 1);
  const double slack = 0x1p-48 * tree.bounds.magnitude(); // the rounding of a point
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const auto& [a, b, c] = triangles[i];
    for (int k = 0; k < 200 / test::kFewer; ++k)
    {
      const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
      const Vector3 off = primitives[i].margin * random.inCube();
      const Vector3 point = a + s * (b - a) + t * (c - a) + off;
      ASSERT_TRUE(isListedAt(tree, point, slack, i)) << "triangle " << i << " point " << k;
    }
  }
}

TEST_P(KdTreeOfMesh, IsWellFormed)
{
  const Triangles& triangles = GetParam().triangles;
  for (const int blockSize : kBlockSizes)
  {
    const KdTree tree = build(triangles, blockSize);
    std::size_t nodes = 0, references = 0;
    walk(tree, [&](const KdNode& node, const Box& cell, int depth) {
      ++nodes;
      EXPECT_LE(depth, KdTree::kMaxDepth);
      if (node.isLeaf())
      {
        references += node.count;
        ASSERT_LE(node.index() + node.count, tree.references.size());
        return;
      }
      EXPECT_EQ(node.index() % 2, 0u);
      EXPECT_GT(node.plane, cell.lower[node.axis()]);
      EXPECT_LT(node.plane, cell.upper[node.axis()]);
    });
    EXPECT_EQ(nodes + 1, tree.nodes.size()); // the second is unused
    EXPECT_EQ(references, tree.references.size());
  }
}

TEST_P(KdTreeOfMesh, ScalesWithItsInput)
{
  for (const int power : { -60, -1, 33 })
  {
    const double factor = std::ldexp(1.0, power);
    const KdTree tree = build(GetParam().triangles, 8);
    const KdTree other = build(test::scaled(GetParam().triangles, factor), 8);
    EXPECT_EQ(other.references, tree.references);
    ASSERT_EQ(other.nodes.size(), tree.nodes.size());
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
    {
      KdNode expected = tree.nodes[i];
      expected.plane =
        expected.isLeaf() || i == 1 ? expected.plane : std::ldexp(expected.plane, power);
      ASSERT_TRUE(i == 1 || haveSameBits(other.nodes[i], expected)) << "node " << i;
    }
  }
}

TEST_P(KdTreeOfMesh, IsTheSameEveryTime)
{
  const KdTree tree = build(GetParam().triangles, 8);
  const KdTree other = build(GetParam().triangles, 8);
  EXPECT_EQ(other.references, tree.references);
  ASSERT_EQ(other.nodes.size(), tree.nodes.size());
  EXPECT_TRUE(std::equal(tree.nodes.begin(), tree.nodes.end(), other.nodes.begin(),
    [](const auto& a, const auto& b) { return haveSameBits(a, b); }));
}

INSTANTIATE_TEST_SUITE_P(
  Meshes, KdTreeOfMesh, testing::ValuesIn(test::testMeshes()), test::NameOfMesh());

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

/// The heuristic, by counting all boxes for one plane; those in the plane go where they cost less.
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

/// Boxes in clusters, flat ones among them, with float corners, so that planes are where they begin
/// and end; on a coarse grid many lie in one plane.
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

/// All that stand in the leaves below a node, each once.
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

/// Two heaps of `each` unit boxes, apart along x.
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
  // Both heaps fit in one block: to part them gains nothing.
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
    // One flat box between 7 and 8 others: it makes a block full, or else begins one.
    std::vector<KdPrimitive> boxes = { { Box{ { 0, 0, 1 }, { 1, 1, 1 } } } };
    for (int i = 0; i < 15; ++i)
    {
      const double z = i < below ? 0 : 1;
      boxes.push_back({ Box{ { 0, 0, z }, { 1, 1, z + 1 } } });
    }
    EXPECT_EQ(countsOfLeaves(build(boxes, 8)), (std::vector<std::uint32_t>{ 8, 8 })) << below;
  }
}

TEST(KdTreeBuilder, TakesDegenerateInput)
{
  const Triangle one{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0.5 } };
  const Triangle point{ { 3, 4, 5 }, { 3, 4, 5 }, { 3, 4, 5 } };
  const Triangle line{ { 0, 0, 0 }, { 1, 2, 3 }, { 2, 4, 6 } };
  const Vector3 far(1e30, -1e30, 1e30);
  const std::vector<Triangles> inputs = { {}, { one }, { point }, { line }, Triangles(10000, one),
    Triangles(10000, point), Triangles(10000, line), test::scaled(test::icosphere(2), 1e-44),
    test::scaled(test::icosphere(2), 1e-300), test::scaled(test::icosphere(2), 1e38),
    test::scaled(test::icosphere(2), 1e300),
    test::moved(test::icosphere(2), { Matrix3::Identity(), far }),
    test::moved(
      test::scaled(test::icosphere(2), 1e-9), { Matrix3::Identity(), Vector3(0, 1e6, 0) }),
    test::moved(test::icosphere(2), { Vector3(1, 1, 0).asDiagonal(), Vector3::Zero() }),
    test::moved(test::icosphere(2), { Vector3(1, 0, 0).asDiagonal(), Vector3::Zero() }) };
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    for (const int blockSize : kBlockSizes)
    {
      const KdTree tree = build(inputs[i], blockSize);
      EXPECT_GE(tree.references.size(), inputs[i].size()) << "input " << i;
      EXPECT_LE(tree.references.size(), 65 * inputs[i].size()) << "input " << i;
    }
  }
}

/// Large triangles across each other in one plane: in a cell without thickness, every split seems to
/// pay, and every plane parts many.
TEST(KdTreeBuilder, BoundsTheReferences)
{
  constexpr unsigned kSeed = 3;
  RandomVectors random(kSeed);
  Triangles triangles;
  for (int i = 0; i < 300; ++i)
  {
    triangles.push_back({ random.inCube(), random.inCube(), random.inCube() });
  }
  const Matrix3 flat = Vector3(1, 1, 0).asDiagonal();
  triangles = test::moved(triangles, { flat, Vector3::Zero() });
  const KdTree tree = build(triangles, 1);
  EXPECT_GT(tree.references.size(), 20 * triangles.size());
  EXPECT_LE(tree.references.size(), 65 * triangles.size());
}

TEST(KdTreeBuilder, PollsItsCheckpoint)
{
  const Triangles triangles = test::icosphere(6); // 81920
  int polls = 0;
  KdTreeBuilder builder;
  builder.checkpoint = [&] { ++polls; };
  builder.build(primitivesOf(triangles));
  // At least ten levels have as many items as the root, each at most 2^15 items after another.
  EXPECT_GT(polls, 10);
  builder.checkpoint = [] { throw std::runtime_error("stop"); };
  EXPECT_THROW(builder.build(primitivesOf(triangles)), std::runtime_error);
}

}
}
