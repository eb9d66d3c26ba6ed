// SPDX-License-Identifier: BSD-3-Clause
#ifndef ShotWalk_h
#define ShotWalk_h

#include "Shooting/WalkBatch.h"

namespace irradiance::test
{

/// The segments of one walk, shot alone.
inline std::vector<WalkSegment> shotWalk(
  const WalkShooter& shooter, const SceneObjects& objects, std::uint32_t walk)
{
  CellSums sums(objects, 1);
  PowerBalance balance;
  WalkTally tally(sums, balance);
  WalkBatch batch(shooter);
  batch.shoot(walk);
  batch.run(tally, [] { return false; });
  std::vector<WalkSegment> segments;
  for (const WalkBatch::Piece& piece : batch.pieces())
  {
    segments.push_back(piece.segment);
  }
  return segments;
}

/// Replaces the segments of a walk from `bounce` on by `tail`.
inline void replaceTail(
  WalkBlock& block, std::uint32_t walk, std::uint32_t bounce, const std::vector<WalkSegment>& tail)
{
  block.replaceTail(walk, bounce, static_cast<std::uint32_t>(tail.size()));
  for (const WalkSegment& segment : tail)
  {
    block.setSegment(walk, bounce++, segment);
  }
}

}

#endif
