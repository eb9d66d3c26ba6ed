// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkVerifier_h
#define irradiance_WalkVerifier_h

#include "History/SegmentScan.h"
#include "Repair/StaleMark.h"
#include "Shooting/WalkTracer.h"

#include <atomic>
#include <vector>

namespace irradiance
{

/// The first segment of a walk that the motion changed.
struct StaleSegment
{
  SegmentRef segment;
  Ray ray;
  Hit hit; ///< in the new frame
  Hit old; ///< in the old frame; its distance is valid only if nothing there moved or touches
  /// Whether contacts affect the old hit: then it may differ from the hit in the static tree alone.
  bool wasTouching = false;
};

/**
 * Finds which stored walks changed, and modifies none. Conservative and exact: after the repair
 * every stored hit is what a cast into the whole new scene finds.
 *
 * Section 3.2 of the paper, sharpened: only the objects that moved are tested, unless the object
 * that was hit has itself moved. A scan flags the segments near moved objects; rays are cast for
 * those alone, many at a time, and for none behind a segment that is certainly stale.
 */
class WalkVerifier
{
public:
  /// `moved[i]`: the i-th dynamic object has another pose or shape than in the stored frame. `scan`
  /// flags all segments that these objects may change. `clearance`: a stored segment may end this
  /// far from where it hit, as the next one begins there (see Scene).
  WalkVerifier(const WalkTracer& tracer, const WalkHistory& history, const std::vector<bool>& moved,
    const SegmentScan& scan, double clearance)
    : tracer_(tracer)
    , history_(history)
    , moved_(moved)
    , scan_(scan)
    , clearance_(clearance)
  {
  }

  /// Of the blocks [first, end): in `stale[block]` at most one segment of each walk, ordered by walk.
  /// Walks `known` to be stale (by block; null: none) are verified up to their marks.
  void find(std::size_t first, std::size_t end, const std::vector<const StaleMarks*>& known,
    std::vector<std::vector<StaleSegment>>& stale) const;
  /// The number of segments for which rays were cast so far.
  std::int64_t numberOfSuspects() const { return suspects_; }

private:
  struct Candidates;
  struct Suspects;

  bool hasMoved(const TriangleId& id) const { return id.isDynamic() && moved_[id.object - 1]; }
  void sort(std::size_t block, const std::vector<std::uint32_t>& points, const StaleMarks* known,
    Suspects& suspects) const;
  void castBlocked(Candidates& candidates) const;
  void castLost(Candidates& candidates) const;
  void castTouching(Candidates& candidates) const;

  const WalkTracer& tracer_;
  const WalkHistory& history_;
  const std::vector<bool>& moved_;
  const SegmentScan& scan_;
  double clearance_;
  mutable std::atomic<std::int64_t> suspects_{ 0 };
};

}

#endif
