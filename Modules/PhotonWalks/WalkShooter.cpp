#include "WalkShooter.h"

#include "DirectionSampling.h"
#include "Reflection.h"

#include <stdexcept>

namespace irradiance
{

void WalkShooter::shoot(std::uint32_t walk, WalkTrace& trace) const
{
  const WalkStart start = emitters_.start(walk, samples_);
  trace.clear();
  follow(walk, 0, { start.ray.origin, start.ray.direction, scene_.cast(start.ray) }, start.power,
    rouletteThreshold(start.power), trace);
}

void WalkShooter::resume(std::uint32_t walk, std::uint32_t bounce, const WalkSegment& segment,
  const Power& first, const Power& incoming, WalkTrace& trace) const
{
  trace.clear();
  follow(walk, bounce, segment, incoming, rouletteThreshold(first), trace);
}

Ray WalkShooter::storedRay(
  const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk, std::uint32_t bounce) const
{
  const WalkSegment& segment = block.segment(walkInBlock, bounce);
  return { segment.origin, segment.direction,
    bounce > 0 ? block.segment(walkInBlock, bounce - 1).hit.id
               : emitters_.start(walk, samples_).ray.start };
}

void WalkShooter::follow(std::uint32_t walk, std::uint32_t bounce, WalkSegment segment, Power power,
  std::int64_t threshold, WalkTrace& trace) const
{
  while (segment.hit)
  {
    const TriangleId id = segment.hit.id;
    const SurfacePoint point =
      scene_.surfaceAt(segment.direction, segment.hit);
    trace.add(segment, power, point.isFront);

    ++bounce;
    power = reflected(power, *objects_[id.object].surface, id.triangle);
    if (power.largest() < threshold)
    {
      power = playRoulette(power, threshold, samples_.sample(walk, bounce, SampleUse::Roulette)[0]);
    }
    if (power.isZero())
    {
      return;
    }
    if (bounce > kMostBounces)
    {
      throw std::runtime_error("walk " + std::to_string(walk) +
        " does not end: the light cannot leave a part of the scene that absorbs nothing "
        "(reflectance 1)");
    }
    const Ray ray{ point.clearPosition(),
      sampleCosineHemisphere(point.normal, samples_.sample(walk, bounce, SampleUse::Direction)),
      id };
    segment = { ray.origin, ray.direction, scene_.cast(ray) };
  }
  trace.add(segment, power, true);
}

}
