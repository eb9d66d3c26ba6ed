// SPDX-License-Identifier: BSD-3-Clause
#include "Trees/DetailTrees.h"

#include "TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>

// Which triangles are details; that rays hit them is tested wherever "details in a hall" is cast
// to.

namespace irradiance
{
namespace
{

using test::Triangles;

/// Of 100 x 100 squares, with its corner there.
Triangles chip(double size, const Vector3& corner)
{
  return test::grid(100, 100,
    [&](int i, int j) { return Vector3(corner + Vector3(size * i / 100, size * j / 100, 0)); });
}

Triangles hall(double size)
{
  return test::boxOfCells({ 0, 0, 0 }, { size, size, size }, { 10, 10, 10 });
}

std::vector<std::size_t> sizesOf(const std::vector<std::vector<std::uint32_t>>& details)
{
  std::vector<std::size_t> sizes;
  for (const std::vector<std::uint32_t>& detail : details)
  {
    sizes.push_back(detail.size());
  }
  return sizes;
}

}

TEST(DetailTrees, AreOfTinyTrianglesAlone)
{
  Triangles mesh = hall(300);
  EXPECT_TRUE(detailsOf(TriangleMesh(mesh)).empty());
  EXPECT_TRUE(detailTreesOf(TriangleMesh(mesh)).empty());
  test::append(mesh, chip(1, { 3, 4, 1 })); // of 1 cm: floats of the hall are 2e-5 m apart
  EXPECT_TRUE(detailsOf(TriangleMesh(mesh)).empty());
  const std::size_t first = mesh.size();
  test::append(mesh, chip(0.01, { 3, 4, 1 }));
  const auto details = detailsOf(TriangleMesh(mesh));
  ASSERT_EQ(sizesOf(details), std::vector<std::size_t>{ 20000 });
  EXPECT_EQ(details[0].front(), first);
  EXPECT_EQ(details[0].back(), mesh.size() - 1);
  EXPECT_TRUE(detailsOf(TriangleMesh(chip(1e-9, { 1e-7, 0, 0 }))).empty())
    << "no part of anything larger";
}

TEST(DetailTrees, AreApartWhereTheirTrianglesAre)
{
  Triangles mesh = hall(300);
  test::append(mesh, chip(1e-2, { 3, 4, 1 }));
  test::append(mesh, chip(1e-2, { 3, 4.1, 1 })); // near enough
  test::append(mesh, chip(1e-2, { 200, 4, 1 })); // far
  test::append(mesh, chip(1e-6, { 3, 100, 1 })); // far and finer
  test::append(mesh, test::moved(test::icosphere(0), { 1e-5 * Matrix3::Identity(), { 9, 9, 9 } }));
  std::vector<std::size_t> sizes = sizesOf(detailsOf(TriangleMesh(mesh)));
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{ 20000, 20000, 40000 })) << "20 triangles are too few";
}

TEST(DetailTrees, AreTheLargestOfMany)
{
  Triangles mesh = hall(300);
  for (int i = 0; i < 20; ++i)
  {
    const double size = 1e-4 / (1 + i % 2); // half of them
    test::append(mesh, test::grid(6 + i % 2, 6, [&](int x, int y) {
      return Vector3(10 + 10 * i + size * x, 50 + size * y, 1);
    }));
  }
  const std::vector<std::size_t> sizes = sizesOf(detailsOf(TriangleMesh(mesh)));
  ASSERT_EQ(sizes.size(), 16u);
  EXPECT_EQ(std::count(sizes.begin(), sizes.end(), std::size_t{ 84 }), 10);
}

// Together they have each triangle once, by its number in the mesh.
TEST(DetailTrees, HaveEachTriangleOnce)
{
  Triangles mesh = chip(1e-3, { 3, 4, 0 }); // before, between and after
  test::append(mesh, hall(300));
  test::append(mesh, chip(1e-3, { 299, 4, 0 }));
  const std::vector<TriangleTree> trees = detailTreesOf(TriangleMesh(mesh));
  EXPECT_EQ(trees.size(), 3u);
  std::vector<int> found(mesh.size(), 0);
  for (const TriangleTree& tree : trees)
  {
    std::vector<bool> isIn(mesh.size(), false);
    for (std::size_t i = 0; i < tree.numberOfBlocks(); ++i)
    {
      for (unsigned lane = 0; lane < TriangleBlock::kSize; ++lane)
      {
        const std::uint32_t number = tree.blocks()[i].reference(lane);
        if (number != TriangleBlock::kNone)
        {
          isIn[number] = true;
        }
      }
    }
    for (std::size_t i = 0; i < mesh.size(); ++i)
    {
      found[i] += isIn[i] ? 1 : 0;
      // Walls, floor and chips lie in planes across axes.
      EXPECT_EQ(tree.planes().of(static_cast<std::uint32_t>(i)) != nullptr, isIn[i]) << i;
    }
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), 1), static_cast<std::ptrdiff_t>(mesh.size()));
}

}
