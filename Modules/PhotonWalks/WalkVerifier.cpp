#include "WalkVerifier.h"

namespace irradiance
{

std::optional<StaleSegment> WalkVerifier::firstStaleSegment(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk) const
{
  for (std::uint32_t bounce = 0; bounce < block.size(walkInBlock); ++bounce)
  {
    const WalkSegment& segment = block.segment(walkInBlock, bounce);
    const Hit& old = segment.hit;
    if (hasMoved(old))
    {
      const Ray ray = shooter_.storedRay(block, walkInBlock, walk, bounce);
      return StaleSegment{ walkInBlock, bounce,
        hitBehindMovedObject(ray, old, block.hiddenStaticHit(walkInBlock, bounce)) };
    }
    // The hit stands where it stood: valid, unless a moved object came in front of it.
    {
      const Hit now = scene_.castMoved(shooter_.storedRay(block, walkInBlock, walk, bounce), old);
      if (now != old)
      {
        return StaleSegment{ walkInBlock, bounce, now };
      }
    }
  }
  return std::nullopt;
}

/// The object that was hit moved, so the hit is stale even where the same triangle is found again:
/// its normal and the point on it have changed.
Hit WalkVerifier::hitBehindMovedObject(
  const Ray& ray, const Hit& old, const Hit* hiddenStaticHit) const
{
  const Hit dynamic = scene_.castDynamic(ray, {});
  if (!isCloser(old, dynamic))
  {
    return dynamic; // the static geometry is known to lie behind the old hit
  }
  if (hiddenStaticHit)
  {
    return isCloser(*hiddenStaticHit, dynamic) ? *hiddenStaticHit : dynamic;
  }
  return scene_.castStatic(ray, dynamic, old.distance);
}

}
