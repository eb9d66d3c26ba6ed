// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BounceBlock.h"
#include "Sampling/WalkPlan.h"
#include "Scene/TriangleNumbers.h"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

namespace irradiance
{

/// A photon and where it arrived.
struct Photon
{
  SegmentRef reference;
  TriangleId id;
  std::array<float, 2> weights; ///< see Hit
  bool isFront;                 ///< the side that was hit
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

/// Where a segment is stored: the block, counted in its history, and the slot there.
struct SegmentPlace
{
  std::size_t block;
  std::uint32_t slot;
};

/// The closest static hit along the ray of a segment that ends before it, on a dynamic object. The
/// cache of these (section 3.3 of the paper) keeps a hit as long as a dynamic object hides it; when
/// the object has moved away, the static tree need not be searched.
struct HiddenHit
{
  static constexpr std::uint32_t kUnknown = 0xfffffffeu; ///< not TriangleId::kNone, which is known

  double distance = kInfinity;
  std::uint32_t triangle = kUnknown; ///< kNone if nothing static is hit
  float weights[2] = { 0, 0 };

  bool isKnown() const { return triangle != kUnknown; }
};

/**
 * The stored walks of a plan: the blocks that are dealt to this rank. They are counted here.
 *
 * What is stored of a segment is what cannot be computed again: the triangle hit, its side, the
 * point on it and the power. Rays and distances follow from these, see StoredRays.
 */
class WalkHistory
{
public:
  /// Stores nothing.
  WalkHistory() = default;
  /// `numbers`: of the triangles. `arena`: with pages for so many `bands`. `grid`, `power`: see
  /// BounceBlock.
  WalkHistory(const WalkPlan& plan, const PointGrid& grid, const TriangleNumbers& numbers,
    int bands, const Power& power, std::shared_ptr<BlockArena> arena, const DealtBlocks& dealt = {})
    : plan_(plan)
    , grid_(grid)
    , numbers_(numbers)
    , bands_(bands)
    , power_(power)
    , dealt_(dealt)
    , arena_(std::move(arena))
  {
  }
  WalkHistory(WalkHistory&&) noexcept = default;
  /// What is stored goes first: its blocks are pages of the arena of before.
  WalkHistory& operator=(WalkHistory&& other) noexcept
  {
    this->~WalkHistory();
    return *new (this) WalkHistory(std::move(other));
  }
  ~WalkHistory() = default;

  const WalkPlan& plan() const { return plan_; }
  const PointGrid& grid() const { return grid_; }
  const TriangleNumbers& numbers() const { return numbers_; }
  int bands() const { return bands_; }
  /// Of all segments, if there is one band.
  const Power& powerPerWalk() const { return power_; }

  std::size_t size() const { return blocks_.size(); }
  const BounceBlock& block(std::size_t i) const { return blocks_[i]; }
  BounceBlock& block(std::size_t i) { return blocks_[i]; }
  /// Where the walk is stored.
  std::size_t indexOf(std::uint32_t walk) const { return dealt_.before(plan_.blockOf(walk)); }
  SegmentPlace placeOf(const SegmentRef& segment) const
  {
    const std::size_t block = indexOf(segment.walk);
    return { block, blocks_[block].slotOf(segment) };
  }

  /// Changes to a plan that has more rounds.
  void extend(const WalkPlan& plan) { plan_ = plan; }
  /// Changes to a plan with other walks after those that are stored, which if there is one band now
  /// have this power.
  void replan(const WalkPlan& plan, const Power& power)
  {
    plan_ = plan;
    power_ = power;
    for (BounceBlock& block : blocks_)
    {
      block.setPower(power);
    }
  }
  /// Adds the next block, whose walks have no segments yet.
  void append()
  {
    if (blocks_.empty())
    {
      makeKinds();
    }
    const std::size_t number = dealt_[blocks_.size()];
    blocks_.emplace_back(
      *arena_, plan_.firstWalkOf(number), plan_.walksIn(number), bands_, grid_, power_);
    hidden_.emplace_back();
  }
  void removeLast()
  {
    blocks_.pop_back();
    hidden_.pop_back();
  }
  /// Changes to other numbers of the same triangles. No stored walk has hit those that are gone.
  /// `kept`: by triangle the number that it has now; empty: its object has the same triangles.
  void renumber(const TriangleNumbers& numbers, const std::vector<std::uint32_t>& kept = {})
  {
    if (numbers == numbers_ && kept.empty())
    {
      return;
    }
    // The numbers of static triangles, which come first, stay unless others are told; so hidden hits
    // do.
    for (BounceBlock& block : blocks_)
    {
      block.renumber([&](std::uint32_t triangle) {
        return kept.empty() ? numbers.numberOf(numbers_.idOf(triangle)) : kept[triangle];
      });
    }
    numbers_ = numbers;
    makeKinds();
  }

