// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/PolygonClip.h"

#include "RandomVectors.h"

#include <gtest/gtest.h>

// The bounds of the part of a triangle in a box contain that part and no more.

namespace irradiance
{
namespace
{

using test::RandomVectors;

void expectEqual(const Box& box, const Vector3& lower, const Vector3& upper)
{
  EXPECT_EQ(box.lower, lower);
  EXPECT_EQ(box.upper, upper);
}

const Triangle kHalfSquare{ { 0, 0, 1 }, { 4, 0, 1 }, { 0, 4, 1 } }; // x + y <= 4

TEST(PolygonClip, KeepsATriangleInside)
{
  expectEqual(
    boundsOfClipped(kHalfSquare, { { -1, -1, -1 }, { 5, 5, 5 } }), { 0, 0, 1 }, { 4, 4, 1 });
}

TEST(PolygonClip, CutsByEachPlane)
{
  expectEqual(boundsOfClipped(kHalfSquare, { { 1, 2, 0 }, { 9, 9, 9 } }), { 1, 2, 1 }, { 2, 3, 1 });
  expectEqual(
    boundsOfClipped(kHalfSquare, { { -9, 3, 0 }, { 0.5, 9, 9 } }), { 0, 3, 1 }, { 0.5, 4, 1 });
  EXPECT_TRUE(boundsOfClipped(kHalfSquare, { { 3, 3, 0 }, { 9, 9, 9 } }).isEmpty());
  EXPECT_TRUE(boundsOfClipped(kHalfSquare, { { 0, 0, 2 }, { 9, 9, 9 } }).isEmpty());
  EXPECT_TRUE(boundsOfClipped(kHalfSquare, { { 0, 0, -2 }, { 9, 9, 0.5 } }).isEmpty());
}

TEST(PolygonClip, CountsWhatLiesInAFaceOfTheBox)
{
  expectEqual(boundsOfClipped(kHalfSquare, { { 1, 1, 1 }, { 9, 9, 9 } }), { 1, 1, 1 }, { 3, 3, 1 });
  expectEqual(
    boundsOfClipped(kHalfSquare, { { 0, 0, -9 }, { 1, 1, 1 } }), { 0, 0, 1 }, { 1, 1, 1 });
  // A box without thickness, in the plane of the triangle.
  expectEqual(boundsOfClipped(kHalfSquare, { { 0, 0, 1 }, { 1, 1, 1 } }), { 0, 0, 1 }, { 1, 1, 1 });
}

TEST(PolygonClip, CountsATouchInAPoint)
{
  expectEqual(boundsOfClipped(kHalfSquare, { { 2, 2, 0 }, { 9, 9, 9 } }), { 2, 2, 1 }, { 2, 2, 1 });
  expectEqual(boundsOfClipped(kHalfSquare, { { 4, 0, 1 }, { 9, 9, 9 } }), { 4, 0, 1 }, { 4, 0, 1 });
}

TEST(PolygonClip, TakesTrianglesWithoutArea)
{
  const Vector3 p(0.5, 0.25, 0.75);
  const Box box{ { 0, 0, 0 }, { 1, 1, 1 } };
  expectEqual(boundsOfClipped({ p, p, p }, box), p, p);
  expectEqual(boundsOfClipped({ { -1, 0.5, 0.5 }, { 3, 0.5, 0.5 }, { 1, 0.5, 0.5 } }, box),
    { 0, 0.5, 0.5 }, { 1, 0.5, 0.5 });
}

/// Adds the part of a segment in a box, by the slab method: an independent way to the same bounds.
void addClippedSegment(const Vector3& p, const Vector3& q, const Box& box, Box& bounds)
{
  double from = 0, to = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double d = q[axis] - p[axis];
    double s = (box.lower[axis] - p[axis]) / d, t = (box.upper[axis] - p[axis]) / d;
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  if (from <= to)
  {
    bounds.add(p + from * (q - p));
    bounds.add(p + to * (q - p));
  }
}

/// The corners of the part are ends of clipped triangle edges, and points where box edges cross it.
Box boundsByCorners(const Triangle& triangle, const Box& box)
{
  Box bounds;
  addClippedSegment(triangle.a, triangle.b, box, bounds);
  addClippedSegment(triangle.b, triangle.c, box, bounds);
  addClippedSegment(triangle.c, triangle.a, box, bounds);
  const Vector3 n = triangle.areaVector();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < 4; ++k)
    {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      Vector3 x;
      x[u] = k & 1 ? box.upper[u] : box.lower[u];
      x[v] = k & 2 ? box.upper[v] : box.lower[v];
      x[axis] = triangle.a[axis] -
        (n[u] * (x[u] - triangle.a[u]) + n[v] * (x[v] - triangle.a[v])) / n[axis];
      const bool isInTriangle = n.dot((triangle.b - triangle.a).cross(x - triangle.a)) >= 0 &&
        n.dot((triangle.c - triangle.b).cross(x - triangle.b)) >= 0 &&
        n.dot((triangle.a - triangle.c).cross(x - triangle.c)) >= 0;
      if (isInTriangle && x[axis] >= box.lower[axis] && x[axis] <= box.upper[axis])
      {
        bounds.add(x);
      }
    }
  }
  return bounds;
}

