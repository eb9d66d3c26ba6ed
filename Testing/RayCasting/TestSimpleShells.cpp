// SPDX-License-Identifier: BSD-3-Clause
// Which closed shells are proven not to cross themselves.

#include "Trees/SimpleShells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace irradiance
{
namespace
{

using Triangles = std::vector<Triangle>;

constexpr int kAround = 12, kAlong = 16;

/// Closed in both directions. `corner(u, v)`: u, v from 0 to 2 pi.
template <class Corner>
Triangles ring(const Corner& corner)
{
  Triangles triangles;
  for (int i = 0; i < kAlong; ++i)
  {
    for (int k = 0; k < kAround; ++k)
    {
      const auto at = [&](int di, int dk) -> Vector3 {
        return corner(
          2 * kPi * ((i + di) % kAlong) / kAlong, 2 * kPi * ((k + dk) % kAround) / kAround);
      };
      triangles.push_back({ at(0, 0), at(1, 0), at(1, 1) });
      triangles.push_back({ at(0, 0), at(1, 1), at(0, 1) });
    }
  }
  return triangles;
}

/// A point of the ring whose section is at (x, z).
Vector3 swept(double u, double x, double z)
{
  return { (3 + x) * std::cos(u), (3 + x) * std::sin(u), z };
}

/// 8 x 8 cells a side. `corner`: moves each corner of the cube [-1, 1]^3.
template <class Corner>
Triangles cube(const Corner& corner)
{
  constexpr int n = 8;
  Triangles triangles;
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1 : -1;
    const auto at = [&](int i, int k) {
      Vector3 point;
      point[axis] = sign;
      point[(axis + 1) % 3] = 2. * i / n - 1;
      point[(axis + 2) % 3] = sign * (2. * k / n - 1);
      return corner(point);
    };
    for (int i = 0; i < n; ++i)
    {
      for (int k = 0; k < n; ++k)
      {
        triangles.push_back({ at(i, k), at(i + 1, k), at(i + 1, k + 1) });
        triangles.push_back({ at(i, k), at(i + 1, k + 1), at(i, k + 1) });
      }
    }
  }
  return triangles;
}

/// For each shell that is closed, whether it is simple.
std::vector<bool> areSimple(const Triangles& triangles)
{
  const std::vector<std::uint32_t> partOf(triangles.size(), 0);
  SolidSides sides =
    solidSides(triangles, partOf, std::vector<bool>(triangles.size()), false, CancelPoint());
  markSimpleShells(sides, triangles, treeOf(triangles), CancelPoint());
  std::vector<bool> areSimple;
  for (const Shell& shell : sides.shells)
  {
    EXPECT_TRUE(shell.isClosed);
    areSimple.push_back(shell.isSimple);
  }
  return areSimple;
}

Triangles moved(Triangles triangles, const Vector3& by)
{
  for (Triangle& t : triangles)
  {
    t = { t.a + by, t.b + by, t.c + by };
  }
  return triangles;
}

Triangles joined(Triangles triangles, const Triangles& more)
{
  triangles.insert(triangles.end(), more.begin(), more.end());
  return triangles;
}

const std::vector<bool> kYes{ true }, kNo{ false }, kBoth{ true, true };
const Vector3 kUtm(5e5, 5.4e6, 100);

}

TEST(SimpleShells, CubesAndRings)
{
  const auto same = [](const Vector3& point) { return point; };
  EXPECT_EQ(areSimple(cube(same)), kYes);
  EXPECT_EQ(areSimple(moved(cube(same), kUtm)), kYes);
  EXPECT_EQ(
    areSimple(ring([](double u, double v) { return swept(u, std::cos(v), std::sin(v)); })), kYes);
  // Each for itself, though they cross.
  EXPECT_EQ(areSimple(joined(cube(same), moved(cube(same), Vector3::Constant(.7)))), kBoth);
}

TEST(SimpleShells, NotWhereTheyCross)
{
  // An eight; a section that turns twice; an eight that crosses in corners of the mesh.
  EXPECT_EQ(areSimple(ring([](double u, double v) {
    return swept(u, std::cos(v + .1), .5 * std::sin(2 * v + .2));
  })),
    kNo);
  EXPECT_EQ(areSimple(ring([](double u, double v) {
    const double r = .5 + std::cos(v);
    return swept(u, r * std::cos(v), r * std::sin(v));
  })),
    kNo);
  EXPECT_EQ(
    areSimple(ring([](double u, double v) { return swept(u, std::cos(v), .5 * std::sin(2 * v)); })),
    kNo);
  // A spike of one corner from the lid, through the floor, to it, and almost.
  for (const auto& [depth, expected] :
    { std::pair(-1.001, kNo), std::pair(-1.0, kNo), std::pair(-.999, kYes) })
  {
    const auto spike = [depth = depth](const Vector3& point) -> Vector3 {
      return point == Vector3(0, 0, 1) ? Vector3(.1, .1, depth) : point;
    };
    EXPECT_EQ(areSimple(cube(spike)), expected) << depth;
    EXPECT_EQ(areSimple(moved(cube(spike), kUtm)), expected) << depth;
  }
}

// What can be seen as a whole from one point does not cross itself. Through that point it does.
TEST(SimpleShells, StarsAreAndTurnedStarsAreNot)
{
  std::mt19937_64 random(7);
  for (int i = 0; i < 40; ++i)
  {
    std::vector<std::pair<Vector3, Vector3>> known; // corners of the sphere, and of the star
    const std::size_t turned = i % 2 == 0 ? 1000 : random() % 386;
    const auto star = [&](const Vector3& point) -> Vector3 {
      for (const auto& [from, to] : known)
      {
        if (from == point)
        {
          return to;
        }
      }
      const double radius = std::uniform_real_distribution<double>(.5, 2)(random);
      known.emplace_back(
        point, (known.size() == turned ? -3 : 1) * radius * point.normalized() + Vector3(9, 0, 0));
      return known.back().second;
    };
    EXPECT_EQ(areSimple(cube(star)), i % 2 == 0 ? kYes : kNo) << i;
  }
}

}
