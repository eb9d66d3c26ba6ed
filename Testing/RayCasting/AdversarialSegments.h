// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Ellipsoids/EnclosingEllipsoid.h"
#include "RandomVectors.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

// Bodies, motions and segments that are hard for an ellipsoid test. The segments aim at a triangle
// where it touches the ellipsoid from inside, along the ellipsoid's surface or ending on it.

namespace irradiance::test
{

struct Motion
{
  std::string name;
  AffineMap worldFromObject;
  bool hasInverse = true; ///< one that doubles can represent
};

inline std::vector<Motion> hardMotions()
{
  RandomVectors random(99);
  const Vector3 near(1.5, -2.25, 0.7);
  const Vector3 far(1e7, -1e7, 3e6);
  const auto stretch = [](double x, double y, double z) {
    return Matrix3(Vector3(x, y, z).asDiagonal());
  };
  const auto shear = [](double xy, double yz) {
    Matrix3 m = Matrix3::Identity();
    m(0, 1) = xy;
    m(1, 2) = yz;
    return m;
  };
  const auto turn = [&] { return random.rotation(); };
  return {
    { "identity", {} },
    { "rotation", { turn(), near } },
    { "reflection", { stretch(-1, 1, 1) * turn(), near } },
    { "uniform 1e-6", { turn() * 1e-6, near * 1e-6 } },
    { "uniform 1e6", { turn() * 1e6, near * 1e6 } },
    { "uniform 1e-6 away", { turn() * 1e-6, near } },
    { "uniform 1e-12", { turn() * 1e-12, Vector3::Zero() } },
    { "uniform 1e12", { turn() * 1e12, Vector3::Zero() } },
    { "stretch 1e-6 1 1e6", { turn() * stretch(1e-6, 1, 1e6) * turn(), near } },
    { "stretch along axes", { stretch(1e-6, 1, 1e6), near } },
    { "shear 1e3", { turn() * shear(1e3, -50), near } },
    { "shear 1e6", { shear(1e6, 0), near } },
    { "1e5 away", { turn(), far * 1e-2 } },
    { "1e7 away", { turn(), far } },
    { "1e7 away, reflected", { stretch(1, -1, 1) * turn(), far } },
    { "flattened 1e-6", { turn() * stretch(1, 1, 1e-6) * turn(), near } },
    { "needle 1e-6", { turn() * stretch(1, 1e-6, 1e-6) * turn(), near } },
    { "flattened 1e-12", { turn() * stretch(1, 1, 1e-12) * turn(), near }, false },
    { "flattened 1e-18", { turn() * stretch(1, 1, 1e-18) * turn(), near }, false },
    { "flat, rank 2", { stretch(1, 1, 0), near }, false },
  };
}

struct Body
{
  std::string name;
  std::vector<std::array<Vector3, 3>> triangles;
  EnclosingEllipsoid ellipsoid;
  Box bounds;
  std::vector<std::pair<std::size_t, int>> contacts; ///< triangle, and its corner on the ellipsoid

  Body(std::string bodyName, std::vector<std::array<Vector3, 3>> bodyTriangles)
    : name(std::move(bodyName))
    , triangles(std::move(bodyTriangles))
  {
    std::vector<Vector3> points;
    for (const auto& triangle : triangles)
    {
      points.insert(points.end(), triangle.begin(), triangle.end());
    }
    for (const Vector3& point : points)
    {
      bounds.add(point);
    }
    ellipsoid = encloseByEllipsoid(points);
    findContacts();
  }

private:
  void findContacts()
  {
    std::vector<std::pair<double, std::pair<std::size_t, int>>> corners;
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Vector3 d = triangles[i][k] - ellipsoid.center;
        corners.push_back({ (ellipsoid.shape * d).norm(), { i, k } });
      }
    }
    std::sort(corners.rbegin(), corners.rend());
    for (std::size_t i = 0; i < corners.size() && (i < 60 || corners[i].first > 0.9999); ++i)
    {
      contacts.push_back(corners[i].second);
    }
  }
};

inline Body soup(const std::string& name, unsigned seed, const Vector3& size, const Vector3& offset)
{
  RandomVectors random(seed);
  const auto point = [&] { return Vector3(random.inCube().cwiseProduct(size) + offset); };
  std::vector<std::array<Vector3, 3>> triangles;
  for (int i = 0; i < 500; ++i)
  {
    triangles.push_back({ point(), point(), point() });
  }
  return { name, triangles };
}

