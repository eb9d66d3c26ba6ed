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

Departure WalkShooter::departureOf(const Stored& segment) const
{
  const WalkBlock& block = *segment.block;
  const std::uint32_t before = segment.bounce - 1;
  const Hit hit = block.hit(segment.walkInBlock, before);
  Departure departure{ segment.walk, segment.bounce, hit.id, weightsOf(hit),
    block.isFront(segment.walkInBlock, before) ? 1.0 : -1.0, {} };
  if (rules_.isSpecular(hit.id.object))
  {
    departure.reflection = rules_.reflectionAt(
      hit.id, segment.walk, segment.bounce, block.power(segment.walkInBlock, before));
  }
  return departure;
}

template <class Set>
void WalkShooter::forEachStart(
  const Stored* segments, const std::vector<std::size_t>& which, const Set& set) const
{
  std::vector<std::uint32_t> walks;
  walks.reserve(which.size());
  for (const std::size_t i : which)
  {
    walks.push_back(segments[i].walk);
  }
  std::vector<Ray> rays(which.size());
  rules_.start(walks.data(), walks.size(), rays.data());
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    set(which[k], rays[k]);
  }
}

void WalkShooter::originsOf(const Stored* segments, std::size_t count, Vector3* origins) const
{
  std::vector<std::size_t> starting;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (segments[i].bounce == 0)
    {
      starting.push_back(i);
      continue;
    }
    const Departure departure = departureOf(segments[i]);
    SurfacePoint point = surfacePoint(rules_.triangleOf(departure.id), departure.weights);
    point.turn(departure.side > 0);
    origins[i] = point.clearPosition();
  }
  forEachStart(segments, starting, [&](std::size_t i, const Ray& ray) { origins[i] = ray.origin; });
}

void WalkShooter::arrivalsOf(
  const Stored* segments, std::size_t count, SurfacePoint* points, Vector3* directions) const
{
  originsOf(segments, count, directions);
  for (std::size_t i = 0; i < count; ++i)
  {
    const WalkBlock& block = *segments[i].block;
    const Hit hit = block.hit(segments[i].walkInBlock, segments[i].bounce);
    points[i] = surfacePoint(rules_.triangleOf(hit.id), weightsOf(hit));
    points[i].turn(block.isFront(segments[i].walkInBlock, segments[i].bounce));
    directions[i] = incomingDirection(points[i], directions[i]);
  }
}

void WalkShooter::raysOf(const Stored* segments, std::size_t count, Ray* rays) const
{
  constexpr std::size_t kAhead = 16;
  Departures departures(rules_);
  std::vector<std::size_t> starting;
  std::vector<Departure> specular;
  std::vector<Ray*> specularRays;
  std::vector<Stored> before; // the segments that end where those leave
  for (std::size_t i = 0; i < count; ++i)
  {
    const Stored& segment = segments[i];
    if (i + kAhead < count && segments[i + kAhead].bounce > 0)
    {
      const Stored& later = segments[i + kAhead];
      rules_.prefetchTriangle(later.block->hit(later.walkInBlock, later.bounce - 1));
    }
    if (segment.bounce == 0)
    {
      starting.push_back(i);
      continue;
    }
    const Departure departure = departureOf(segment);
    if (departure.reflection == Reflection::Diffuse)
    {
      departures.add(departure, rays + i);
      continue;
    }
    specular.push_back(departure);
    specularRays.push_back(rays + i);
    before.push_back({ segment.block, segment.walkInBlock, segment.walk, segment.bounce - 1 });
  }
  std::vector<Vector3> origins(before.size());
  originsOf(before.data(), before.size(), origins.data());
  for (std::size_t i = 0; i < specular.size(); ++i)
  {
    specular[i].from = origins[i];
    departures.add(specular[i], specularRays[i]);
  }
  departures.flush();
  forEachStart(segments, starting, [&](std::size_t i, const Ray& ray) { rays[i] = ray; });
}

}
