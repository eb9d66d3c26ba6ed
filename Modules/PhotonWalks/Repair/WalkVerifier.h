// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkVerifier_h
#define irradiance_WalkVerifier_h

#include "History/SegmentScan.h"
#include "Repair/StaleMark.h"
#include "Shooting/WalkShooter.h"

#include <atomic>
#include <vector>

namespace irradiance
{

/// The first segment of a walk that the motion changed.
struct StaleSegment
{
  std::uint32_t walkInBlock;
  std::uint32_t bounce;
  Ray ray;
  Hit hit; ///< in the new frame
  Hit old; ///< in the old frame; its distance is valid only if nothing there moved or touches
  /// Whether contacts affect the old hit: then it may differ from that of the static tree alone.
  bool wasTouching = false;
};

/**
 * Finds which stored walks changed, and modifies none. Conservative and exact: after the repair
 * every stored hit is what a cast into the whole new scene finds.
 *
 * Section 3.2 of the paper, sharpened: only the objects that moved are tested, unless the object
 * that was hit has itself moved. A scan flags the segments near moved objects; rays are cast for
 * those alone, many at a time.
 */
class WalkVerifier
{
public:
  /// `moved[i]`: the i-th dynamic object has another pose or shape than in the stored frame. `scan`
  /// flags all segments that these objects may change. `clearance`: a stored segment may end this
  /// far from where it hit, as the next one begins there (see Scene).
  WalkVerifier(const WalkShooter& shooter, const std::vector<bool>& moved, const SegmentScan& scan,
    double clearance)
    : shooter_(shooter)
    , moved_(moved)
    , scan_(scan)
    , clearance_(clearance)
  {
  }

  /// At most one per walk, ordered by walk. `next`: the block to be verified after this one, which
  /// is prefetched, or the same one. `firstWalk`: number of the block's first walk. Walks `known`
  /// to be stale are verified up to their marks.
  std::vector<StaleSegment> staleSegments(const WalkBlock& block, const WalkBlock& next,
    std::uint32_t firstWalk, const StaleMarks& known = {}) const;
  /// The number of segments for which rays were cast so far.
  std::int64_t numberOfSuspects() const { return suspects_; }

private:
  struct Candidates;

  bool hasMoved(const TriangleId& id) const { return id.isDynamic() && moved_[id.object - 1]; }
  void prefetch(const WalkBlock& block, const std::vector<std::uint32_t>& points) const;
  void castBlocked(Candidates& candidates) const;
  void castLost(const WalkBlock& block, Candidates& candidates) const;
  void castTouching(const WalkBlock& block, Candidates& candidates) const;

  const WalkShooter& shooter_;
  const std::vector<bool>& moved_;
  const SegmentScan& scan_;
  double clearance_;
  mutable std::atomic<std::int64_t> suspects_{ 0 };
};

}

#endif
