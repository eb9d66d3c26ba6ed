// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/TriangleIntersection.h"

#include "TestMeshes.h"
#include "TestRays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>

// No ray escapes from inside a closed mesh, however precisely it is aimed at an edge or a vertex.

namespace irradiance
{
namespace
{

using test::exactly;
using test::NamedMesh;
using test::RandomVectors;

/// The triangles around each vertex.
class Neighbourhood
{
public:
  explicit Neighbourhood(const std::vector<Triangle>& triangles)
  {
    std::map<std::array<double, 3>, std::vector<Triangle>> around;
    for (const Triangle& triangle : triangles)
    {
      for (const Vector3* p : { &triangle.a, &triangle.b, &triangle.c })
      {
        around[key(*p)].push_back(triangle);
      }
    }
    for (const Triangle& triangle : triangles)
    {
      for (const Vector3* p : { &triangle.a, &triangle.b, &triangle.c })
      {
        corners_.push_back(around[key(*p)]);
      }
    }
  }
  const std::vector<Triangle>& around(std::size_t triangle, std::size_t corner) const
  {
    return corners_[3 * triangle + corner];
  }

private:
  static std::array<double, 3> key(const Vector3& p) { return { p[0], p[1], p[2] }; }

  std::vector<std::vector<Triangle>> corners_;
};

bool meetsAny(const ShearedRay& ray, const std::vector<Triangle>& triangles)
{
  double distance;
  return std::any_of(triangles.begin(), triangles.end(),
    [&](const Triangle& triangle) { return ray.intersects(triangle, distance); });
}

/// A point inside: at most 99 % of the way from the known point to the surface in a random
/// direction. So it is farther off that surface than a point of a walk (SurfacePoint::clearance).
Vector3 pointInside(const NamedMesh& mesh, RandomVectors& random)
{
  const Vector3 direction = random.direction();
  const ShearedRay ray(mesh.inside, direction);
  double nearest = kInfinity, distance;
  for (const Triangle& triangle : mesh.triangles)
  {
    nearest = ray.intersects(triangle, distance) ? std::min(nearest, distance) : nearest;
  }
  const double reach = random.uniform() < 0 ? random.uniform(0, 0.99) : 0.99;
  return mesh.inside + reach * nearest * direction;
}

class Watertight : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(Watertight, NoRayLeavesAClosedMesh)
{
  constexpr unsigned kSeed = 1;
  constexpr int kRaysFromEach = 600;
  const int kOrigins = 1000 / test::kFewer * test::effort();
  const NamedMesh& mesh = GetParam();
  const Neighbourhood neighbourhood(mesh.triangles);
  RandomVectors random(kSeed);
  long leaks = 0;
  for (int i = 0; i < kOrigins; ++i)
  {
    const Vector3 origin = pointInside(mesh, random);
    for (int j = 0; j < kRaysFromEach; ++j)
    {
      const std::size_t target = random.engine() % mesh.triangles.size();
      const std::size_t corner = random.engine() % 3;
      const Triangle& triangle = mesh.triangles[target];
      const Vector3 points[] = { triangle.a, triangle.b, triangle.c };
      const Vector3 &p = points[corner], &q = points[(corner + 1) % 3];
      const double t = j % 4 == 0 ? 0.0
        : j % 4 == 1              ? random.powerOfTwo(-52, 0)
                                  : random.uniform(0, 1);
      const Vector3 direction = p + t * (q - p) - origin;
      const ShearedRay ray(origin, direction);
      if (!meetsAny(ray, neighbourhood.around(target, corner)) &&
        !meetsAny(ray, neighbourhood.around(target, (corner + 1) % 3)) &&
        !meetsAny(ray, mesh.triangles) && ++leaks <= 3)
      {
        ADD_FAILURE() << "seed " << kSeed << ": " << exactly(Ray{ origin, direction, {} }) << " at "
                      << t << " of an edge of " << exactly(triangle);
      }
    }
  }
  EXPECT_EQ(leaks, 0) << "of " << long{ kOrigins } * kRaysFromEach;
}

INSTANTIATE_TEST_SUITE_P(
  ClosedMeshes, Watertight, testing::ValuesIn(test::closedMeshes()), test::NameOfMesh());

}
}
