// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkShooter.h"

#include <algorithm>

namespace irradiance
{

void WalkShooter::cast(const Ray* rays, std::size_t count, Hit* hits) const
{
  scene_.cast(rays, count, hits);
  for (std::size_t i = 0; hasContacts() && i < count; ++i)
  {
    hits[i] = contacts_->settled(scene_, rays[i], hits[i]);
  }
}

void WalkShooter::raysOf(const Stored* segments, std::size_t count, Ray* rays) const
{
  constexpr std::size_t kAhead = 16;
  const auto left = [&](std::size_t i) {
    return segments[i].block->hit(segments[i].walkInBlock, segments[i].bounce - 1);
  };
  Departures departures(rules_);
  std::vector<std::uint32_t> starting;
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Stored& segment = segments[i];
    if (i + kAhead < count && segments[i + kAhead].bounce > 0)
    {
      rules_.prefetchTriangle(left(i + kAhead));
    }
    if (segment.bounce == 0)
    {
      starting.push_back(segment.walk);
      which.push_back(i);
      continue;
    }
    const Hit hit = left(i);
    const bool isFront = segment.block->isFront(segment.walkInBlock, segment.bounce - 1);
    departures.add(
      { segment.walk, segment.bounce, hit.id, weightsOf(hit), isFront ? 1.0 : -1.0, {} }, rays + i);
  }
  departures.flush();
  std::vector<Ray> first(starting.size());
  rules_.start(starting.data(), starting.size(), first.data());
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    rays[which[i]] = first[i];
  }
}

}
