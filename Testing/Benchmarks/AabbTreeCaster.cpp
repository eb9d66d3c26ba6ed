#include "AabbTreeCaster.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

using namespace irradiance;

namespace
{

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

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

}

struct AabbTreeCaster::Tree
{
  explicit Tree(const TriangleMesh& mesh)
    : triangles(trianglesOf(mesh))
    , aabb(triangles.begin(), triangles.end())
  {
    aabb.build();
  }

  Triangles triangles;
  AabbTree aabb;
  std::vector<Kernel::Ray_3> rays;
};

AabbTreeCaster::AabbTreeCaster(std::string name, const TriangleMesh& mesh)
  : Caster(std::move(name))
  , tree_(std::make_unique<Tree>(mesh))
{
}

AabbTreeCaster::~AabbTreeCaster() = default;

void AabbTreeCaster::setRays(const std::vector<Ray>& rays)
{
  tree_->rays.clear();
  for (const Ray& ray : rays)
  {
    tree_->rays.emplace_back(
      pointOf(ray.origin), Kernel::Vector_3(ray.direction[0], ray.direction[1], ray.direction[2]));
  }
}

void AabbTreeCaster::cast(std::vector<Hit>& hits)
{
  for (std::size_t i = 0; i < tree_->rays.size(); ++i)
  {
    const Kernel::Ray_3& ray = tree_->rays[i];
    hits[i] = {};
    const auto found = tree_->aabb.first_intersection(ray);
    // In the plane of a triangle a ray meets a segment of it; the others count no such intersection.
    if (const auto* point = found ? boost::get<Kernel::Point_3>(&found->first) : nullptr)
    {
      hits[i].distance = std::sqrt(CGAL::squared_distance(ray.source(), *point));
      hits[i].id = { 0, static_cast<std::uint32_t>(found->second - tree_->triangles.begin()) };
    }
  }
}
