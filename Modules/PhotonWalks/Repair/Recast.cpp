// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/Recast.h"

namespace irradiance
{

namespace
{

/// What is known of a segment before it is cast.
StaleSegment known(
  const WalkTracer& tracer, const WalkBlock& block, const SegmentRef& segment, const Ray& ray)
{
  const Hit old = block.hit(segment);
  StaleSegment stale{ segment, ray, {}, old, tracer.isTouching(block, segment, old) };
  if (old && !old.id.isDynamic() && !stale.wasTouching)
  {
    stale.old.distance = tracer.scene().distanceTo(ray, old.id);
  }
  return stale;
}

/// The closest static hit along the segment's ray, perhaps none; null if not known.
const Hit* staticHit(const WalkBlock& block, const StaleSegment& stale)
{
  return stale.wasTouching     ? nullptr
    : stale.old.id.isDynamic() ? block.hiddenStaticHit(stale.segment)
                               : &stale.old;
}

}

std::vector<StaleSegment> recast(
  const WalkTracer& tracer, const WalkHistory& history, const std::vector<SegmentRef>& segments)
{
  std::vector<Ray> rays(segments.size());
  tracer.raysOf(history, segments, rays.data());
  std::vector<StaleSegment> stale;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    stale.push_back(known(tracer, history.blockOf(segments[i].walk), segments[i], rays[i]));
  }
  for (const bool isStaticHitKnown : { false, true }) // then only dynamic objects can precede it
  {
    std::vector<std::size_t> which;
    std::vector<Hit> hits;
    rays.clear();
    for (std::size_t i = 0; i < segments.size(); ++i)
    {
      const Hit* hit = staticHit(history.blockOf(segments[i].walk), stale[i]);
      if ((hit != nullptr) == isStaticHitKnown)
      {
        which.push_back(i);
        rays.push_back(stale[i].ray);
        hits.push_back(hit ? *hit : Hit{});
      }
    }
    const Scene& scene = tracer.scene();
    isStaticHitKnown ? scene.castDynamic(rays.data(), rays.size(), hits.data())
                     : scene.cast(rays.data(), rays.size(), hits.data());
    for (std::size_t k = 0; k < which.size(); ++k)
    {
      stale[which[k]].hit = tracer.resolveContact(rays[k], hits[k]);
    }
  }
  return stale;
}

}
