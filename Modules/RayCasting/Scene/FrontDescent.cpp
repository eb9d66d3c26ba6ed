// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontDescent.h"

#include <algorithm>

namespace irradiance
{

void FrontDescent::descend(
  const TriangleTree& tree, const TreeRays& rays, const CornerRows& corners)
{
  const std::uint32_t room = TreeRays::roomFor(rays.count);
  queries_.need(room);
  others_.need(room);
  candidate_.need(room);
  further_.need(std::size_t{ 2 } * room);
  FrontSearches searches{ tree, queries_.data(), 0, others_.data(), 0, candidate_.data(),
    further_.data(), 0, static_cast<std::uint32_t>(further_.room()), corners, *this };
  frontStages().prepare(rays, searches);

  std::fill_n(candidate_.data(), room, TreeRays::kNone);
  frontStages().search(searches);
  furtherCount_ = searches.furtherCount;
  for (std::uint32_t i = 0; i < searches.otherCount; ++i)
  {
    searchExactly(tree, rays, searches.others[i], *this);
  }
}

void FrontSearch::run(const TriangleTree& tree, const TriangleMesh& mesh, const TreeRays& rays,
  const CornerRows& corners)
{
  if (rays.count == 0 || tree.isEmpty())
  {
    return;
  }
  mesh_ = &mesh;
  rays_ = rays;
  descend(tree, rays_, corners);
  frontStages().confirm(rays_, candidate_.data(), corners);
  confirmEach(rays_, furtherCount_, [&](std::size_t i, IntersectionLanes& lanes, unsigned lane) {
    const auto& [ray, reference] = further_[i];
    lanes.set(lane, originOf(rays_, ray), directionOf(rays_, ray), mesh[reference]);
    return FurtherCandidate{ ray, rays_.first + reference };
  });
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

const std::vector<FrontPairs::Pair>& FrontPairs::find(
  const TriangleTree& tree, const TreeRays& rays)
{
  pairs_.clear();
  if (rays.count == 0 || tree.isEmpty())
  {
    return pairs_;
  }
  // Nothing is worth to be prefetched: what is found waits in a list.
  descend(tree, rays, { reinterpret_cast<const double*>(tree.blocks()), 0 });
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    if (candidate_[ray] != TreeRays::kNone)
    {
      pairs_.push_back({ ray, candidate_[ray] });
    }
  }
  pairs_.insert(pairs_.end(), further_.data(), further_.data() + furtherCount_);
  return pairs_;
}

const std::vector<FrontPairs::Pair>& FrontPairs::find(const BodyBalls& balls, const TreeRays& rays)
{
  near_.need(std::size_t{ TreeRays::roomFor(rays.count) } / NearRays::kLeastLanes * balls.size());
  const std::uint32_t count = frontStages().findNear(rays, balls, near_.data());
  pairs_.clear();
  for (std::uint32_t i = 0; i < count; ++i)
  {
    for (unsigned lanes = near_[i].lanes; lanes != 0; lanes &= lanes - 1)
    {
      pairs_.push_back(
        { near_[i].first + static_cast<std::uint32_t>(__builtin_ctz(lanes)), near_[i].body });
    }
  }
  return pairs_;
}

}
