// SPDX-License-Identifier: BSD-3-Clause
#include "KdTreeWalk.h"
#include "TestMeshes.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

// The tree lists what it must list, is well formed, and stays small for any input.

namespace irradiance
{
namespace
{

using test::build;
using test::builderFor;
using test::kBlockSizes;
using test::NamedMesh;
using test::primitivesOf;
using test::RandomVectors;
using test::Triangles;
using test::walk;

/// True if a leaf whose widened cell contains the point lists the primitive.
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
        // Every third point is in a corner or on an edge.
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
    primitive.blur = 0x1p-6 * random.uniform(0, 1) * primitive.bounds.extent().maxCoeff();
    primitive.bounds.inflate(primitive.blur);
  }
  const KdTree tree = build(primitives, 1);
  const double slack = 0x1p-48 * tree.bounds.magnitude(); // the rounding of a point
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
  {
    const auto& [a, b, c] = triangles[i];
    for (int k = 0; k < 200 / test::kFewer; ++k)
    {
      const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
      const Vector3 off = primitives[i].blur * random.inCube();
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

/// Large triangles cross each other in one plane: in a thin cell every split seems to pay if
/// parting costs nothing, and every plane cuts many of them.
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
  KdTreeBuilder builder = builderFor(1);
  builder.partingCost = 0;
  const KdTree tree = builder.build(primitivesOf(triangles));
  EXPECT_GT(tree.references.size(), 20 * triangles.size());
  EXPECT_LE(tree.references.size(), 65 * triangles.size());
}

TEST(KdTreeBuilder, PollsItsCheckpoint)
{
  const Triangles triangles = test::icosphere(6); // 81920
  int polls = 0;
  KdTreeBuilder builder;
  builder.cancelPoint = [&] { ++polls; };
  builder.build(primitivesOf(triangles));
  // At least ten levels have as many items as the root, and polls are at most 2^15 items apart.
  EXPECT_GT(polls, 10);
  builder.cancelPoint = [] { throw std::runtime_error("stop"); };
  EXPECT_THROW(builder.build(primitivesOf(triangles)), std::runtime_error);
}

}
}
