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
  const WalkShooter& shooter, const SceneObjects& objects, std::uint32_t walk)
{
  CellSums sums(objects, 1);
  PowerBalance balance;
  WalkTally tally(sums, balance);
  const UnitFrame frame(shooter.scene().bounds());
  const WalkPlan plan;
  const WalkPlan::Place place = plan.placeOf(walk);
  WalkBatch batch(shooter, &frame);
  batch.shoot({ walk });
  batch.run(tally, [] { return false; });
  std::vector<WalkBlock> history;
  for (std::size_t block = 0; block <= place.block; ++block)
  {
    history.emplace_back(block < place.block ? 0 : WalkPlan::kWalksPerBlock,
      shooter.rules().bands(), frame, shooter.rules().photon());
  }
  batch.store(plan, history);
  const WalkBlock& block = history.back();
  std::vector<WalkSegment> segments(block.size(place.walkInBlock));
  for (std::uint32_t bounce = 0; bounce < segments.size(); ++bounce)
  {
    WalkSegment& segment = segments[bounce];
    const WalkShooter::Stored stored{ &block, place.walkInBlock, walk, bounce };
    shooter.raysOf(&stored, 1, &segment.ray);
    segment.hit = block.hit(place.walkInBlock, bounce);
    if (segment.hit)
    {
      segment.hit.distance = shooter.scene().distanceTo(segment.ray, segment.hit.id);
    }
    segment.power = block.power(place.walkInBlock, bounce);
    segment.isFront = block.isFront(place.walkInBlock, bounce);
  }
  return segments;
}

/// Replaces the segments of a walk from `bounce` on by `tail`. `frame`: of the block, with `bands`.
inline void replaceTail(WalkBlock& block, std::uint32_t walk, std::uint32_t bounce,
  const std::vector<WalkSegment>& tail, const UnitFrame& frame, int bands = 1)
{
  block.replaceTail(walk, bounce, static_cast<std::uint32_t>(tail.size()));
  for (const WalkSegment& segment : tail)
  {
    const Ray& ray = segment.ray;
    const Hit& hit = segment.hit;
    block.setSegment(walk, bounce,
      { storedPoint(frame, ray.origin), hit.id, hit.weights, segment.isFront, false });
    if (bands > 1)
    {
      block.setPower(walk, bounce, segment.power);
    }
    ++bounce;
  }
  const WalkSegment& last = tail.back();
  const double length = last.hit ? last.hit.distance : WalkBlock::kFar / frame.scale;
  block.setEnd(walk, storedPoint(frame, last.ray.origin + length * last.ray.direction));
}

}

#endif
