// SPDX-License-Identifier: BSD-3-Clause
// The triangles found near a box, compared with a search of all triangles.

#include "Trees/LeafQuery.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace irradiance
{

TEST(BoxQuery, MissesNone)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-2, 2), size(0, 0.3);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 3000; ++i)
  {
    const Vector3 a(place(random), place(random), place(random));
    triangles.push_back(
      { a, a + size(random) * Vector3::UnitX(), a + size(random) * Vector3(0, 1, 1) });
  }
  const TriangleTree tree = treeOf(triangles);
  std::size_t found = 0;
  for (int i = 0; i < 300; ++i)
  {
    const Vector3 corner(place(random), place(random), place(random));
    const Box box{ corner, corner + Vector3(size(random), size(random), size(random)) };
    const std::vector<std::uint32_t> near = trianglesNear(tree, box);
    EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
    EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
    for (std::uint32_t k = 0; k < triangles.size(); ++k)
    {
      if (!triangles[k].bounds().intersection(box).isEmpty())
      {
        // Bounds may touch where the triangle does not; one with a corner in the box surely does.
        const Vector3 closest = triangles[k].a.cwiseMax(box.lower).cwiseMin(box.upper);
        const bool isCornerWithin = closest == triangles[k].a;
        EXPECT_TRUE(!isCornerWithin || std::binary_search(near.begin(), near.end(), k));
      }
    }
    found += near.size();
  }
  EXPECT_LT(found, 300u * 300u); // and few others
}

TEST(BoxQuery, OfNothing)
{
  EXPECT_TRUE(trianglesNear(TriangleTree(), Box{ Vector3::Zero(), Vector3::Ones() }).empty());
  EXPECT_TRUE(
    trianglesNear(treeOf({ { Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY() } }), Box())
      .empty());
}

}