  /// Sets the kinds of these hits, see BounceColumns; kContact is for the caller to set.
  void setKinds(const std::uint32_t* triangles, std::size_t count, std::uint8_t* kinds) const
  {
    const std::uint32_t known = numbers_.size();
    std::transform(triangles, triangles + count, kinds, [this, known](std::uint32_t triangle) {
      return triangle < known ? kinds_[triangle] : std::uint8_t{ 0 };
    });
  }
  /// Removes this segment and all after it of its walk. Calls visit(slot) for each before.
  template <class Visit>
  void removeFrom(const SegmentPlace& first, const Visit& visit)
  {
    auto& hidden = hidden_[first.block];
    blocks_[first.block].removeFrom(first.slot, [&](std::uint32_t slot) {
      visit(slot);
      if (!hidden.empty())
      {
        hidden.erase(slot);
      }
    });
  }

  /// What the cache knows of a segment.
  HiddenHit hidden(const SegmentPlace& place) const
  {
    const auto found = hidden_[place.block].find(place.slot);
    return found == hidden_[place.block].end() ? HiddenHit{} : found->second;
  }
  void setHidden(const SegmentPlace& place, const HiddenHit& hit)
  {
    hidden_[place.block][place.slot] = hit;
  }
  void forgetHiddenHits()
  {
    for (auto& hidden : hidden_)
    {
      hidden.clear();
    }
  }

  /// Memory held.
  std::size_t bytes() const
  {
    std::size_t bytes = kinds_.capacity();
    for (std::size_t i = 0; i < blocks_.size(); ++i)
    {
      bytes += blocks_[i].bytes() + hidden_[i].bucket_count() * sizeof(void*) +
        hidden_[i].size() * (sizeof(std::pair<const std::uint32_t, HiddenHit>) + 2 * sizeof(void*));
    }
    return bytes;
  }

  Power power(const SegmentRef& segment) const
  {
    return bands_ == 1 ? power_ : power(placeOf(segment));
  }
  Power power(const SegmentPlace& place) const { return blocks_[place.block].power(place.slot); }
  /// The hit without its distance.
  Hit hit(const SegmentRef& segment) const { return hit(placeOf(segment)); }
  Hit hit(const SegmentPlace& place) const { return hitAt(blocks_[place.block], place.slot); }

  /// Calls visit(Photon) for each photon that segments of a walk brought, from this one on, in
  /// order.
  template <class Visit>
  void forEachPhotonFrom(
    const SegmentPlace& first, const SegmentRef& segment, const Visit& visit) const
  {
    const BounceBlock& block = blocks_[first.block];
    SegmentRef now = segment;
    block.forEachFrom(first.slot, [&](std::uint32_t slot) {
      visitPhoton(block, slot, now, visit);
      ++now.bounce;
    });
  }
  /// The same for all walks of a block, in any order.
  template <class Visit>
  void forEachPhoton(std::size_t i, const Visit& visit) const
  {
    const BounceBlock& block = blocks_[i];
    block.forEach(
      [&](std::uint32_t slot) { visitPhoton(block, slot, block.segmentAt(slot), visit); });
  }

private:
  template <class Visit>
  void visitPhoton(const BounceBlock& block, std::uint32_t slot, const SegmentRef& segment,
    const Visit& visit) const
  {
    if (const Hit hit = hitAt(block, slot))
    {
      visit(Photon{ segment, hit.id, hit.weights, block.isFront(slot) });
    }
  }
  Hit hitAt(const BounceBlock& block, std::uint32_t slot) const
  {
    Hit hit;
    hit.id = numbers_.idOf(block.triangle(slot));
    hit.weights = block.weights(slot);
    return hit;
  }
  void makeKinds()
  {
    kinds_.clear();
    for (std::uint32_t object = 0; object < numbers_.objects(); ++object)
    {
      kinds_.resize(numbers_.first(object + 1), BounceTag::kindOf(object));
    }
  }

  WalkPlan plan_;
  PointGrid grid_;
  TriangleNumbers numbers_;
  std::vector<std::uint8_t> kinds_; ///< by triangle, if there are blocks
  int bands_ = 1;
  Power power_;
  DealtBlocks dealt_;
  std::shared_ptr<BlockArena> arena_; ///< outlives the blocks
  std::vector<BounceBlock> blocks_;
  std::vector<std::unordered_map<std::uint32_t, HiddenHit>> hidden_; ///< by block, then by slot
};

/// The histories of all sets of walks, at least one, ordered by the numbers of their walks.
using WalkHistories = std::vector<const WalkHistory*>;

/// The one that stores a walk.
inline const WalkHistory& historyOf(const WalkHistories& all, std::uint32_t walk)
{
  return **std::find_if(all.begin(), all.end() - 1,
    [&](const WalkHistory* history) { return walk < history->plan().endWalk(); });
}

}
