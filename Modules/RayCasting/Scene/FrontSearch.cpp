// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontSearch.h"


#include <algorithm>

namespace irradiance
{

void FrontSearch::run(const TriangleTree& tree, const TriangleMesh& mesh, const TreeRays& rays,
  const CornerRows& corners)
{
  if (rays.count == 0 || tree.isEmpty())
  {
    return;
  }
  mesh_ = &mesh;
  rays_ = rays;
  constexpr std::size_t kCorners = 9 * sizeof(double);
  descent_.run(tree, rays_,
    { reinterpret_cast<const char*>(corners.first), corners.stride * sizeof(double), kCorners },
    *this);
  frontStages().confirm(rays_, descent_.candidates(), corners);
  confirmFurther();
}

void FrontSearch::confirmFurther()
{
  const std::uint32_t count = descent_.furtherCount();
  IntersectionLanes lanes;
  for (std::uint32_t first = 0; first < count; first += IntersectionLanes::kSize)
  {
    const std::uint32_t some = std::min<std::uint32_t>(count - first, IntersectionLanes::kSize);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, reference] = descent_.further()[first + lane];
      lanes.set(lane, originOf(rays_, ray), directionOf(rays_, ray), (*mesh_)[reference]);
    }
    frontStages().intersect(lanes);
    for (unsigned lane = 0; lane < some; ++lane)
    {
      const auto& [ray, reference] = descent_.further()[first + lane];
      rays_.keepCloser(ray, rays_.first + reference, lanes.distance[lane], lanes.weightB[lane],
        lanes.weightC[lane]);
    }
  }
}

void FrontSearch::test(std::uint32_t ray, std::uint32_t reference)
{
  double distance;
  Vector3 weights;
  if (ShearedRay(originOf(rays_, ray), directionOf(rays_, ray))
        .intersects((*mesh_)[reference], distance, &weights))
  {
    rays_.keepCloser(ray, rays_.first + reference, distance, weights[1], weights[2]);
  }
}

}
