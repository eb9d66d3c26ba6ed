// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TriangleInSphere.h"
#include "RandomVectors.h"

#include <gtest/gtest.h>

namespace irradiance
{

// A point of a convex set is the closest one if nothing of the set lies beyond the plane through it
// that faces the origin (the projection theorem). Slivers, triangles without area and all scales
// included.
TEST(ClosestPoint, NothingOfTheTriangleIsCloser)
{
  test::RandomVectors random(4);
  int inside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const double scale = i % 3 == 0 ? random.powerOfTwo(-60, 60) : 1;
    const Vector3 at = random.uniform(0, 2) * random.inCube();
    Triangle triangle{ at + random.inCube(), at + random.inCube(), at + random.inCube() };
    if (i % 5 == 0)
    {
      triangle.c = triangle.a + random.uniform(0, 1) * (triangle.b - triangle.a); // no area
    }
    triangle = { scale * triangle.a, scale * triangle.b, scale * triangle.c };
    const Vector3 closest = closestPoint(triangle) / scale;
    const Vector3 a = triangle.a / scale, b = triangle.b / scale, c = triangle.c / scale;
    for (const Vector3& corner : { a, b, c })
    {
      ASSERT_LE((corner - closest).dot(-closest), 1e-12) << i;
    }
    const double parts = Triangle{ closest, a, b }.area() + Triangle{ closest, b, c }.area() +
      Triangle{ closest, c, a }.area();
    ASSERT_NEAR(parts, (Triangle{ a, b, c }.area()), 1e-7) << i << ": it is on the triangle";
    inside += Triangle{ closest, a, b }.area() > 1e-6 && Triangle{ closest, b, c }.area() > 1e-6 &&
        Triangle{ closest, c, a }.area() > 1e-6
      ? 1
      : 0;
  }
  EXPECT_GT(inside, 500);
}

TEST(ClosestPoint, OfATriangleAroundTheOrigin)
{
  EXPECT_LT(closestPoint({ { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } }).norm(), 1e-15);
  EXPECT_EQ(closestPoint({ { 1, 0, 2 }, { -1, 1, 2 }, { -1, -1, 2 } }), Vector3(0, 0, 2));
}

}
