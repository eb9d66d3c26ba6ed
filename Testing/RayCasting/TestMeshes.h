// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/TriangleMesh.h"
#include "RandomVectors.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

// Meshes made in code, each hard for ray casting in its own way.

namespace irradiance::test
{

/// Test counts are for an optimised build; sanitizers and -O0 are some twenty times slower.
#if defined(VTKIRRADIANCE_IS_SANITIZED) || !defined(NDEBUG)
constexpr int kFewer = 25;
#else
constexpr int kFewer = 1;
#endif

/// How often a test repeats its work: 1, or what VTKIRRADIANCE_TEST_EFFORT says, for runs that take
/// hours and find what seconds do not.
inline int effort()
{
  const char* wanted = std::getenv("VTKIRRADIANCE_TEST_EFFORT");
  return wanted ? std::max(1, std::atoi(wanted)) : 1;
}

struct NamedMesh
{
  std::string name;
  std::vector<Triangle> triangles;
  bool isClosed = false;            ///< fronts outside
  Vector3 inside = Vector3::Zero(); ///< a point inside, when closed
};

/// Names the tests of INSTANTIATE_TEST_SUITE_P.
struct NameOfMesh
{
  template <typename ParamInfo>
  std::string operator()(const ParamInfo& info) const
  {
    std::string name = info.param.name;
    std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
  }
};

inline void PrintTo(const NamedMesh& mesh, std::ostream* out)
{
  *out << mesh.name;
}

using Triangles = std::vector<Triangle>;

inline void append(Triangles& all, const Triangles& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

inline Triangles moved(Triangles triangles, const AffineMap& map)
{
  for (Triangle& triangle : triangles)
  {
    triangle = transformed(map, triangle);
  }
  return triangles;
}

inline Triangles scaled(const Triangles& triangles, double factor)
{
  return moved(triangles, { factor * Matrix3::Identity(), Vector3::Zero() });
}

/// Triangles as indices of shared corners.
struct IndexedTriangles
{
  std::vector<Vector3> points;
  std::vector<std::array<int, 3>> corners;

  Triangles flat() const
  {
    Triangles triangles;
    for (const auto& c : corners)
    {
      triangles.push_back({ points[c[0]], points[c[1]], points[c[2]] });
    }
    return triangles;
  }
};

/// The grid (i, j), 0 <= i <= columns, 0 <= j <= rows; its front points along i cross j.
inline Triangles grid(
  int columns, int rows, const std::function<Vector3(int, int)>& point, bool otherDiagonal = false)
{
  Triangles triangles;
  for (int i = 0; i < columns; ++i)
  {
    for (int j = 0; j < rows; ++j)
    {
      const Vector3 p = point(i, j), q = point(i + 1, j);
      const Vector3 r = point(i + 1, j + 1), s = point(i, j + 1);
      if (otherDiagonal)
      {
        triangles.push_back({ p, q, s });
        triangles.push_back({ q, r, s });
      }
      else
      {
        triangles.push_back({ p, q, r });
        triangles.push_back({ p, r, s });
      }
    }
  }
  return triangles;
}

/// A closed box, fronts outside; each side has n[axis] cells along each axis.
inline Triangles boxOfCells(const Vector3& lower, const Vector3& upper, const std::array<int, 3>& n)
{
  const auto coordinate = [&](int axis, int i) {
    return i == n[axis] ? upper[axis] : lower[axis] + (upper[axis] - lower[axis]) * i / n[axis];
  };
  Triangles triangles;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const bool isUpper : { false, true })
    {
      const int first = isUpper ? u : v, second = isUpper ? v : u;
      append(triangles, grid(n[first], n[second], [&](int i, int j) {
        Vector3 p;
        p[axis] = isUpper ? upper[axis] : lower[axis];
        p[first] = coordinate(first, i);
        p[second] = coordinate(second, j);
        return p;
      }));
    }
  }
  return triangles;
}

