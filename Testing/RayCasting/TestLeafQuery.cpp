// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/Ray.h"
#include "TestMeshes.h"
#include "Trees/LeafQuery.h"

#include <gtest/gtest.h>

#include <map>

// The leaves of points on triangles, compared with a look at all leaves.

namespace irradiance
{
namespace
{

using test::NamedMesh;

struct Leaf
{
  Box box; ///< in the unit frame
  std::vector<std::uint32_t> triangles;
};

void addLeaves(const TriangleTree& tree, std::uint32_t node, const Box& box,
  std::map<std::uint32_t, Leaf>& leaves)
{
  if ((node & Treelet::kLeaf) == 0)
  {
    const Treelet& treelet = tree.treelets()[node];
    for (unsigned child = 0; child < Treelet::kSize; ++child)
    {
      const auto& b = treelet.bounds;
      const Box inner{ { b[0][0][child], b[0][1][child], b[0][2][child] },
        { b[1][0][child], b[1][1][child], b[1][2][child] } };
      if (treelet.children[child] != Treelet::kEmpty)
      {
        addLeaves(tree, treelet.children[child], inner, leaves);
      }
    }
    return;
  }
  Leaf& leaf = leaves[node & ~Treelet::kLeaf];
  leaf.box = box;
  for (const TriangleBlock* block = tree.blocks() + (node & ~Treelet::kLeaf);; ++block)
  {
    for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
    {
      if (block->reference(lane) != TriangleBlock::kNone)
      {
        leaf.triangles.push_back(block->reference(lane));
      }
    }
    if (block->isLast())
    {
      return;
    }
  }
}

double distance(const Box& box, const UnitPoint& point)
{
  const Vector3 at(point[0], point[1], point[2]);
  return (box.lower - at).cwiseMax(at - box.upper).cwiseMax(0.0).norm();
}

/// As photons have them: weights of a hit, rounded to floats.
UnitPoint pointOn(const TriangleTree& tree, const Triangle& triangle, test::RandomVectors& random)
{
  Hit hit;
  // On edges and at corners, too.
  const double b = random.engine() % 8 == 0 ? 0 : random.uniform(0, 1);
  const double c = random.engine() % 8 == 0 ? 1 - b : random.uniform(0, 1 - b);
  hit.weights = { static_cast<float>(b), static_cast<float>(c) };
  const Vector3 w = weightsOf(hit);
  return unitPoint(tree.frame(), w[0] * triangle.a + w[1] * triangle.b + w[2] * triangle.c);
}

class LeavesOfMesh : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(LeavesOfMesh, HoldThePointsOfTriangles)
{
  const std::vector<Triangle>& triangles = GetParam().triangles;
  const TriangleTree tree = treeOf(triangles);
  const LeafTable table(tree);
  std::map<std::uint32_t, Leaf> leaves;
  if (!tree.isEmpty())
  {
    const Box& all = tree.bounds();
    addLeaves(tree, tree.root(), all, leaves);
  }
  test::RandomVectors random(7);
  for (int i = 0; i < 3000 / test::kFewer && !triangles.empty(); ++i)
  {
    const auto triangle = static_cast<std::uint32_t>(random.engine() % triangles.size());
    if (!(triangles[triangle].area() > 0))
    {
      continue; // nothing hits it
    }
    const UnitPoint point = pointOn(tree, triangles[triangle], random);
    double nearest = kInfinity, nearestListing = kInfinity;
    for (const auto& [number, leaf] : leaves)
    {
      const double away = distance(leaf.box, point);
      nearest = std::min(nearest, away);
      if (std::find(leaf.triangles.begin(), leaf.triangles.end(), triangle) != leaf.triangles.end())
      {
        nearestListing = std::min(nearestListing, away);
      }
    }
    EXPECT_LE(nearestListing, kStray);
    const std::uint32_t found = leafAt(tree, point);
    ASSERT_EQ(leaves.count(found), 1u);
    // Of boxes on which floats do not agree with doubles, it may be either.
    EXPECT_LE(distance(leaves.at(found).box, point), nearest * (1 + 0x1p-20));
    EXPECT_EQ(leafAt(tree, point), found);
    const std::uint32_t listing = table.leafOf(tree, triangle, point);
    ASSERT_EQ(leaves.count(listing), 1u);
    EXPECT_LE(distance(leaves.at(listing).box, point), kStray);
  }
}

INSTANTIATE_TEST_SUITE_P(
  LeafQuery, LeavesOfMesh, testing::ValuesIn(test::testMeshes()), test::NameOfMesh());

}

// Points on no triangle have a leaf, too: the nearest.
TEST(LeafQuery, FarPoints)
{
  test::RandomVectors random(8);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 500; ++i)
  {
    const Vector3 a = random.inCube();
    triangles.push_back({ a, a + 0.1 * random.inCube(), a + 0.1 * random.inCube() });
  }
  const TriangleTree tree = treeOf(triangles);
  std::map<std::uint32_t, Leaf> leaves;
  addLeaves(tree, tree.root(), tree.bounds(), leaves);
  for (int i = 0; i < 2000; ++i)
  {
    const Vector3 far = 3 * random.inCube();
    const UnitPoint point = unitPoint(tree.frame(), far);
    double nearest = kInfinity;
    for (const auto& [number, leaf] : leaves)
    {
      nearest = std::min(nearest, distance(leaf.box, point));
    }
    EXPECT_NEAR(distance(leaves.at(leafAt(tree, point)).box, point), nearest, 1e-6 * nearest);
  }
}

TEST(LeafQuery, OneLeafIsThatOfAll)
{
  const TriangleTree tree = treeOf({ { Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY() } });
  EXPECT_EQ(leafAt(tree, { 0.5F, 0, 0 }), 0u);
  EXPECT_EQ(LeafTable(tree).leafOf(tree, 0, { 0.5F, 0, 0 }), 0u);
  EXPECT_EQ(LeafTable(TriangleTree()).bytes(), 0u);
}

}
