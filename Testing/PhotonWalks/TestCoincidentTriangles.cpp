// SPDX-License-Identifier: BSD-3-Clause
// Triangles that coincide: found in trees as by trying all pairs.

#include "Surfaces/CoincidentTriangles.h"

#include "Kit.h"

namespace irradiance::test
{
namespace
{

Triangle triangleAt(double z)
{
  return { { 0, 0, z }, { 1, 0, z }, { 0, 1, z } };
}

/// Rectangles in few planes, some of which overlap, turned by no simple angle.
TriangleMesh makeSheets(std::mt19937_64& random, int count)
{
  const Matrix3 turn(
    Eigen::AngleAxisd(0.7, Vector3(0.3, -0.8, 0.5).normalized()).toRotationMatrix());
  std::uniform_real_distribution<double> place(-1, 1), side(0.05, 0.5);
  std::uniform_int_distribution<int> plane(0, 3);
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i)
  {
    const double x = place(random), y = place(random), z = 0.25 * plane(random);
    const double u = side(random), v = side(random);
    const Vector3 a = turn * Vector3(x, y, z), b = turn * Vector3(x + u, y, z),
                  c = turn * Vector3(x + u, y + v, z), d = turn * Vector3(x, y + v, z);
    triangles.push_back({ a, b, c });
    triangles.push_back({ a, c, d });
  }
  return TriangleMesh(triangles);
}

// The tolerance is 2^-32 of the largest coordinate, here 1.
TEST(CoincidentTriangles, LieInOnePlane)
{
  const FlatTriangle flat(triangleAt(0));
  EXPECT_TRUE(flat.coincidesWith(triangleAt(0)));
  EXPECT_TRUE(flat.coincidesWith(triangleAt(0x1p-33)));
  EXPECT_FALSE(flat.coincidesWith(triangleAt(0x1p-31)));
  EXPECT_FALSE(flat.coincidesWith({ { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } })) << "a neighbour";
  EXPECT_FALSE(flat.coincidesWith({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0.5 } })) << "a common edge";
  EXPECT_TRUE(flat.coincidesWith({ { 0.1, 0.1, 0 }, { 0.1, 0.2, 0 }, { 0.2, 0.1, 0 } }));
}

TEST(CoincidentTriangles, WithinABodyAreThoseOfAllPairs)
{
  std::mt19937_64 random(3);
  const RigidObject body(makeSheets(random, 150)), other(makeSheets(random, 20));
  Execution execution;
  const auto found = coincidentWithin({ &body, &other }, execution);
  ASSERT_EQ(found.size(), 2u);
  for (const auto& [mesh, pairs] :
    { std::pair(&body.mesh(), found[0]), std::pair(&other.mesh(), found[1]) })
  {
    std::vector<TrianglePair> expected;
    for (std::uint32_t i = 0; i < mesh->size(); ++i)
    {
      for (std::uint32_t k = i + 1; k < mesh->size(); ++k)
      {
        if (FlatTriangle((*mesh)[i]).coincidesWith((*mesh)[k]))
        {
          expected.emplace_back(i, k);
        }
      }
    }
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(pairs, expected);
  }
}

TEST(CoincidentTriangles, OfTwoObjectsAreThoseOfAllPairs)
{
  std::mt19937_64 random(4);
  SceneObject few, many;
  few.body = std::make_shared<RigidObject>(makeSheets(random, 10));
  many.body = std::make_shared<RigidObject>(makeSheets(random, 100));
  many.worldFromObject = { 2 * Matrix3::Identity(), Vector3(0.25, -0.5, 0) };
  few.worldFromObject = { Matrix3::Identity(), Vector3(0.25, -0.5, 0) };
  std::vector<TrianglePair> expected;
  const auto triangleOf = [](const SceneObject& object, std::uint32_t i) {
    return transformed(object.worldFromObject, object.body->mesh()[i]);
  };
  for (std::uint32_t i = 0; i < few.body->mesh().size(); ++i)
  {
    for (std::uint32_t k = 0; k < many.body->mesh().size(); ++k)
    {
      if (FlatTriangle(triangleOf(few, i)).coincidesWith(triangleOf(many, k)))
      {
        expected.emplace_back(i, k);
      }
    }
  }
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(coincidentBetween(few, many, {}), expected);
  for (TrianglePair& pair : expected)
  {
    std::swap(pair.first, pair.second);
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(coincidentBetween(many, few, {}), expected);
}

}
}
