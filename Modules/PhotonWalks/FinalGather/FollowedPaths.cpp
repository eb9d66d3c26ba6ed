// SPDX-License-Identifier: BSD-3-Clause
#include "FinalGather/FollowedPaths.h"

namespace irradiance
{

void FollowedPaths::clear(std::size_t paths, std::size_t segments, std::size_t values)
{
  segments_.clear();
  segments_.reserve(segments);
  values_.clear();
  values_.reserve(values);
  shadows_.clear();
  ends_.clear();
  ends_.reserve(paths);
}

void FollowedPaths::addPaths(const FollowedPaths& from, std::size_t first, std::size_t end)
{
  const End begin = from.startOf(first), last = from.startOf(end);
  const End shift{ segments_.size() - begin.segment, values_.size() - begin.value,
    shadows_.size() - begin.shadow }; // modulo 2^64
  segments_.insert(
    segments_.end(), from.segments_.data() + begin.segment, from.segments_.data() + last.segment);
  values_.insert(
    values_.end(), from.values_.data() + begin.value, from.values_.data() + last.value);
  shadows_.insert(
    shadows_.end(), from.shadows_.data() + begin.shadow, from.shadows_.data() + last.shadow);
  for (std::size_t path = first; path < end; ++path)
  {
    const End& own = from.ends_[path];
    ends_.push_back(
      { own.segment + shift.segment, own.value + shift.value, own.shadow + shift.shadow });
  }
}

/// Runs of paths that follow each other are taken together.
FollowedPaths FollowedPaths::mergedWith(
  const FollowedPaths& before, const std::vector<std::size_t>& places) const
{
  FollowedPaths merged;
  merged.ends_.reserve(places.size());
  merged.segments_.reserve(before.segments_.size());
  std::size_t next = 0; // of these
  for (std::size_t i = 0; i < places.size();)
  {
    const bool isAnew = places[i] == kAnew;
    const std::size_t first = isAnew ? next : places[i];
    std::size_t count = 1;
    while (i + count < places.size() && places[i + count] == (isAnew ? kAnew : first + count))
    {
      ++count;
    }
    merged.addPaths(isAnew ? *this : before, first, first + count);
    next += isAnew ? count : 0;
    i += count;
  }
  return merged;
}

std::size_t FollowedPaths::bytes() const
{
  return segments_.capacity() * sizeof(PathSegment) + values_.capacity() * sizeof(double) +
    shadows_.capacity() * sizeof(ShadowRay) + ends_.capacity() * sizeof(End);
}

}
