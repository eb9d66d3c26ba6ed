#ifndef ShotWalk_h
#define ShotWalk_h

#include "WalkBatch.h"

namespace irradiance::test
{

/// The segments of one walk, shot alone.
inline std::vector<WalkSegment> shotWalk(
  const WalkShooter& shooter, const SceneObjects& objects, std::uint32_t walk)
{
  CellSums sums(objects, 1);
  PowerBalance balance;
  WalkBooking booking(sums, balance);
  WalkBatch batch(shooter);
  batch.shoot(walk);
  batch.run(booking, [] { return false; });
  batch.tails();
  return batch.segments();
}

}

#endif
