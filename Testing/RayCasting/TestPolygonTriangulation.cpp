// SPDX-License-Identifier: BSD-3-Clause
// Polygons that are concave, touch or cross themselves, or have no area. All areas are by formula.

#include "Meshes/PolygonTriangulation.h"
#include "RandomVectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace irradiance::test
{
namespace
{

using Corners = std::vector<Vector3>;

struct Cut
{
  std::vector<Triangle> triangles;
  bool isSimple;

  explicit Cut(const Corners& corners) { isSimple = triangulate(corners, triangles); }

  double area() const
  {
    double sum = 0;
    for (const Triangle& triangle : triangles)
    {
      sum += 0.5 * triangle.areaVector().norm();
    }
    return sum;
  }
  Vector3 areaVector() const
  {
    Vector3 sum = Vector3::Zero();
    for (const Triangle& triangle : triangles)
    {
      sum += 0.5 * triangle.areaVector();
    }
    return sum;
  }
};

Vector3 areaVector(const Corners& corners)
{
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector3 next = corners[(i + 1) % corners.size()];
    sum += 0.5 * (corners[i] - corners[0]).cross(next - corners[0]);
  }
  return sum;
}

/// In the plane z = 0.
Corners flat(const std::vector<std::pair<double, double>>& points)
{
  Corners corners;
  for (const auto& [x, y] : points)
  {
    corners.emplace_back(x, y, 0);
  }
  return corners;
}

/// `count` corners at 1 and `inner` in turn, going round `turns` times.
Corners star(int count, double inner, int turns = 1)
{
  Corners corners;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2 * kPi * turns * i / count, radius = i % 2 == 0 ? 1.0 : inner;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return corners;
}

Corners comb(int teeth)
{
  Corners corners;
  for (int i = 0; i < teeth; ++i)
  {
    corners.insert(corners.end(),
      { { 2.0 * i, 1, 0 }, { 2.0 * i, 0, 0 }, { 2.0 * i + 1, 0, 0 }, { 2.0 * i + 1, 1, 0 } });
  }
  corners.insert(corners.end(), { { 2.0 * teeth - 1, 2, 0 }, { 0, 2, 0 } });
  return corners;
}

struct NamedPolygon
{
  std::string name;
  Corners corners;
  double area;
};

Corners squareWithHole()
{
  return flat({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 }, { 3, 3 },
    { 3, 1 }, { 1, 1 } });
}

/// None of them crosses itself.
std::vector<NamedPolygon> simplePolygons()
{
  return {
    { "square with a hole", squareWithHole(), 12 },
    { "two holes",
      flat({ { 0, 0 }, { 9, 0 }, { 9, 4 }, { 0, 4 }, { 0, 2 }, { 1, 2 }, { 2, 3 }, { 3, 2 },
        { 5, 2 }, { 5, 3 }, { 8, 3 }, { 8, 1 }, { 5, 1 }, { 5, 2 }, { 3, 2 }, { 2, 1 }, { 1, 2 },
        { 0, 2 } }),
      36 - 2 - 6 },
    { "hole that touches the rim",
      flat({ { 0, 0 }, { 2, 0 }, { 1, 1 }, { 2, 2 }, { 3, 1 }, { 2, 0 }, { 4, 0 }, { 4, 4 },
        { 0, 4 } }),
      14 },
    { "lobes that share a corner",
      flat({ { 0, 0 }, { 2, 0 }, { 1, 1 }, { 2, 2 }, { 0, 2 }, { 1, 1 } }), 2 },
    { "L with a spike",
      flat({ { 0, 0 }, { 2, 0 }, { 5, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }), 3 },
    { "spike past corners",
      flat({ { 0, 0 }, { 1, 0 }, { 4, 0 }, { 3, 0 }, { 5, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 },
        { 1, 2 }, { 0, 2 } }),
      3 },
    { "spike inside", flat({ { 0, 0 }, { 2, 0 }, { 1, 1 }, { 2, 0 }, { 2, 2 }, { 0, 2 } }), 4 },
    { "repeated corners",
      flat({ { 0, 0 }, { 0, 0 }, { 2, 0 }, { 2, 2 }, { 2, 2 }, { 2, 2 }, { 0, 2 }, { 0, 0 } }), 4 },
    { "corners along edges",
      flat({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 2, 2 }, { 0, 2 }, { 0, 1 } }), 4 },
    { "comb", comb(20), 20 + 39 },
    { "star", star(10, 0.25), 10 * 0.25 * std::sin(kPi / 5) / 2 },
    { "17-gon", star(17, 1), 17 * std::sin(2 * kPi / 17) / 2 },
    { "arrowhead", flat({ { 0, 1 }, { -2, 2 }, { 0, -2 }, { 2, 2 } }), 6 },
    { "arrowhead, from its tip", flat({ { -2, 2 }, { 0, -2 }, { 2, 2 }, { 0, 1 } }), 6 },
    { "quad with a corner on an edge", flat({ { 0, 0 }, { 4, 0 }, { 4, 2 }, { 2, 0 } }), 2 },
    { "quad with a spike", flat({ { 0, 0 }, { 3, 0 }, { 1, 0 }, { 0, 2 } }), 1 },
  };
}

