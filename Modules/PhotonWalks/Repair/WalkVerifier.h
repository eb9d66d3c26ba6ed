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
  Hit old; ///< in the old one, if that was static or nowhere
  /// Whether other triangles coincided with the old hit: then it is not that of the static tree alone.
  bool wasTouching = false;
};

/**
 * Says which stored walks changed, and touches nothing. Conservative and exact: after the repair
 * every stored hit is what a cast into the whole new scene finds.
 *
 * Section 3.2 of the paper, sharpened: only the objects that moved are looked at, unless the object
 * that was hit has moved itself. A scan names the segments near moved objects; rays are cast for
 * those alone, many at a time.
 */
class WalkVerifier
{
public:
  /// `moved[i]`: the i-th dynamic object has another pose or shape than in the stored frame. `scan`
  /// names all segments that these objects may change. `clearance`: a stored segment may end this
  /// far from where it hit, as the next one begins there (see Scene).
  WalkVerifier(const WalkShooter& shooter, const std::vector<bool>& moved, const SegmentScan& scan,
    double clearance)
    : shooter_(shooter)
    , moved_(moved)
    , scan_(scan)
    , clearance_(clearance)
  {
  }

  /// At most one for each walk, ordered by walk. `next`: the block that will be asked for after it,
  /// or the same; `firstWalk`: the number of the block's first walk. Walks that are `known` to be
  /// stale are looked at up to there.
  std::vector<StaleSegment> staleSegments(const WalkBlock& block, const WalkBlock& next,
    std::uint32_t firstWalk, const StaleMarks& known = {}) const;
  /// Segments of which rays were cast so far.
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