TEST(PolygonClip, AgreesWithTheCornersOfThePart)
{
  constexpr unsigned kSeed = 1;
  RandomVectors random(kSeed);
  int parts = 0;
  for (int i = 0; i < 100000; ++i)
  {
    const Vector3 offset = i % 2 == 0 ? Vector3(0, 0, 0) : Vector3(1e3, -2e3, 5e2);
    const Triangle triangle{ offset + 2 * random.inCube(), offset + 2 * random.inCube(),
      offset + 2 * random.inCube() };
    Box box;
    box.add(offset + random.inCube());
    box.add(offset + random.inCube());
    const Box expected = boundsByCorners(triangle, box);
    const Box found = boundsOfClipped(triangle, box);
    if (expected.isEmpty() || found.isEmpty())
    {
      // Through rounding, one of the two may miss a touch in a single point that the other finds.
      const Box& touch = expected.isEmpty() ? found : expected;
      EXPECT_TRUE(touch.isEmpty() || touch.extent().maxCoeff() < 1e-9 * touch.magnitude()) << i;
      continue;
    }
    ++parts;
    const double tolerance = 1e-9 * std::max(1.0, box.magnitude());
    EXPECT_LT((found.lower - expected.lower).cwiseAbs().maxCoeff(), tolerance)
      << "seed " << kSeed << " triangle " << i;
    EXPECT_LT((found.upper - expected.upper).cwiseAbs().maxCoeff(), tolerance)
      << "seed " << kSeed << " triangle " << i;
  }
  EXPECT_GT(parts, 20000);
}

TEST(PolygonClip, ContainsEveryPointOfThePart)
{
  constexpr unsigned kSeed = 2;
  RandomVectors random(kSeed);
  int inside = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const double size = random.powerOfTwo(-20, 2);
    const Vector3 a = random.inCube();
    const Triangle triangle{ a, a + size * random.inCube(), a + size * random.inCube() };
    Box box;
    box.add(a + 0.5 * size * random.inCube());
    box.add(a + 0.5 * size * random.inCube());
    Box bounds = boundsOfClipped(triangle, box);
    bounds.inflate(0x1p-48 * (1 + size)); // a few ulps
    for (int k = 0; k < 50; ++k)
    {
      const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
      const Vector3 p = a + s * (triangle.b - a) + t * (triangle.c - a);
      if ((p.array() >= box.lower.array() && p.array() <= box.upper.array()).all())
      {
        ++inside;
        EXPECT_TRUE((p.array() >= bounds.lower.array() && p.array() <= bounds.upper.array()).all())
          << "seed " << kSeed << " triangle " << i << " point " << p.transpose();
      }
    }
  }
  EXPECT_GT(inside, 5000);
}

}
}
