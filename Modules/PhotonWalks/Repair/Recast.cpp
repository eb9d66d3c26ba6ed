// SPDX-License-Identifier: BSD-3-Clause
#include "Repair/Recast.h"

namespace irradiance
{

namespace
{

/// What is known of a segment before it is cast.
StaleSegment known(const WalkShooter& shooter, const WalkShooter::Stored& stored, const Ray& ray)
{
  const Hit old = stored.block->hit(stored.walkInBlock, stored.bounce);
  StaleSegment segment{ stored.walkInBlock, stored.bounce, ray, {}, old, false };
  segment.wasTouching = shooter.isTouching(stored, old);
  if (old && !old.id.isDynamic() && !segment.wasTouching)
  {
    segment.old.distance = shooter.scene().distanceTo(ray, old.id);
  }
  return segment;
}

/// The closest static hit along the segment's ray, perhaps none; null if not known.
const Hit* staticHit(const WalkShooter::Stored& stored, const StaleSegment& segment)
{
  return segment.wasTouching     ? nullptr
    : segment.old.id.isDynamic() ? stored.block->hiddenStaticHit(stored.walkInBlock, stored.bounce)
                                 : &segment.old;
}

}

std::vector<StaleSegment> recast(
  const WalkShooter& shooter, const std::vector<WalkShooter::Stored>& stored)
{
  std::vector<Ray> rays(stored.size());
  shooter.raysOf(stored.data(), stored.size(), rays.data());
  std::vector<StaleSegment> segments;
  for (std::size_t i = 0; i < stored.size(); ++i)
  {
    segments.push_back(known(shooter, stored[i], rays[i]));
  }
  for (const bool isStaticHitKnown : { false, true }) // then only dynamic objects can precede it
  {
    std::vector<std::size_t> which;
    std::vector<Hit> hits;
    rays.clear();
    for (std::size_t i = 0; i < stored.size(); ++i)
    {
      const Hit* hit = staticHit(stored[i], segments[i]);
      if ((hit != nullptr) == isStaticHitKnown)
      {
        which.push_back(i);
        rays.push_back(segments[i].ray);
        hits.push_back(hit ? *hit : Hit{});
      }
    }
    const Scene& scene = shooter.scene();
    isStaticHitKnown ? scene.castDynamic(rays.data(), rays.size(), hits.data())
                     : scene.cast(rays.data(), rays.size(), hits.data());
    for (std::size_t k = 0; k < which.size(); ++k)
    {
      segments[which[k]].hit = shooter.settled(rays[k], hits[k]);
    }
  }
  return segments;
}

}
