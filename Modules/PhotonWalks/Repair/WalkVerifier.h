// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BounceScan.h"
#include "Repair/ChangedReflections.h"
#include "Repair/StaleWalks.h"
#include "Shooting/StoredRays.h"

#include <atomic>
#include <vector>

namespace irradiance
{

/**
 * Finds which stored walks changed, and modifies none. Conservative and exact: after the repair
 * every stored hit is what a cast into the whole new scene finds.
 *
 * Section 3.2 of the paper, sharpened: only the objects that moved are tested, unless the object
 * that was hit has itself moved. A scan flags the segments near moved objects; rays are cast for
 * those alone, many at a time, and for none behind a segment that is certainly stale. A segment
 * whose hit reflects the walk otherwise is stale as well: all after it are shot again.
 */
class WalkVerifier
{
public:
  /// `moved[i]`: the i-th dynamic object has another pose or shape than in the stored frame. `scan`
  /// flags all segments that these objects may change, or parts that came. `kept`: hits on all other
  /// parts are lost, see BounceBlock. `cachesStaticHits`: see HiddenHit.
  WalkVerifier(const WalkTracer& tracer, const WalkHistory& history, const std::vector<bool>& moved,
    const BounceScan& scan, const ChangedReflections& reflections, const KeptParts& kept,
    bool cachesStaticHits);

  /// The memory of one thread.
  class Memory
  {
  public:
    /// Of each stale segment, if static hits are cached: the one that a dynamic object hides in the
    /// new frame.
    std::vector<HiddenHit> hidden;

  private:
    friend class WalkVerifier;

    /// Segments for which rays are cast in the same way, row by row.
    struct Suspects
    {
      WalkFront rows;
      /// Of each row: the static hit that a dynamic object hides, or would hide.
      std::vector<HiddenHit> known;
    };

    void clear()
    {
      for (Suspects* const suspects : all())
      {
        suspects->rows.size = 0;
        suspects->known.clear();
      }
    }
    /// Any of them may get all.
    void reserve(std::size_t more, int bands)
    {
      for (Suspects* const suspects : all())
      {
        suspects->rows.reserve(suspects->rows.size + more, bands);
      }
    }
    std::array<Suspects*, 3> all() { return { &blocked, &lost, &uncovered }; }

    Suspects blocked, lost, uncovered;
    std::vector<std::vector<std::uint32_t>> slots; ///< that the scan flagged, by block
    std::vector<std::uint32_t> firstStale;         ///< bounce, by walk
    WalkFront::Rows chosen;
    StoredRays rays;
    FrontCast cast;
  };

  /// The first stale segments of walks of the blocks [first, end), block by block, with their rays
  /// and their hits in the new frame. Slots and blocks are where the old segments are stored. Walks
  /// `known` to be stale (by block; null: none) are verified up to their marks.
  void find(std::size_t first, std::size_t end, const std::vector<const StaleMarks*>& known,
    Memory& memory, WalkFront& stale) const;
  /// The same for segments that are known to be stale, by block: their hits in the new frame. A hit
  /// that was found in an earlier frame may have changed since, but the ray has not. `areLost`:
  /// nothing is known of the hits.
  void castAgain(
    const std::vector<SegmentPlace>& places, bool areLost, Memory& memory, WalkFront& stale) const;
  /// The number of segments for which rays were cast so far, and of walks that were found.
  std::int64_t numberOfSuspects() const { return suspects_; }
  std::int64_t numberFound() const { return found_; }

private:
  using Suspects = Memory::Suspects;

  bool hasMoved(std::uint32_t triangle) const
  {
    return triangle - firstDynamic_ < hasMoved_.size() && hasMoved_[triangle - firstDynamic_] != 0;
  }
  bool isDynamic(std::uint32_t triangle) const
  {
    return triangle >= firstDynamic_ && triangle != WalkFront::kNone;
  }
  void sort(std::size_t number, std::vector<std::uint32_t>& slots, const StaleMarks* known,
    std::uint32_t* firstStale, Memory& memory) const;
  /// `isLost`: nothing is known of the new hit.
  void add(std::size_t number, std::uint32_t slot, bool isLost, Memory& memory) const;
  bool isTouching(const BounceBlock& block, std::uint32_t slot) const;
  /// Finds the rays of all suspects, and their hits. `byAllDynamic`: a blocked ray may hit any
  /// dynamic object, not only those that moved.
  void cast(Memory& memory, bool byAllDynamic) const;
  void noteFirst(std::size_t firstBlock, Memory& memory) const;
  /// Where objects touch, the hit may be the same and yet depend on other objects than before: then
  /// it is stored again as well.
  bool isChanged(const WalkFront& rows, std::size_t row) const
  {
    const BounceBlock& block = history_.block(rows.block[row]);
    const std::uint32_t slot = rows.slot[row], hit = rows.hit[row];
    const std::array<float, 2> weights{ rows.weightB[row], rows.weightC[row] };
    return hit != block.triangle(slot) || weights != block.weights(slot) || hasMoved(hit) ||
      tracer_.isContact(rows.start[row], hit) != block.isContact(slot);
  }
  /// The walk of a row, counted from the first of the first block.
  std::size_t walkAt(const WalkFront& rows, std::size_t row, std::size_t firstBlock) const
  {
    return (rows.block[row] - firstBlock) * WalkPlan::kWalksPerBlock +
      (rows.walk[row] - history_.block(rows.block[row]).firstWalk());
  }
  /// Takes the rows for which isChosen(rows, row) is true, block by block.
  template <class IsChosen>
  void choose(Memory& memory, const IsChosen& isChosen, WalkFront& stale) const;

  const WalkTracer& tracer_;
  const WalkHistory& history_;
  const BounceScan& scan_;
  const ChangedReflections& reflections_;
  const KeptParts& kept_;
  bool cachesStaticHits_;
  std::uint32_t firstDynamic_;         ///< triangle
  std::vector<std::uint8_t> hasMoved_; ///< by dynamic triangle
  mutable std::atomic<std::int64_t> suspects_{ 0 }, found_{ 0 };
};

}
