// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/WalkTracer.h"

#include <algorithm>

namespace irradiance
{

void WalkTracer::cast(const Ray* rays, std::size_t count, Hit* hits) const
{
  scene_.cast(rays, count, hits);
  for (std::size_t i = 0; hasContacts() && i < count; ++i)
  {
    hits[i] = contacts_->resolveContact(scene_, rays[i], hits[i]);
  }
}

ScatteredRay WalkTracer::scatteredRayOf(const WalkHistory& history, const SegmentRef& segment) const
{
  const WalkBlock& block = history.blockOf(segment.walk);
  const SegmentRef before{ segment.walk, segment.bounce - 1 };
  const Hit hit = block.hit(before);
  ScatteredRay leaving{ segment.walk, segment.bounce, hit.id, weightsOf(hit),
    block.isFront(before) ? 1.0 : -1.0, {} };
  if (sampler_.isSpecular(hit.id.object))
  {
    leaving.reflection =
      sampler_.reflectionAt(hit.id, segment.walk, segment.bounce, block.power(before));
  }
  return leaving;
}

template <class Set>
void WalkTracer::forEachStart(
  const Segments& segments, const std::vector<std::size_t>& which, const Set& set) const
{
  std::vector<std::uint32_t> walks;
  walks.reserve(which.size());
  for (const std::size_t i : which)
  {
    walks.push_back(segments[i].walk);
  }
  std::vector<Ray> rays(which.size());
  sampler_.start(walks.data(), walks.size(), rays.data());
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    set(which[k], rays[k]);
  }
}

void WalkTracer::originsOf(
  const WalkHistory& history, const Segments& segments, Vector3* origins) const
{
  std::vector<std::size_t> starting;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    if (segments[i].bounce == 0)
    {
      starting.push_back(i);
      continue;
    }
    const ScatteredRay leaving = scatteredRayOf(history, segments[i]);
    SurfacePoint point = surfacePoint(sampler_.triangleOf(leaving.id), leaving.weights);
    point.turn(leaving.side > 0);
    origins[i] = point.clearPosition();
  }
  forEachStart(segments, starting, [&](std::size_t i, const Ray& ray) { origins[i] = ray.origin; });
}

void WalkTracer::arrivalsOf(const WalkHistory& history, const Segments& segments,
  SurfacePoint* points, Vector3* directions) const
{
  originsOf(history, segments, directions);
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const Hit hit = history.hit(segments[i]);
    points[i] = surfacePoint(sampler_.triangleOf(hit.id), weightsOf(hit));
    points[i].turn(history.isFront(segments[i]));
    directions[i] = incomingDirection(points[i], directions[i]);
  }
}

void WalkTracer::raysOf(const WalkHistory& history, const Segments& segments, Ray* rays) const
{
  constexpr std::size_t kAhead = 16;
  ScatteredRays scattered(sampler_);
  std::vector<std::size_t> starting;
  std::vector<ScatteredRay> specular;
  std::vector<Ray*> specularRays;
  Segments before; // the segments that end where those leave
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    const SegmentRef& segment = segments[i];
    if (i + kAhead < segments.size() && segments[i + kAhead].bounce > 0)
    {
      const SegmentRef& later = segments[i + kAhead];
      sampler_.prefetchTriangle(history.hit({ later.walk, later.bounce - 1 }));
    }
    if (segment.bounce == 0)
    {
      starting.push_back(i);
      continue;
    }
    const ScatteredRay leaving = scatteredRayOf(history, segment);
    if (leaving.reflection == Reflection::Diffuse)
    {
      scattered.add(leaving, rays + i);
      continue;
    }
    specular.push_back(leaving);
    specularRays.push_back(rays + i);
    before.push_back({ segment.walk, segment.bounce - 1 });
  }
  std::vector<Vector3> origins(before.size());
  originsOf(history, before, origins.data());
  for (std::size_t i = 0; i < specular.size(); ++i)
  {
    specular[i].from = origins[i];
    scattered.add(specular[i], specularRays[i]);
  }
  scattered.flush();
  forEachStart(segments, starting, [&](std::size_t i, const Ray& ray) { rays[i] = ray; });
}

}
