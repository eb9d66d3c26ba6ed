// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Ray.h"
#include "Meshes/TriangleMesh.h"
#include "RandomVectors.h"

#include <array>
#include <cstring>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Rays that are hard for ray casting, aimed at given triangles.

namespace irradiance::test
{

inline std::string exactly(const Vector3& v)
{
  std::ostringstream text;
  text << std::hexfloat << '(' << v[0] << ", " << v[1] << ", " << v[2] << ')';
  return text.str();
}

inline std::string exactly(const Triangle& t)
{
  return exactly(t.a) + ' ' + exactly(t.b) + ' ' + exactly(t.c);
}

inline std::string exactly(const Ray& ray)
{
  return "from " + exactly(ray.origin) + " along " + exactly(ray.direction) + " leaving object " +
    std::to_string(ray.start.object) + " triangle " + std::to_string(ray.start.triangle);
}

inline std::string exactly(const Hit& hit)
{
  std::ostringstream text;
  text << std::hexfloat << hit.distance << " object " << hit.id.object << " triangle "
       << hit.id.triangle;
  return text.str();
}

/// Bit for bit, but for the weights.
inline bool isSameHit(const Hit& a, const Hit& b)
{
  return std::memcmp(&a.distance, &b.distance, sizeof a.distance) == 0 && a.id == b.id;
}

enum class RayKind
{
  Edge,      ///< at a point of an edge, or just beside it
  Vertex,    ///< at a vertex, or just beside it
  AxisPlane, ///< in an axis-aligned plane through a vertex: zero direction components
  Surface,   ///< starts on a surface: at a vertex, on an edge, or within
  Grazing,   ///< along a triangle, tilted by 2^-10 to 2^-54
  Anywhere
};
constexpr std::array<RayKind, 6> kRayKinds = { RayKind::Edge, RayKind::Vertex, RayKind::AxisPlane,
  RayKind::Surface, RayKind::Grazing, RayKind::Anywhere };

inline const char* nameOf(RayKind kind)
{
  constexpr const char* names[] = { "edge", "vertex", "axis plane", "surface", "grazing",
    "anywhere" };
  return names[static_cast<int>(kind)];
}

class RaySource
{
public:
  /// `ids` identifies the triangles; by default they belong to object 0.
  RaySource(std::vector<Triangle> triangles, unsigned seed, std::vector<TriangleId> ids = {})
    : triangles_(std::move(triangles))
    , ids_(std::move(ids))
    , random_(seed)
  {
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    {
      bounds_.add(triangles_[i].bounds());
      if (ids_.size() <= i)
      {
        ids_.push_back({ 0, i });
      }
    }
  }

  Ray next(RayKind kind)
  {
    switch (kind)
    {
      case RayKind::Edge:
        return towards(nearly(pointOfEdge()), origin());
      case RayKind::Vertex:
        return towards(nearly(vertex()), origin());
      case RayKind::AxisPlane:
        return inAxisPlane();
      case RayKind::Surface:
        return fromSurface();
      case RayKind::Grazing:
        return grazing();
      case RayKind::Anywhere:
        break;
    }
    return { origin(), random_.direction(), {} };
  }

