// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShotWalk_h
#define ShotWalk_h

#include "Shooting/WalkBatch.h"

namespace irradiance::test
{

/// One straight segment of a walk, and the hit that ends it. The last one may escape.
struct WalkSegment
{
  Ray ray; ///< its direction is a unit vector
  Hit hit;
  Power power; ///< what it carries to its hit
  bool isFront = true;
};

/// The segments of one walk, shot alone.
inline std::vector<WalkSegment> shotWalk(
  const WalkTracer& tracer, const SceneObjects& objects, std::uint32_t walk)
{
  CellSums sums(objects, 1);
  PowerBalance balance;
  WalkTally tally(sums, balance);
  const UnitFrame frame(tracer.scene().bounds());
  const WalkPlan plan;
  WalkBatch batch(tracer, &frame);
  batch.shoot({ walk });
  batch.run(tally, [] { return false; });
  WalkHistory history(plan, frame, tracer.sampler().bands(), tracer.sampler().powerPerWalk(),
    DealtBlocks(plan.blockOf(walk), plan.blockOf(walk) + 1)); // begins with the walk's block
  history.append();
  batch.store(history);
  std::vector<WalkSegment> segments(history.block(0).size(walk));
  for (std::uint32_t bounce = 0; bounce < segments.size(); ++bounce)
  {
    WalkSegment& segment = segments[bounce];
    const SegmentRef stored{ walk, bounce };
    tracer.raysOf(history, { stored }, &segment.ray);
    segment.hit = history.hit(stored);
    if (segment.hit)
    {
      segment.hit.distance = tracer.scene().distanceTo(segment.ray, segment.hit.id);
    }
    segment.power = history.power(stored);
    segment.isFront = history.isFront(stored);
  }
  return segments;
}

/// Replaces the segments of a walk from `place` on by `tail`. `frame`: of the block, with `bands`.
inline void replaceTail(WalkBlock& block, SegmentRef place, const std::vector<WalkSegment>& tail,
  const UnitFrame& frame, int bands = 1)
{
  block.replaceTail(place, static_cast<std::uint32_t>(tail.size()));
  for (const WalkSegment& segment : tail)
  {
    const Ray& ray = segment.ray;
    const Hit& hit = segment.hit;
    block.setSegment(
      place, { storedPoint(frame, ray.origin), hit.id, hit.weights, segment.isFront, false });
    if (bands > 1)
    {
      block.setPower(place, segment.power);
    }
    ++place.bounce;
  }
  const WalkSegment& last = tail.back();
  const double length = last.hit ? last.hit.distance : WalkBlock::kFar / frame.scale;
  block.setEnd(place.walk, storedPoint(frame, last.ray.origin + length * last.ray.direction));
}

}

#endif
