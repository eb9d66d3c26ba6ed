// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkBatch_h
#define irradiance_WalkBatch_h

#include "Shooting/WalkTracer.h"
#include "Tally/WalkTally.h"

#include <functional>
#include <vector>

namespace irradiance
{

/// Shoots many walks side by side, bounce by bounce: each stage of a bounce is a loop over the walks
/// that go on.
class WalkBatch
{
public:
  /// `storedIn`: the frame of the blocks to which store() will write; null if nothing is stored.
  /// `storesSides`: the sides of all hits are stored; else, if the tally does not need them, only of
  /// those that walks leave.
  WalkBatch(const WalkTracer& tracer, const UnitFrame* storedIn, bool storesSides = false);

  /// Adds whole walks.
  void shoot(const std::vector<std::uint32_t>& walks);
  /// Adds a walk from segment `first` on, whose ray and new hit are known. `incoming`: what the
  /// segment carries.
  void resume(const SegmentRef& first, const Ray& ray, const Hit& hit, const Power& incoming);

  /// Shoots until all walks have ended. If `hasToStop` returns true between two bounces, it returns
  /// false and may be called again.
  bool run(WalkTally& tally, const std::function<bool()>& hasToStop);

  /// Segments shot so far.
  std::int64_t numberOfSegments() const { return segments_; }
  /// Power with which the walks added by shoot() started.
  const Power& emitted() const { return emitted_; }

  struct Tail
  {
    SegmentRef first;
    std::uint32_t size; ///< segments
  };
  /// In the order in which the walks were added.
  const std::vector<Tail>& tails() const { return tails_; }
  /// The numbers of segments of the tails.
  std::vector<std::uint32_t> sizes() const;
  /// Replaces the stored tails of the walks by what was shot.
  void store(WalkHistory& history) const;

private:
  /// A walk that needs more is in a closed scene that absorbs nothing: it would never end.
  static constexpr std::uint32_t kMostBounces = 1u << 20;
  /// After this many rounds the few walks that are left are finished kPatient at a time, so that it
  /// shows soon if they are endless.
  static constexpr std::uint32_t kRoundsTogether = 256;
  static constexpr std::size_t kPatient = 2;

  /// A segment to be stored.
  struct Piece
  {
    std::uint32_t tail;
    StoredSegment segment;
  };
  /// The point where a walk ended.
  struct End
  {
    std::uint32_t tail;
    StoredPoint point;
  };

  void reserve(std::size_t walks);
  void addTail(const SegmentRef& first);
  /// Whether the front was hit; true if sides are not kept apart.
  bool isFront(std::size_t placeOfBounce) const
  {
    return isFront_.empty() || isFront_[placeOfBounce] != 0;
  }
  // The stages of a bounce, for the walks from place `first` on.
  void findCells(std::size_t first, WalkTally& tally);
  void findSides(std::size_t first);
  void receive(std::size_t first, WalkTally& tally);
  void record(std::size_t first);
  void absorb(std::size_t first);
  void leave(std::size_t first, WalkTally& tally);
  void checkEnd(std::size_t place) const;

  const WalkTracer& tracer_;
  const UnitFrame* frame_;
  bool storesSides_;
  // Of the walks that go on, by place.
  std::vector<std::uint32_t> tailOf_, walks_, bounces_;
  std::vector<Power> powers_; ///< empty if there is one band
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  // Of the walks of this bounce, by place - first.
  std::vector<std::uint32_t> cells_;
  std::vector<std::size_t> slots_; ///< where the tally adds their photons
  std::vector<double> probabilities_;
  std::vector<char> isFront_; ///< empty if sides are not kept apart
  std::vector<std::uint32_t> survivors_;
  std::vector<char> isSurvivor_;

  bool areHitsKnown_ = false;
  std::uint32_t rounds_ = 0;
  std::int64_t segments_ = 0;
  Power emitted_;
  std::vector<Tail> tails_;
  std::vector<Piece> pieces_; ///< in order within a walk; pieces of several walks are mixed
  std::vector<Power> piecePowers_;
  std::vector<End> ends_;
};

}

#endif
