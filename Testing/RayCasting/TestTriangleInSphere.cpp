// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TriangleInSphere.h"
#include "RandomVectors.h"

#include <gtest/gtest.h>

#include <array>

// The area of triangles in spheres, compared with closed forms and with cutting into pieces.

namespace irradiance
{

namespace
{

using test::RandomVectors;

struct Turned
{
  Matrix3 rotation;
  Vector3 shift;

  Triangle operator()(const Triangle& t) const { return transformed({ rotation, shift }, t); }
};

/// Bounds of the area by cutting in four until a piece is wholly inside or outside.
std::array<double, 2> areaByCutting(const Triangle& t, double radius, int levels)
{
  const double area = t.area();
  const double farthest = std::max({ t.a.squaredNorm(), t.b.squaredNorm(), t.c.squaredNorm() });
  if (farthest <= radius * radius)
  {
    return { area, area };
  }
  const Vector3 center = (t.a + t.b + t.c) / 3;
  const double size =
    std::max({ (t.a - center).norm(), (t.b - center).norm(), (t.c - center).norm() });
  if (center.norm() - size > radius)
  {
    return { 0, 0 };
  }
  if (levels == 0)
  {
    return { 0, area };
  }
  const Vector3 ab = 0.5 * (t.a + t.b), bc = 0.5 * (t.b + t.c), ca = 0.5 * (t.c + t.a);
  std::array<double, 2> sum{};
  for (const Triangle& piece :
    { Triangle{ t.a, ab, ca }, { ab, t.b, bc }, { ca, bc, t.c }, { bc, ca, ab } })
  {
    const auto [least, most] = areaByCutting(piece, radius, levels - 1);
    sum[0] += least;
    sum[1] += most;
  }
  return sum;
}

/// Checks the area in all rotations of the corners, and turned over.
void expectArea(const Triangle& t, double radius, double expected, double tolerance)
{
  for (const Triangle& same :
    { t, Triangle{ t.b, t.c, t.a }, { t.c, t.a, t.b }, { t.a, t.c, t.b } })
  {
    EXPECT_NEAR(areaInSphere(same, radius), expected, tolerance) << "radius " << radius;
  }
}

}

TEST(TriangleInSphere, ClosedForms)
{
  RandomVectors random(1);
  for (int i = 0; i < 20; ++i)
  {
    const Matrix3 turn = random.rotation();
    const auto at = [&](double x, double y, double z) { return Vector3(turn * Vector3(x, y, z)); };
    const double height = random.uniform(0, 0.9), disc = M_PI * (1 - height * height);
    // The whole disc, its half, its quarter, and a sixth of it.
    expectArea({ at(-9, -9, height), at(9, -9, height), at(0, 9, height) }, 1, disc, 1e-13);
    expectArea({ at(-9, 0, height), at(9, 0, height), at(0, 9, height) }, 1, disc / 2, 1e-13);
    expectArea({ at(0, 0, height), at(9, 0, height), at(0, 9, height) }, 1, disc / 4, 1e-13);
    expectArea({ at(0, 0, height), at(9, 0, height), at(4.5, 4.5 * std::sqrt(3), height) }, 1,
      disc / 6, 1e-13);
    // A segment of the disc: the plane through the centre is cut at a distance.
    const double cut = random.uniform(0, 1);
    const double segment = std::acos(cut) - cut * std::sqrt(1 - cut * cut);
    expectArea({ at(cut, -9, 0), at(9, 0, 0), at(cut, 9, 0) }, 1, segment, 1e-13);
    // Beyond, and just before.
    expectArea({ at(-9, -9, 1), at(9, -9, 1), at(0, 9, 1) }, 1, 0, 1e-14);
    expectArea({ at(1, -9, 0), at(9, 0, 0), at(1, 9, 0) }, 1, 0, 1e-14);
  }
}

TEST(TriangleInSphere, WholeTriangles)
{
  RandomVectors random(2);
  for (int i = 0; i < 1000; ++i)
  {
    const Triangle t{ random.inCube(), random.inCube(), random.inCube() };
    EXPECT_DOUBLE_EQ(areaInSphere(t, kInfinity), t.area());
    EXPECT_DOUBLE_EQ(areaInSphere(t, 1.75), t.area());
    EXPECT_EQ(areaInSphere(t, 0), 0);
  }
  const Triangle needle{ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } };
  EXPECT_EQ(areaInSphere(needle, 1), 0);
  EXPECT_EQ(areaInSphere({ needle.a, needle.a, needle.a }, 1), 0);
}

TEST(TriangleInSphere, EqualsCuttingIntoPieces)
{
  RandomVectors random(3);
  for (int i = 0; i < 300; ++i)
  {
    const Triangle t{ random.inCube(), random.inCube(), random.inCube() };
    const double radius = random.uniform(0.1, 1.6);
    const auto [least, most] = areaByCutting(t, radius, 9);
    const double area = areaInSphere(t, radius);
    EXPECT_GE(area, least - 1e-12) << "trial " << i;
    EXPECT_LE(area, most + 1e-12) << "trial " << i;
    EXPECT_LT(most - least, 0.02);
  }
}

// Pieces of a triangle have the area of the whole, also where corners and edges touch the sphere or
// its centre.
TEST(TriangleInSphere, PiecesAddUp)
{
  RandomVectors random(4);
  for (int i = 0; i < 3000; ++i)
  {
    const Triangle t{ random.inCube(), random.inCube(), random.inCube() };
    const double b = random.engine() % 4 == 0 ? 0 : random.uniform(0, 0.5);
    const Vector3 p = t.a + b * (t.b - t.a) + random.uniform(0, 0.5) * (t.c - t.a);
    const double radius = i % 3 == 0 ? p.norm() : i % 3 == 1 ? t.a.norm() : random.uniform(0, 1);
    const Vector3 center = i % 2 == 0 ? p : Vector3::Zero();
    const auto area = [&](const Vector3& x, const Vector3& y, const Vector3& z) {
      return areaInSphere({ x - center, y - center, z - center }, radius);
    };
    EXPECT_NEAR(
      area(t.a, t.b, p) + area(t.b, t.c, p) + area(t.c, t.a, p), area(t.a, t.b, t.c), 1e-12)
      << "trial " << i;
  }
}

TEST(TriangleInSphere, ScalesWithTheSquareOfLengths)
{
  RandomVectors random(5);
  for (int i = 0; i < 200; ++i)
  {
    const Triangle t{ random.inCube(), random.inCube(), random.inCube() };
    const double radius = random.uniform(0.1, 1.6), area = areaInSphere(t, radius);
    for (const double scale : { 0x1p-100, 0x1p100 })
    {
      EXPECT_EQ(areaInSphere({ scale * t.a, scale * t.b, scale * t.c }, scale * radius),
        scale * scale * area);
    }
  }
}

}