/// A unit sphere: an icosahedron, each triangle divided into four, `level` times.
inline Triangles icosphere(int level)
{
  const double g = 0.5 * (1 + std::sqrt(5.0));
  IndexedTriangles sphere{
    { { -1, g, 0 }, { 1, g, 0 }, { -1, -g, 0 }, { 1, -g, 0 }, { 0, -1, g }, { 0, 1, g },
      { 0, -1, -g }, { 0, 1, -g }, { g, 0, -1 }, { g, 0, 1 }, { -g, 0, -1 }, { -g, 0, 1 } },
    { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 }, { 1, 5, 9 },
      { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 }, { 3, 2, 6 },
      { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 }, { 9, 8, 1 } }
  };
  for (Vector3& point : sphere.points)
  {
    point.normalize();
  }
  for (; level > 0; --level)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [place, isNew] =
        middles.insert({ std::minmax(i, j), static_cast<int>(sphere.points.size()) });
      if (isNew)
      {
        sphere.points.push_back((sphere.points[i] + sphere.points[j]).normalized());
      }
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : sphere.corners)
    {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    sphere.corners = std::move(finer);
  }
  return sphere.flat();
}

/// A torus around the z axis with radii 1 and 0.4.
inline Triangles torus(int around, int across)
{
  const double step = 2 * std::acos(-1.0);
  return grid(around, across, [&](int i, int j) {
    const double u = step * (i % around) / around, v = step * (j % across) / across;
    const double r = 1 + 0.4 * std::cos(v);
    return Vector3(r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v));
  });
}

/// Triangles of all sizes from 2^-12 to 1, needles among them, anywhere in the unit cube.
inline Triangles randomSoup(int count, unsigned seed)
{
  RandomVectors random(seed);
  Triangles triangles;
  for (int i = 0; i < count; ++i)
  {
    const Vector3 a = random.inCube();
    const double size = random.powerOfTwo(-12, 0);
    const Vector3 b = a + size * random.direction();
    triangles.push_back({ a, b, a + random.powerOfTwo(-20, 0) * size * random.direction() });
  }
  return triangles;
}

/// Triangles of all sizes that cross each other in the walls of a room, which are not at floats.
inline Triangles crossedWalls()
{
  Triangles all;
  for (int wall = 0; wall < 6; ++wall)
  {
    const double place = (wall % 2 == 0 ? -1 : 1) / (1.2 + wall / 30.0);
    for (Triangle triangle : scaled(randomSoup(200, 11 + static_cast<unsigned>(wall)), 0.4))
    {
      triangle.a[wall / 2] = triangle.b[wall / 2] = triangle.c[wall / 2] = place;
      all.push_back(triangle);
    }
  }
  return all;
}

/// A room of small cells with two boxes in it; all walls axis-aligned, the outer ones at the
/// tree's boundary.
inline Triangles room()
{
  Triangles triangles = boxOfCells({ 0, 0, 0 }, { 4, 3, 2.5 }, { 8, 6, 5 });
  append(triangles, boxOfCells({ 1, 1, 0.1 }, { 2, 1.8, 0.9 }, { 2, 2, 2 }));
  append(triangles, boxOfCells({ 2.5, 0, 0 }, { 3.1, 0.7, 1.3 }, { 3, 3, 3 })); // on the floor
  return triangles;
}

/// Two sheets in one plane, cut along different diagonals; one covers part of the other.
inline Triangles coincidentSheets(const Matrix3& rotation)
{
  const auto sheet = [&](double size, bool otherDiagonal) {
    return grid(
      8, 8, [&](int i, int j) { return Vector3(size * (i - 4), size * (j - 4), 0.25); },
      otherDiagonal);
  };
  Triangles triangles = sheet(0.25, false);
  append(triangles, sheet(0.25, true));
  append(triangles, sheet(0.125, false));
  append(triangles, sheet(0.25, false));
  return moved(std::move(triangles), { rotation, Vector3::Zero() });
}

/// A ball and a crumpled heap of tiny triangles in a large room, so that rounding is large compared
/// with a triangle.
inline Triangles dustInRoom()
{
  Triangles triangles = boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 });
  const Matrix3 small = 0x1p-11 * RandomVectors(8).rotation();
  append(triangles, moved(icosphere(2), { small, Vector3(0.3, 0.4, -0.9) }));
  append(triangles, moved(randomSoup(400, 9), { small, Vector3(-0.6, 0.1, 0.2) }));
  return triangles;
}