  Vector3 vertex() { return corner(any(triangles_), below(3)); }
  /// A point of a random edge, often close to an end.
  Vector3 pointOfEdge()
  {
    const Triangle& triangle = any(triangles_);
    const int k = below(3);
    const Vector3 p = corner(triangle, k), q = corner(triangle, (k + 1) % 3);
    const double t = below(4) == 0 ? random_.powerOfTwo(-50, 0) : random_.uniform(0, 1);
    return p + t * (q - p);
  }
  RandomVectors& random() { return random_; }
  /// A box that contains all origins.
  Box originBounds() const
  {
    Box box = bounds_;
    box.inflate(20 * bounds_.extent().maxCoeff());
    return box;
  }

private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_.engine); }
  template <typename T>
  const T& any(const std::vector<T>& all)
  {
    return all[below(static_cast<int>(all.size()))];
  }
  static const Vector3& corner(const Triangle& triangle, int k)
  {
    return k == 0 ? triangle.a : k == 1 ? triangle.b : triangle.c;
  }

  /// A point in the bounds or around them.
  Vector3 origin()
  {
    const double reach = below(2) == 0 ? 0.5 : random_.powerOfTwo(-1, 4);
    const double size = bounds_.extent().maxCoeff();
    Vector3 p = bounds_.center() + reach * bounds_.extent().cwiseProduct(random_.inCube());
    if (reach > 0.5)
    {
      p += 0.5 * size * random_.inCube();
    }
    return p;
  }

  /// Often the point itself, otherwise one close to it.
  Vector3 nearly(const Vector3& point)
  {
    const double offset = bounds_.extent().maxCoeff() * random_.powerOfTwo(-52, -16);
    return below(3) > 0 ? point : Vector3(point + offset * random_.direction());
  }

  Ray towards(const Vector3& target, const Vector3& from)
  {
    const Vector3 direction = target - from;
    if (direction.isZero(0))
    {
      return { from, random_.direction(), {} };
    }
    return { from, below(2) == 0 ? direction.normalized() : direction, {} };
  }

  Ray inAxisPlane()
  {
    const int axis = below(3);
    Vector3 from = below(3) == 0 ? vertex() : origin();
    from[axis] = nearly(vertex())[axis];
    Vector3 direction = (below(2) == 0 ? vertex() : pointOfEdge()) - from;
    direction[axis] = below(2) == 0 ? 0.0 : -0.0;
    if (below(3) == 0)
    {
      direction[(axis + 1) % 3] = 0;
    }
    if (direction.isZero(0))
    {
      direction[(axis + 2) % 3] = below(2) == 0 ? 1 : -1;
    }
    return { from, direction, {} };
  }

  Ray fromSurface()
  {
    const int i = below(static_cast<int>(triangles_.size()));
    const Triangle& triangle = triangles_[i];
    const Vector3 p = corner(triangle, below(3)), q = corner(triangle, below(3));
    const double s = random_.uniform(0, 1), t = random_.uniform(0, 1);
    const Vector3 from = below(2) == 0
      ? Vector3(p + s * (q - p))
      : Vector3(triangle.a + s * ((triangle.b - triangle.a) + t * (triangle.c - triangle.b)));
    Ray ray;
    switch (below(4))
    {
      case 0:
        ray = towards(vertex(), from);
        break;
      case 1:
        ray = towards(pointOfEdge(), from);
        break;
      case 2:
        ray = towards(q, from);
        break;
      default:
        ray = { from, random_.direction(), {} };
    }
    ray.start = below(2) == 0 ? ids_[i] : TriangleId{};
    return ray;
  }

  Ray grazing()
  {
    const Triangle& triangle = any(triangles_);
    const Vector3 e = triangle.b - triangle.a, f = triangle.c - triangle.a;
    const int k = below(3);
    const Vector3 p = corner(triangle, k), q = corner(triangle, (k + 1) % 3);
    // Aims at corners more often than elsewhere: there a ray's way through a triangle is shortest.
    const Vector3 target = below(2) == 0 ? p : Vector3(p + random_.powerOfTwo(-30, 0) * (q - p));
    const Vector3 along =
      (random_.uniform() * e.normalized() + random_.uniform() * f.normalized()).normalized();
    const Vector3 normal = triangle.areaVector().normalized();
    if (!along.allFinite() || !normal.allFinite())
    {
      return { origin(), random_.direction(), {} };
    }
    const double distance = bounds_.extent().maxCoeff() * random_.powerOfTwo(-10, 0);
    const double tilt = random_.uniform() < 0 ? -1 : 1;
    return towards(
      target, target - distance * (along + tilt * random_.powerOfTwo(-54, -10) * normal));
  }

  std::vector<Triangle> triangles_;
  std::vector<TriangleId> ids_;
  RandomVectors random_;
  Box bounds_;
};

}
