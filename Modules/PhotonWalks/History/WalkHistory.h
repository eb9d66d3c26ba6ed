// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkHistory_h
#define irradiance_WalkHistory_h

#include "History/Contribution.h"
#include "Sampling/DealtBlocks.h"
#include "Sampling/WalkPlan.h"

#include <numeric>
#include <vector>

namespace irradiance
{

/// A photon and where it arrived.
struct Photon
{
  SegmentRef reference;
  TriangleId id;
  std::array<float, 2> weights; ///< see Hit
  bool isFront;                 ///< see WalkHistory::isFront
};

/// Photons that left the history or came to it, in any order.
struct PhotonChanges
{
  std::vector<Photon> gone, arrived;

  void add(const PhotonChanges& others)
  {
    gone.insert(gone.end(), others.gone.begin(), others.gone.end());
    arrived.insert(arrived.end(), others.arrived.begin(), others.arrived.end());
  }
};

/// The stored walks of a plan: the blocks that are dealt to this rank. They are counted here.
class WalkHistory
{
public:
  /// Stores nothing.
  WalkHistory() = default;
  /// `frame`, `bands`, `power`: see WalkBlock.
  WalkHistory(const WalkPlan& plan, const UnitFrame& frame, int bands, const Power& power,
    const DealtBlocks& dealt = {})
    : plan_(plan)
    , frame_(frame)
    , bands_(bands)
    , power_(power)
    , dealt_(dealt)
  {
  }
  WalkHistory(WalkHistory&&) = default;
  WalkHistory& operator=(WalkHistory&&) = default;

  const WalkPlan& plan() const { return plan_; }
  /// Of the stored points.
  const UnitFrame& frame() const { return frame_; }

  std::size_t size() const { return blocks_.size(); }
  const WalkBlock& block(std::size_t i) const { return blocks_[i]; }
  WalkBlock& block(std::size_t i) { return blocks_[i]; }
  /// Where the walk is stored.
  std::size_t indexOf(std::uint32_t walk) const { return dealt_.before(plan_.blockOf(walk)); }
  const WalkBlock& blockOf(std::uint32_t walk) const { return blocks_[indexOf(walk)]; }
  WalkBlock& blockOf(std::uint32_t walk) { return blocks_[indexOf(walk)]; }

  /// Adds the next block, whose walks have no segments yet.
  void append()
  {
    const std::size_t number = dealt_[blocks_.size()];
    blocks_.emplace_back(plan_.firstWalkOf(number), plan_.walksIn(number), bands_, frame_, power_);
  }
  void removeLast() { blocks_.pop_back(); }
  void forgetAllStaticHits()
  {
    for (WalkBlock& block : blocks_)
    {
      block.forgetAllStaticHits();
    }
  }
  /// Memory held.
  std::size_t bytes() const
  {
    return std::accumulate(blocks_.begin(), blocks_.end(), std::size_t{},
      [](std::size_t sum, const WalkBlock& block) { return sum + block.bytes(); });
  }

  Power power(const SegmentRef& segment) const { return blockOf(segment.walk).power(segment); }
  /// The hit without its distance.
  Hit hit(const SegmentRef& segment) const { return blockOf(segment.walk).hit(segment); }
  /// Whether it hits the front. Known of all segments only if sides are kept for others, see
  /// WalkBatch.
  bool isFront(const SegmentRef& segment) const { return blockOf(segment.walk).isFront(segment); }

  /// Calls visit(Photon) for each photon that segments of a walk brought, from `first` on, in order.
  template <class Visit>
  void forEachPhotonFrom(const SegmentRef& first, const Visit& visit) const
  {
    visitPhotons(blockOf(first.walk), first, visit);
  }
  /// The same for all walks of a block.
  template <class Visit>
  void forEachPhoton(std::size_t i, const Visit& visit) const
  {
    for (std::uint32_t walk = blocks_[i].firstWalk(); walk < blocks_[i].endWalk(); ++walk)
    {
      visitPhotons(blocks_[i], { walk, 0 }, visit);
    }
  }

private:
  template <class Visit>
  static void visitPhotons(const WalkBlock& block, const SegmentRef& first, const Visit& visit)
  {
    forEachContribution(block, first, block.size(first.walk), [&](const Contribution& brought) {
      visit(Photon{ brought.segment, brought.hit.id, brought.hit.weights, brought.isFront });
    });
  }

  WalkPlan plan_;
  UnitFrame frame_;
  int bands_ = 1;
  Power power_;
  DealtBlocks dealt_;
  std::vector<WalkBlock> blocks_;
};

}

#endif