/// An L seen from above, 2 x 2 x 1 with a 1 x 1 corner missing, in cells.
inline Triangles angledHall()
{
  IndexedTriangles hall;
  const std::vector<std::array<int, 2>> outline = { { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 },
    { 1, 1 }, { 1, 2 }, { 0, 2 }, { 0, 1 } };
  const int n = static_cast<int>(outline.size());
  for (const auto& [x, y] : outline)
  {
    hall.points.push_back(Vector3(x, y, 0));
    hall.points.push_back(Vector3(x, y, 1));
  }
  for (int i = 0; i < n; ++i)
  {
    const int p = 2 * i, q = 2 * ((i + 1) % n);
    hall.corners.push_back({ p, q, q + 1 });
    hall.corners.push_back({ p, q + 1, p + 1 });
  }
  for (const auto& [a, b, c, d] :
    { std::array<int, 4>{ 0, 1, 4, 7 }, { 1, 2, 3, 4 }, { 7, 4, 5, 6 } })
  {
    hall.corners.push_back({ 2 * a, 2 * c, 2 * b });
    hall.corners.push_back({ 2 * a, 2 * d, 2 * c });
    hall.corners.push_back({ 2 * a + 1, 2 * b + 1, 2 * c + 1 });
    hall.corners.push_back({ 2 * a + 1, 2 * c + 1, 2 * d + 1 });
  }
  return hall.flat();
}

/// A prism of length 1. Its edge of this many degrees runs along y through the origin; the walls at
/// the edge are 1 long.
inline Triangles wedge(double degrees)
{
  const double angle = degrees * std::acos(-1.0) / 180;
  IndexedTriangles prism{ {}, { { 0, 1, 2 }, { 3, 5, 4 } } };
  for (const double y : { 0.0, 1.0 })
  {
    prism.points.push_back(Vector3(0, y, 0));
    prism.points.push_back(Vector3(1, y, 0));
    prism.points.push_back(Vector3(std::cos(angle), y, std::sin(angle)));
  }
  for (int i = 0; i < 3; ++i)
  {
    const int next = (i + 1) % 3;
    prism.corners.push_back({ i, i + 3, next + 3 });
    prism.corners.push_back({ i, next + 3, next });
  }
  return prism.flat();
}

inline NamedMesh wedgeMesh(const std::string& name, double degrees, const Matrix3& turn)
{
  const double half = 0.5 * degrees * std::acos(-1.0) / 180;
  const Vector3 inside = turn * Vector3(0.9 * std::cos(half), 0.5, 0.9 * std::sin(half));
  return { name, moved(wedge(degrees), { turn, Vector3::Zero() }), true, inside };
}

/// A ball with a spike on each triangle: edges of all angles, and far from convex.
inline Triangles spikyBall(int level, double reach)
{
  Triangles triangles;
  for (const Triangle& t : icosphere(level))
  {
    const Vector3 tip = reach * (t.a + t.b + t.c).normalized();
    append(triangles, { { t.a, t.b, tip }, { t.b, t.c, tip }, { t.c, t.a, tip } });
  }
  return triangles;
}

/// A closed mesh of triangles from Data/downloaded (OFF); empty if it was not fetched.
inline Triangles downloadedMesh(const std::string& name)
{
  std::ifstream file(std::string(VTKIRRADIANCE_DATA_DIR) + "/downloaded/" + name);
  std::string heading;
  std::size_t points = 0, faces = 0, edges = 0;
  if (!(file >> heading >> points >> faces >> edges))
  {
    return {};
  }
  IndexedTriangles mesh;
  for (Vector3 point; mesh.points.size() < points && file >> point[0] >> point[1] >> point[2];)
  {
    mesh.points.push_back(point);
  }
  int corners = 0;
  for (std::array<int, 3> face; file >> corners >> face[0] >> face[1] >> face[2];)
  {
    mesh.corners.push_back(face);
  }
  return mesh.flat();
}

