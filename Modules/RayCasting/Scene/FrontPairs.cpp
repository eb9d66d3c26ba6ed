// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/FrontPairs.h"

namespace irradiance
{

const std::vector<FrontPairs::Pair>& FrontPairs::find(
  const TriangleTree& tree, const TreeRays& rays)
{
  pairs_.clear();
  if (rays.count == 0 || tree.isEmpty())
  {
    return pairs_;
  }
  // Nothing is worth to be prefetched: what is found waits in a list.
  descent_.run(tree, rays, { reinterpret_cast<const char*>(tree.blocks()), 0, 1 }, *this);
  for (std::uint32_t ray = 0; ray < rays.count; ++ray)
  {
    if (descent_.candidates()[ray] != TreeRays::kNone)
    {
      pairs_.push_back({ ray, descent_.candidates()[ray] });
    }
  }
  pairs_.insert(pairs_.end(), descent_.further(), descent_.further() + descent_.furtherCount());
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
