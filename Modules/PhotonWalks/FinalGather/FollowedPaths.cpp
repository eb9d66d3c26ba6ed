// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FollowedPaths.h"

namespace irradiance
{

void FollowedPaths::clear()
{
  segments_.clear();
  values_.clear();
  shadows_.clear();
  ends_.clear();
}

void FollowedPaths::reserve(std::size_t paths, std::size_t segments, std::size_t values)
{
  segments_.reserve(segments);
  values_.reserve(values);
  ends_.reserve(paths);
}

void FollowedPaths::addPath(const FollowedPaths& from, std::size_t path)
{
  const Path added = from[path];
  segments_.insert(segments_.end(), added.begin, added.end);
  values_.insert(values_.end(), added.values, from.values_.data() + from.ends_[path].value);
  shadows_.insert(shadows_.end(), added.shadows, added.endOfShadows);
  endPath();
}

FollowedPaths FollowedPaths::mergedWith(
  const FollowedPaths& before, const std::vector<std::size_t>& places) const
{
  FollowedPaths merged;
  std::size_t next = 0;
  for (const std::size_t place : places)
  {
    place == kAnew ? merged.addPath(*this, next++) : merged.addPath(before, place);
  }
  return merged;
}

std::size_t FollowedPaths::bytes() const
{
  return segments_.capacity() * sizeof(GatherSegment) + values_.capacity() * sizeof(double) +
    shadows_.capacity() * sizeof(ShadowRay) + ends_.capacity() * sizeof(End);
}

}