/// Rotates and shifts, so that what touched still touches up to rounding.
Corners moved(const Corners& corners, RandomVectors& random)
{
  const Matrix3 rotation = random.rotation();
  const Vector3 shift = 5 * random.inCube();
  Corners result;
  for (const Vector3& corner : corners)
  {
    result.push_back(rotation * corner + shift);
  }
  return result;
}

void expectArea(const Corners& corners, double area, double tolerance = 1e-12)
{
  const Cut cut(corners);
  EXPECT_TRUE(cut.isSimple);
  EXPECT_NEAR(cut.area(), area, tolerance * area);
  const Vector3 front = areaVector(corners);
  EXPECT_LE((cut.areaVector() - front).norm(), tolerance * area);
  for (const Triangle& triangle : cut.triangles)
  {
    EXPECT_GE(triangle.areaVector().dot(front), -tolerance * area * area);
  }
}

bool hasOnlyCornersOf(const Corners& corners, const std::vector<Triangle>& triangles)
{
  const auto isOld = [&](const Vector3& corner) {
    return std::find(corners.begin(), corners.end(), corner) != corners.end();
  };
  return std::all_of(triangles.begin(), triangles.end(),
    [&](const Triangle& t) { return isOld(t.a) && isOld(t.b) && isOld(t.c); });
}

/// Counts the edges that cross the ray to the right of (x, y).
int windingNumber(const Corners& corners, double x, double y)
{
  int winding = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    if ((a.y() <= y) != (b.y() <= y) && a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > x)
    {
      winding += b.y() > a.y() ? 1 : -1;
    }
  }
  return winding;
}

/// Expects every point that the polygon goes around in one triangle, and any other in none.
void expectCovered(const Corners& corners, RandomVectors& random)
{
  const Cut cut(corners);
  for (int i = 0; i < 300; ++i)
  {
    const double x = random.uniform(-1.5, 9.5), y = random.uniform(-2.5, 4.5);
    const auto contains = [&](const Triangle& t) {
      return windingNumber({ t.a, t.b, t.c }, x, y) != 0;
    };
    const auto found = std::count_if(cut.triangles.begin(), cut.triangles.end(), contains);
    ASSERT_EQ(found, windingNumber(corners, x, y) != 0 ? 1 : 0) << x << " " << y;
  }
}

Corners onGrid(int count, RandomVectors& random)
{
  Corners corners;
  for (int i = 0; i < count; ++i)
  {
    const double x = std::floor(random.uniform(0, 5));
    corners.emplace_back(x, std::floor(random.uniform(-1, 4)), 0);
  }
  return corners;
}

}

TEST(PolygonTriangulation, AreaAndOrientation)
{
  RandomVectors random(1);
  for (NamedPolygon polygon : simplePolygons())
  {
    SCOPED_TRACE(polygon.name);
    expectArea(polygon.corners, polygon.area);
    EXPECT_TRUE(hasOnlyCornersOf(polygon.corners, Cut(polygon.corners).triangles));
    for (int i = 0; i < 20; ++i)
    {
      // Starts at any corner, in either direction, in any position.
      std::rotate(polygon.corners.begin(), polygon.corners.begin() + 1, polygon.corners.end());
      expectArea(moved(polygon.corners, random), polygon.area);
      std::reverse(polygon.corners.begin(), polygon.corners.end());
      expectArea(moved(polygon.corners, random), polygon.area);
    }
  }
}

TEST(PolygonTriangulation, TouchesAsFarAsFloatsTell)
{
  RandomVectors random(2);
  for (const NamedPolygon& polygon : simplePolygons())
  {
    SCOPED_TRACE(polygon.name);
    for (int i = 0; i < 20; ++i)
    {
      Corners corners = moved(polygon.corners, random);
      for (Vector3& corner : corners)
      {
        corner = corner.cast<float>().cast<double>();
      }
      expectArea(corners, polygon.area, 4e-6);
    }
  }
}

TEST(PolygonTriangulation, CoversWhatThePolygonGoesAround)
{
  RandomVectors random(3);
  for (const NamedPolygon& polygon : simplePolygons())
  {
    SCOPED_TRACE(polygon.name);
    expectCovered(polygon.corners, random);
  }
  for (int i = 0; i < 200; ++i)
  {
    SCOPED_TRACE("on the grid " + std::to_string(i));
    expectCovered(onGrid(4 + i % 17, random), random);
  }
}

