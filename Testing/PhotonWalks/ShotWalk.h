// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "BounceFront.h"
#include "Shooting/StoredRays.h"
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
  CellSums sums(objects);
  PowerBalance balance;
  const WalkPlan plan;
  const int bands = tracer.stages().bands();
  WalkHistory history(plan, PointGrid(tracer.scene().bounds()), tracer.triangles().numbers(), bands,
    tracer.stages().powerPerWalk(), std::make_shared<BlockArena>(BounceBlock::pageBytes(bands)),
    DealtBlocks(plan.blockOf(walk), plan.blockOf(walk) + 1)); // begins with the walk's block
  history.append();
  WalkBatch batch;
  batch.begin(tracer, &history);
  batch.front().reserve(1, bands);
  batch.front().size = 1;
  batch.front().walk[0] = walk;
  batch.front().block[0] = 0;
  FrontTally tally(tracer.triangles(), sums, balance, tracer.stages().powerPerWalk(), 1);
  batch.start(tally);
  batch.run(tally, [] { return false; });
  const BounceBlock& block = history.block(0);
  std::vector<WalkSegment> segments(block.bounceOf(block.lastOf(walk)) + 1);
  StoredRays rays;
  for (std::uint32_t bounce = 0; bounce < segments.size(); ++bounce)
  {
    WalkSegment& segment = segments[bounce];
    const SegmentRef stored{ walk, bounce };
    rays.find(tracer, history, { stored }, &segment.ray);
    segment.hit = history.hit(stored);
    if (segment.hit)
    {
      segment.hit.distance = tracer.scene().hitOf(segment.ray, segment.hit.id).distance;
    }
    segment.power = history.power(stored);
    segment.isFront = block.isFront(block.slotOf(stored));
  }
  return segments;
}

/// Stores a walk that has no segments yet.
inline void storeWalk(
  WalkHistory& history, std::uint32_t walk, const std::vector<WalkSegment>& segments)
{
  std::uint32_t parent = BounceBlock::kNone;
  for (const WalkSegment& segment : segments)
  {
    BounceFront front;
    BounceSegment stored;
    stored.origin = segment.ray.origin;
    stored.direction = segment.ray.direction.cast<float>();
    stored.distance = segment.hit ? segment.hit.distance : kInfinity;
    stored.walk = walk;
    stored.parent = parent;
    stored.triangle = history.numbers().numberOf(segment.hit.id);
    stored.weights = segment.hit.weights;
    stored.isFront = segment.isFront;
    stored.power = segment.power;
    front.add(stored);
    history.block(history.indexOf(walk)).append(front.columns(), 0, 1, &parent);
  }
}

}