inline Body sphere(int rings)
{
  const auto at = [&](int ring, int step) {
    const double theta = 3.14159265358979 * ring / rings;
    const double phi = 3.14159265358979 * step / rings;
    return Vector3(
      std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  std::vector<std::array<Vector3, 3>> triangles;
  for (int ring = 0; ring < rings; ++ring)
  {
    for (int step = 0; step < 2 * rings; ++step)
    {
      if (ring > 0)
      {
        triangles.push_back({ at(ring, step), at(ring + 1, step), at(ring, step + 1) });
      }
      if (ring + 1 < rings)
      {
        triangles.push_back({ at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1) });
      }
    }
  }
  return { "sphere", triangles };
}

inline Body box()
{
  const auto at = [](int bits) {
    return Vector3((bits & 1) != 0 ? 3 : -3, (bits & 2) != 0 ? 2 : -2, (bits & 4) != 0 ? 1 : -1);
  };
  const int faces[6][4] = { { 0, 1, 3, 2 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 }, { 2, 3, 7, 6 },
    { 0, 2, 6, 4 }, { 1, 3, 7, 5 } };
  std::vector<std::array<Vector3, 3>> triangles;
  for (const auto& f : faces)
  {
    triangles.push_back({ at(f[0]), at(f[1]), at(f[2]) });
    triangles.push_back({ at(f[0]), at(f[2]), at(f[3]) });
  }
  return { "box", triangles };
}

inline std::vector<Body> hardBodies()
{
  return { soup("soup", 1, { 1, 1, 1 }, Vector3::Zero()),
    soup("flat door", 2, { 1, 2, 0 }, Vector3::Zero()),
    soup("needle 1e4", 3, { 1, 1e-4, 1e-4 }, Vector3::Zero()),
    soup("offset 1e4", 4, { 1, 1, 1 }, { 1e4, -1e4, 3e3 }), sphere(12), box() };
}

struct Segment
{
  Vector3 from;
  Vector3 to;
  std::size_t target; ///< the triangle that it is aimed at
};

class SegmentSource
{
public:
  SegmentSource(const Body& body, const AffineMap& worldFromObject, unsigned seed)
    : body_(body)
    , map_(worldFromObject)
    , random_(seed)
    , semiAxes_(worldFromObject.linear * body.ellipsoid.shape.inverse())
  {
  }

  Segment next()
  {
    const auto& [target, corner] = body_.contacts[pick(body_.contacts.size())];
    const auto& triangle = body_.triangles[target];
    const Vector3& contact = triangle[corner];
    // Aims 2^-24 to 1 of the way into the triangle. A third of the segments is moved a little
    // outwards, another third gets ends rounded to float.
    const double depth = random_.powerOfTwo(-24, 0);
    const double side = random_.uniform(0, 1);
    const Vector3 inside = contact +
      depth *
        (side * (triangle[(corner + 1) % 3] - contact) +
          (1 - side) * (triangle[(corner + 2) % 3] - contact));
    const Vector3 onUnitBall = body_.ellipsoid.shape * (contact - body_.ellipsoid.center);
    Vector3 aim = map_(inside);
    const Vector3 along = direction(onUnitBall);
    const double choice = random_.uniform(0, 3);
    if (choice < 1)
    {
      aim += random_.powerOfTwo(-52, -12) * (semiAxes_ * onUnitBall); // just outside
    }
    const Vector3 from = aim - reach() * along;
    const Vector3 to = aim + reachBeyond() * along;
    return choice < 2 ? Segment{ from, to, target }
                      : Segment{ roundedToFloat(from), roundedToFloat(to), target };
  }

private:
  std::size_t pick(std::size_t n)
  {
    return std::min(n - 1, static_cast<std::size_t>(random_.uniform(0, static_cast<double>(n))));
  }
  static Vector3 roundedToFloat(const Vector3& x) { return x.cast<float>().cast<double>(); }
  double reach() { return random_.powerOfTwo(-7, random_.uniform(0, 1) < 0.1 ? 20 : 10); }
  /// One in ten ends in the triangle, one in ten just behind it.
  double reachBeyond()
  {
    const double choice = random_.uniform(0, 10);
    return choice < 1 ? 0.0 : choice < 2 ? random_.powerOfTwo(-40, -7) : reach();
  }
  /// Along the ellipsoid's surface, off by 2^-30 to 1; one in four is in any direction.
  Vector3 direction(const Vector3& onUnitBall)
  {
    const Vector3 tangent = onUnitBall.cross(random_.direction()).normalized();
    const Vector3 along = semiAxes_ * (tangent + random_.powerOfTwo(-30, 0) * random_.direction());
    return random_.uniform(0, 4) < 1 ? Vector3(along.norm() * random_.direction()) : along;
  }

  const Body& body_;
  const AffineMap& map_;
  RandomVectors random_;
  Matrix3 semiAxes_;
};

}
