// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Shooting/WalkTracer.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// Appends a stored segment to a front, as FrontTally::remove() reads it: walk, hit, hitSide and
/// powers.
void addStored(const BounceBlock& block, std::uint32_t slot, int bands, WalkFront& front);

/**
 * Finds the rays of stored segments again, with the bits with which they were shot, unless they
 * start on what has moved. A ray follows from the hit before it, or from the number of its walk.
 *
 * Owns the memory that this takes: keep one for each thread.
 */
class StoredRays
{
public:
  /// Rows name segments by block and slot. Writes walk, bounce, parent, the ray, and the stored hit
  /// with its weights and its side; not the distance.
  void find(const WalkTracer& tracer, const WalkHistory& history, WalkFront& front);

  /// The rays of segments, one for each.
  void find(const WalkTracer& tracer, const WalkHistory& history,
    const std::vector<SegmentRef>& segments, Ray* rays);

private:
  /// Only origins are of use if `isOnlyOrigins`: no directions of walks that leave sharply are
  /// computed.
  void find(
    const WalkTracer& tracer, const WalkHistory& history, WalkFront& front, bool isOnlyOrigins);
  void readStarts(const WalkHistory& history, WalkFront& front);
  void findWays(
    const WalkTracer& tracer, const WalkHistory& history, WalkFront& front, bool isOnlyOrigins);
  void findOriginsBefore(const WalkTracer& tracer, const WalkHistory& history, WalkFront& front);
  void findFirst(const WalkTracer& tracer, WalkFront& front);

  WalkFront named_, first_;
  std::vector<std::uint32_t> firstRows_, sharpRows_;
  std::unique_ptr<StoredRays> before_; ///< finds the origins of segments before
};

}
