// SPDX-License-Identifier: BSD-3-Clause
#include "Rivals/Caster.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <memory>

using namespace irradiance;

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 pointOf(const Vector3& v)
{
  return { v[0], v[1], v[2] };
}

Triangles trianglesOf(const TriangleMesh& mesh)
{
  Triangles triangles;
  for (const Triangle& triangle : mesh.triangles())
  {
    const Kernel::Triangle_3 copy(pointOf(triangle.a), pointOf(triangle.b), pointOf(triangle.c));
    // CGAL demands that there is no triangle without area.
    if (!copy.is_degenerate())
    {
      triangles.push_back(copy);
    }
  }
  return triangles;
}

struct Tree
{
  explicit Tree(const TriangleMesh& mesh)
    : triangles(trianglesOf(mesh))
    , aabb(triangles.begin(), triangles.end())
  {
    aabb.build();
  }

  Hit cast(const Kernel::Ray_3& ray) const
  {
    const auto found = aabb.first_intersection(ray);
    // In the plane of a triangle a ray meets a segment of it; the others count no such
    // intersection.
    const auto* point = found ? boost::get<Kernel::Point_3>(&found->first) : nullptr;
    return point ? Hit{ std::sqrt(CGAL::squared_distance(ray.source(), *point)), { 0, 0 } } : Hit{};
  }

  Triangles triangles;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> aabb;
};

}

Caster makeCgalCaster(const TriangleMesh& mesh)
{
  return [tree = std::make_shared<const Tree>(mesh)](const std::vector<Ray>& rays) -> Cast {
    std::vector<Kernel::Ray_3> own;
    for (const Ray& ray : rays)
    {
      const Vector3& direction = ray.direction;
      own.emplace_back(
        pointOf(ray.origin), Kernel::Vector_3(direction[0], direction[1], direction[2]));
    }
    return [tree, own](std::vector<Hit>& hits) {
      std::transform(own.begin(), own.end(), hits.begin(),
        [&](const Kernel::Ray_3& ray) { return tree->cast(ray); });
    };
  };
}