/// Closed meshes, each with a point inside.
inline std::vector<NamedMesh> closedMeshes()
{
  const Matrix3 turn = RandomVectors(5).rotation();
  const AffineMap away{ turn, Vector3(1e4, -2e4, 5e3) };
  const Triangles box = boxOfCells({ -1, -1, -1 }, { 1, 1, 1 }, { 1, 1, 1 });
  const Triangles sliver = boxOfCells({ -1, -1, -5e-7 }, { 1, 1, 5e-7 }, { 2, 2, 1 });
  const Matrix3 straight = Matrix3::Identity();
  std::vector<NamedMesh> meshes = {
    { "box of 12", box, true, { 0, 0, 0 } },
    { "box of 12, turned", moved(box, { turn, Vector3::Zero() }), true, { 0, 0, 0 } },
    { "box of 12, 1e-6", scaled(box, 1e-6), true, { 0, 0, 0 } },
    { "box of 12, 1e4 away", moved(box, away), true, away.translation },
    { "sphere", icosphere(3), true, { 0, 0, 0 } },
    { "sphere, 1e6", scaled(icosphere(3), 1e6), true, { 0, 0, 0 } },
    { "torus", torus(32, 16), true, { 1, 0, 0 } },
    { "angled hall", angledHall(), true, { 0.6, 0.7, 0.4 } },
    { "angled hall, turned", moved(angledHall(), { turn, Vector3::Zero() }), true,
      turn * Vector3(0.6, 0.7, 0.4) },
    { "sliver box 1e-6", sliver, true, { 0, 0, 0 } },
    { "sliver box 1e-6, turned", moved(sliver, { turn, Vector3::Zero() }), true, { 0, 0, 0 } },
    { "needle box 1e-3", boxOfCells({ 0, 0, 0 }, { 1, 1e-3, 1e-3 }, { 5, 1, 1 }), true,
      { 0.45, 4e-4, 5e-4 } },
    { "spiky ball", spikyBall(1, 2.5), true, { 0, 0, 0 } },
    wedgeMesh("wedge of 45", 45, straight),
    wedgeMesh("wedge of 20, turned", 20, turn),
    wedgeMesh("wedge of 5", 5, straight),
    wedgeMesh("wedge of 5, turned", 5, turn),
    wedgeMesh("wedge of 1", 1, straight),
    wedgeMesh("wedge of 1, turned", 1, turn),
  };
  const Triangles bunny = downloadedMesh("bunny.off");
  if (!bunny.empty())
  {
    meshes.push_back({ "bunny", bunny, true, { -1, 4, 0 } });
  }
  return meshes;
}

inline std::vector<NamedMesh> testMeshes()
{
  const Matrix3 turn = RandomVectors(6).rotation();
  std::vector<NamedMesh> meshes = closedMeshes();
  meshes.push_back({ "room", room() });
  meshes.push_back(
    { "room, 1e4 sizes away", moved(room(), { Matrix3::Identity(), Vector3(4e4, -3e4, 1e4) }) });
  meshes.push_back({ "room, turned", moved(room(), { turn, Vector3(0.1, 0.2, 0.3) }) });
  meshes.push_back(
    { "sphere, 1e6 away", moved(icosphere(3), { Matrix3::Identity(), Vector3(1e6, -2e6, 5e5) }) });
  meshes.push_back({ "soup", randomSoup(600, 7) });
  meshes.push_back({ "door", boxOfCells({ 0, 0, 0 }, { 0.9, 0.04, 2.1 }, { 4, 1, 9 }) });
  meshes.push_back(
    { "flat door", grid(4, 9, [](int i, int j) { return Vector3(0.225 * i, 0.1, 0.23 * j); }) });
  meshes.push_back({ "sheets", coincidentSheets(Matrix3::Identity()) });
  meshes.push_back({ "sheets, turned", coincidentSheets(turn) });
  meshes.push_back({ "crossed walls", crossedWalls() });
  meshes.push_back({ "dust", dustInRoom() });
  return meshes;
}

}