TEST(PolygonTriangulation, CrossingItself)
{
  const double waist = std::cos(2 * kPi / 5) / std::cos(kPi / 5); // of a pentagram
  const std::vector<NamedPolygon> polygons = {
    { "bow-tie", flat({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }), 0.5 },
    { "uneven bow-tie", flat({ { 0, 0 }, { 0, 3 }, { 4, 0 }, { 4, 1 } }), 4.5 + 0.5 },
    { "pentagram", star(5, 1, 2), 5 * waist * std::sin(kPi / 5) },
    { "square twice",
      flat({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }), 1 },
  };
  RandomVectors random(4);
  for (const NamedPolygon& polygon : polygons)
  {
    SCOPED_TRACE(polygon.name);
    for (int i = 0; i < 20; ++i)
    {
      const Corners corners = i == 0 ? polygon.corners : moved(polygon.corners, random);
      const Cut cut(corners);
      EXPECT_FALSE(cut.isSimple);
      EXPECT_NEAR(cut.area(), polygon.area, 1e-12);
      EXPECT_NEAR(cut.areaVector().norm(), polygon.area, 1e-12); // all oriented alike
      EXPECT_GE(cut.areaVector().dot(areaVector(corners)), -1e-12);
    }
  }
}

TEST(PolygonTriangulation, CrossingItselfTooOftenIsAFan)
{
  const Cut cut(star(301, 1, 150));
  EXPECT_FALSE(cut.isSimple);
  EXPECT_EQ(cut.triangles.size(), 299u);
}

// This includes the points where the edges of a polygon cross.
TEST(PolygonTriangulation, ScalingByAPowerOfTwoScalesTheTriangles)
{
  std::vector<NamedPolygon> polygons = simplePolygons();
  polygons.push_back({ "pentagram", star(5, 1, 2), 0 });
  polygons.push_back({ "wild", star(22, 0.3, 5), 0 });
  RandomVectors random(5);
  for (const NamedPolygon& polygon : polygons)
  {
    SCOPED_TRACE(polygon.name);
    const Corners corners = moved(polygon.corners, random);
    const Cut cut(corners);
    for (const double scale : { 0x1p-94, 0x1p-1, 0x1p13, 0x1p96 })
    {
      Corners scaled = corners;
      std::for_each(scaled.begin(), scaled.end(), [&](Vector3& corner) { corner *= scale; });
      const Cut other(scaled);
      ASSERT_EQ(other.triangles.size(), cut.triangles.size());
      for (std::size_t i = 0; i < cut.triangles.size(); ++i)
      {
        const Triangle& t = cut.triangles[i];
        EXPECT_EQ(other.triangles[i], (Triangle{ t.a * scale, t.b * scale, t.c * scale }));
      }
    }
  }
}

// A polygon that is star-shaped as seen from its front, at any heights of its corners.
TEST(PolygonTriangulation, CornersOutOfThePlane)
{
  RandomVectors random(6);
  for (int i = 0; i < 200; ++i)
  {
    SCOPED_TRACE(i);
    Corners corners = star(12, 0.4);
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      corners[k].z() =
        (k / 2 % 2 == 0 ? 1.0 : -1.0) * (i < 100 ? 1e-3 : 0.3) + 1e-4 * random.uniform();
    }
    corners = moved(corners, random);
    const Cut cut(corners);
    EXPECT_TRUE(cut.isSimple);
    EXPECT_EQ(cut.triangles.size(), corners.size() - 2);
    // All surfaces that end at the same edges have the same area vector.
    EXPECT_LE((cut.areaVector() - areaVector(corners)).norm(), 1e-14);
    EXPECT_TRUE(hasOnlyCornersOf(corners, cut.triangles));
  }
}

TEST(PolygonTriangulation, QuadsAreCutAlongTheFirstDiagonalThatLiesInside)
{
  RandomVectors random(7);
  int bent = 0;
  for (int i = 0; i < 1000; ++i)
  {
    const Corners p = { random.inCube(), random.inCube(), random.inCube(), random.inCube() };
    const Triangle a{ p[0], p[1], p[2] }, b{ p[0], p[2], p[3] };
    const Triangle c{ p[0], p[1], p[3] }, d{ p[1], p[2], p[3] };
    const Cut cut(p);
    if (a.areaVector().dot(b.areaVector()) >= 0)
    {
      EXPECT_EQ(cut.triangles, (std::vector<Triangle>{ a, b }));
    }
    else if (c.areaVector().dot(d.areaVector()) >= 0)
    {
      EXPECT_EQ(cut.triangles, (std::vector<Triangle>{ c, d }));
    }
    else
    {
      // A quad bent by more than an eighth of its width does not cross itself.
      const double volume = std::abs(a.areaVector().dot(p[3] - p[0]));
      const double width = std::max((p[2] - p[0]).norm(), (p[3] - p[1]).norm());
      if (volume > 0.25 * width * width * width)
      {
        ++bent;
        EXPECT_TRUE(cut.isSimple);
        EXPECT_EQ(cut.triangles, (std::vector<Triangle>{ a, b }));
      }
    }
  }
  EXPECT_GT(bent, 5);
}

// Its area vector belongs to the bend, and lies in the plane of the wings.
TEST(PolygonTriangulation, BentBowTie)
{
  const Cut cut({ { 0, 0, 0 }, { 1, 1, 0.01 }, { 1, 0, 0 }, { 0, 1, 0 } });
  EXPECT_FALSE(cut.isSimple);
  EXPECT_NEAR(cut.area(), 0.5, 1e-3);
  EXPECT_NEAR(std::abs(cut.areaVector().z()), 0.5, 1e-3);
}

TEST(PolygonTriangulation, FewCorners)
{
  EXPECT_TRUE(Cut({}).triangles.empty());
  EXPECT_TRUE(Cut({ { 1, 2, 3 } }).triangles.empty());
  EXPECT_TRUE(Cut({ { 1, 2, 3 }, { 4, 5, 6 } }).triangles.empty());
  const Corners c = { { 1, 2, 3 }, { 4, 5, 7 }, { 0, 1, 0 } };
  EXPECT_EQ(Cut(c).triangles, (std::vector<Triangle>{ { c[0], c[1], c[2] } }));
}

TEST(PolygonTriangulation, WithoutArea)
{
  RandomVectors random(8);
  const std::vector<NamedPolygon> polygons = {
    { "point", Corners(7, Vector3(1, 2, 3)), 0 },
    { "origin", Corners(7, Vector3::Zero()), 0 },
    { "two points", flat({ { 0, 0 }, { 1, 0 }, { 0, 0 }, { 1, 0 }, { 0, 0 } }), 0 },
    { "line", flat({ { 0, 0 }, { 3, 1 }, { 6, 2 }, { 9, 3 }, { -3, -1 } }), 0 },
    { "there and back", flat({ { 0, 0 }, { 3, 1 }, { 4, 5 }, { 3, 1 }, { 2, 2 }, { 3, 1 } }), 0 },
    { "quad there and back", flat({ { 0, 0 }, { 3, 1 }, { 4, 5 }, { 3, 1 } }), 0 },
  };
  for (const NamedPolygon& polygon : polygons)
  {
    SCOPED_TRACE(polygon.name);
    for (int i = 0; i < 20; ++i)
    {
      const Cut cut(i == 0 ? polygon.corners : moved(polygon.corners, random));
      EXPECT_TRUE(cut.isSimple);
      EXPECT_LE(cut.area(), i == 0 ? 0 : 1e-13);
      EXPECT_TRUE(cut.triangles.empty() || polygon.corners.size() == 4);
    }
  }
}

TEST(PolygonTriangulation, AnyCoordinates)
{
  RandomVectors random(9);
  for (int i = 0; i < 600; ++i)
  {
    const double exponent = i % 3 == 0 ? 1 : 100;
    Corners corners;
    for (int k = 0; k < 4 + i % 9; ++k)
    {
      const Vector3 corner = random.inCube() * random.powerOfTwo(-exponent, exponent - 1);
      corners.push_back(
        i % 2 == 0 || k == 0 ? corner : Vector3(corner.x(), corners[0].y(), corner.z()));
    }
    if (i % 7 == 0)
    {
      corners[1] = { 0x1p-1060, 1e30, -0x1p-1074 };
    }
    for (const Triangle& triangle : Cut(corners).triangles)
    {
      ASSERT_TRUE(triangle.areaVector().allFinite()) << i;
    }
  }
}

TEST(PolygonTriangulation, TenThousandCorners)
{
  RandomVectors random(10);
  const int count = 10000;
  const Corners corners = moved(star(count, 0.5), random);
  const Cut cut(corners);
  EXPECT_TRUE(cut.isSimple);
  EXPECT_EQ(cut.triangles.size(), corners.size() - 2);
  EXPECT_NEAR(cut.area(), count * 0.5 * std::sin(2 * kPi / count) / 2, 1e-11);
  const Cut convex(star(count, 1));
  EXPECT_TRUE(convex.isSimple);
  EXPECT_NEAR(convex.area(), count * std::sin(2 * kPi / count) / 2, 1e-11);
}

}
