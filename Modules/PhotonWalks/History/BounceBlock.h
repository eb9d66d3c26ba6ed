// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BlockArena.h"
#include "History/BouncePage.h"
#include "History/PointGrid.h"
#include "Simd/Prefetch.h"
#include "Surfaces/Power.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace irradiance
{

/// Which segment of which walk; also the photon that the segment brings to what it hits.
struct SegmentRef
{
  std::uint32_t walk;   ///< its number in the plan
  std::uint32_t bounce; ///< 0 for the segment that leaves the light

  friend bool operator==(const SegmentRef& a, const SegmentRef& b)
  {
    return a.walk == b.walk && a.bounce == b.bounce;
  }
  friend bool operator<(const SegmentRef& a, const SegmentRef& b)
  {
    return std::tie(a.walk, a.bounce) < std::tie(b.walk, b.bounce);
  }
};

/// Segments that were shot side by side, in columns. Rows are read up to RayColumns::kPadding
/// places behind the last one.
struct BounceColumns
{
  RayColumns rays;
  const std::uint32_t* walks;
  const std::uint32_t* parents;   ///< slot of the segment before, BounceBlock::kNone at bounce 0
  const std::uint32_t* triangles; ///< that were hit, numbered through all objects, or kNone
  const float* weights[2];        ///< see Hit
  const std::uint8_t* kinds;      ///< BounceTag::kindOf the object that was hit, or kContact
  const std::uint8_t* isFront;    ///< the side that was hit, 0 or 1
  /// Quanta, if there are several bands.
  const std::int64_t* powers[Power::kMaxBands]{};

  /// The kind of a hit that may depend on dynamic objects that touch, see Contacts.
  static constexpr std::uint8_t kContact = BounceTag::kAlways;
};

/**
 * The stored walks of consecutive numbers, at most WalkPlan::kWalksPerBlock, by bounces: a front of
 * walks is appended as it was shot.
 *
 * Each segment has a slot, which it keeps; nothing is ever moved. So a slot names a segment for as
 * long as it is stored, to photons as well. Documentation/Architecture.md shows how slots lie in
 * pages. Links have 16 bits: what links lead from one part of 64 K slots to another is listed
 * aside. That takes 64 segments a walk.
 *
 * The cache of static hits (section 3.3 of the paper) stands beside it, by slot: see HiddenHit.
 */
class BounceBlock
{
public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// The size of the arena's pages.
  static std::size_t pageBytes(int bands)
  {
    return sizeof(BouncePage) +
      (bands > 1 ? static_cast<std::size_t>(bands) * BouncePage::kSize * sizeof(std::int64_t) : 0);
  }

  /// `grid`: of the ends. `power`: of all segments, if there is one band; several have a power for
  /// each segment.
  BounceBlock(BlockArena& arena, std::uint32_t firstWalk, std::uint32_t numberOfWalks, int bands,
    const PointGrid& grid, const Power& power)
    : arena_(&arena)
    , firstWalk_(firstWalk)
    , numberOfWalks_(numberOfWalks)
    , size_(numberOfWalks)
    , bands_(bands > 1 ? static_cast<std::uint32_t>(bands) : 0)
    , grid_(grid)
    , power_(power)
  {
  }
  ~BounceBlock()
  {
    for (BouncePage* const page : pages_)
    {
      arena_->giveBack(page);
    }
  }
  BounceBlock(BounceBlock&& other) noexcept = default;

  std::uint32_t firstWalk() const { return firstWalk_; }
  std::uint32_t endWalk() const { return firstWalk_ + numberOfWalks_; }
  std::uint32_t numberOfWalks() const { return numberOfWalks_; }
  const PointGrid& grid() const { return grid_; }
  bool isFree(std::uint32_t slot) const { return tag(slot) == BounceTag::kFree; }

  /// Stores rows [first, first + count) of a front, all of walks of this block, and writes the slot
  /// of each to `slots`. A walk has no segment after a row's parent, or at all for a bounce of 0.
  /// Rows may be in any order.
  void append(
    const BounceColumns& front, std::size_t first, std::size_t count, std::uint32_t* slots);
  /// Removes this segment and all after it of its walk.
  void removeFrom(std::uint32_t slot);
  /// Likewise, and calls visit(slot) for each of them before any is removed.
  template <class Visit>
  void removeFrom(std::uint32_t slot, const Visit& visit)
  {
    forEachFrom(slot, visit); // then their links are in the nearest memory
    removeFrom(slot);
  }
  /// Puts numberOf(triangle) in place of the triangle of each segment that hits one: an object of
  /// another size that no segment hits changes the numbers of the triangles after it.
  template <class Renumber>
  void renumber(const Renumber& numberOf)
  {
    forEach([&](std::uint32_t slot) {
      std::uint32_t& number = record(slot).triangle;
      number = number == kNone ? kNone : numberOf(number);
    });
  }

  /// Of all segments, if there is one band.
  void setPower(const Power& power) { power_ = power; }

  /// The hit of a segment is gone: the ray of it escapes, until it is cast again, which every scan
  /// asks for.
  void lose(std::uint32_t slot)
  {
    record(slot).triangle = kNone;
    record(slot).walk |= BounceRecord::kContact;
    std::uint8_t& tag = pageOf(slot).tags[slot % BouncePage::kSize];
    tag = static_cast<std::uint8_t>((tag & BounceTag::kOpen) | BounceTag::kAlways);
  }
  bool isLost(std::uint32_t slot) const { return triangle(slot) == kNone && isContact(slot); }

  // From a segment of a walk to its slot, and back.
  /// The first segment of a walk, or kNone.
  std::uint32_t begin(std::uint32_t walk) const
  {
    const std::uint32_t slot = walk - firstWalk_;
    return pages_.empty() || isFree(slot) ? kNone : slot;
  }
  /// kNone after the last.
  std::uint32_t next(std::uint32_t slot) const
  {
    const std::uint16_t child = pageOf(slot).children[slot % BouncePage::kSize];
    return child < kCrossing ? partOf(slot) | child
      : child == kCrossing   ? children_.at(slot)
                             : kNone;
  }
  /// kNone before the first.
  std::uint32_t previous(std::uint32_t slot) const
  {
    const std::uint16_t parent = record(slot).parent;
    return parent < kCrossing ? partOf(slot) | parent
      : parent == kCrossing   ? parents_.at(slot)
                              : kNone;
  }
  std::uint32_t slotOf(const SegmentRef& segment) const
  {
    std::uint32_t slot = begin(segment.walk);
    for (std::uint32_t bounce = 0; bounce < segment.bounce && slot != kNone; ++bounce)
    {
      slot = next(slot);
    }
    return slot;
  }
  std::uint32_t lastOf(std::uint32_t walk) const
  {
    std::uint32_t last = kNone;
    forEachFrom(begin(walk), [&](std::uint32_t slot) { last = slot; });
    return last;
  }
  std::uint32_t bounceOf(std::uint32_t slot) const
  {
    std::uint32_t more = 0;
    while (pageOf(slot).bounces[slot % BouncePage::kSize] == kManyBounces)
    {
      slot = previous(slot);
      ++more;
    }
    return pageOf(slot).bounces[slot % BouncePage::kSize] + more;
  }
  SegmentRef segmentAt(std::uint32_t slot) const { return { walkOf(slot), bounceOf(slot) }; }

  // What is known of a segment.
  /// kNone if it escapes.
  std::uint32_t triangle(std::uint32_t slot) const { return record(slot).triangle; }
  std::array<float, 2> weights(std::uint32_t slot) const
  {
    return { record(slot).weights[0], record(slot).weights[1] };
  }
  std::uint32_t walkOf(std::uint32_t slot) const
  {
    return firstWalk_ + (record(slot).walk & BounceRecord::kWalk);
  }
  bool isFront(std::uint32_t slot) const { return (record(slot).walk & BounceRecord::kBack) == 0; }
  bool isContact(std::uint32_t slot) const
  {
    return (record(slot).walk & BounceRecord::kContact) != 0;
  }
  Power power(std::uint32_t slot) const
  {
    if (bands_ == 0)
    {
      return power_;
    }
    Power power;
    std::copy_n(powersAt(slot), bands_, power.quanta.begin());
    return power;
  }
  std::uint8_t tag(std::uint32_t slot) const { return pageOf(slot).tags[slot % BouncePage::kSize]; }

  /// Calls visit(slot) for a segment and all after it of its walk, in order. The visit must not
  /// remove any.
  template <class Visit>
  void forEachFrom(std::uint32_t slot, const Visit& visit) const
  {
    for (; slot != kNone; slot = next(slot))
    {
      visit(slot);
    }
  }
  /// For all segments, in the order of slots: that of memory.
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (std::uint32_t slot = 0; slot < size_ && !pages_.empty(); ++slot)
    {
      if (!isFree(slot))
      {
        visit(slot);
      }
    }
  }

  /// Prefetches the hit of a slot, its walk, its bounce and the link to the segment before.
  void prefetchHit(std::uint32_t slot) const
  {
    prefetchLine(&record(slot));
    prefetchLine(&pageOf(slot).bounces[slot % BouncePage::kSize]);
  }
  /// Prefetches what a slot's queries read.
  void prefetch(std::uint32_t slot) const
  {
    prefetchLine(&record(slot));
    prefetchLine(&pageOf(slot).children[slot % BouncePage::kSize]);
    prefetchLine(&pageOf(slot).tags[slot % BouncePage::kSize]);
  }
  /// The slots as a scan reads them.
  const std::vector<BouncePage*>& pages() const { return pages_; }

  /// Memory held, including unused slots.
  std::size_t bytes() const
  {
    constexpr std::size_t kNode = 4 * sizeof(void*); // of a map, and its share of the buckets
    return sizeof(*this) + pages_.size() * arena_->pageBytes() + pages_.capacity() * sizeof(void*) +
      free_.capacity() * sizeof(std::uint32_t) + (children_.size() + parents_.size()) * kNode;
  }

private:
  static constexpr std::uint16_t kEnd = 0xffff;      ///< a link to nothing
  static constexpr std::uint16_t kCrossing = 0xfffe; ///< a link that is listed aside
  static constexpr std::uint32_t kPart = 1u << 16;
  static constexpr std::uint8_t kManyBounces = 255; ///< these, or more

  static std::uint32_t partOf(std::uint32_t slot) { return slot & ~(kPart - 1); }
  BouncePage& pageOf(std::uint32_t slot) const { return *pages_[slot / BouncePage::kSize]; }
  BounceRecord& record(std::uint32_t slot) const
  {
    return pageOf(slot).records[slot % BouncePage::kSize];
  }
  std::int64_t* powersAt(std::uint32_t slot) const
  {
    auto* const powers = reinterpret_cast<std::int64_t*>(pages_[slot / BouncePage::kSize] + 1);
    return powers + std::size_t{ slot % BouncePage::kSize } * bands_;
  }
  std::uint32_t newSlot()
  {
    if (!free_.empty())
    {
      const std::uint32_t slot = free_.back();
      free_.pop_back();
      return slot;
    }
    while (size_ % kPart >= kCrossing)
    {
      ++size_; // a slot that no link can name; its tag stays free
    }
    const std::uint32_t slot = size_++;
    if (pages_.size() * BouncePage::kSize <= slot)
    {
      addPage();
    }
    return slot;
  }
  void addPage()
  {
    if (pages_.size() == pages_.capacity())
    {
      pages_.reserve(2 * pages_.size() + 1); // now, so that a page that was taken is never lost
    }
    auto* const page = static_cast<BouncePage*>(arena_->take());
    pages_.push_back(page);
    std::memset(page->tags, BounceTag::kFree, sizeof page->tags);
  }
  void appendSome(
    const BounceColumns& front, std::size_t first, std::size_t count, std::uint32_t* slots);
  void prefetchToStore(std::uint32_t slot, std::uint32_t parent) const
  {
    const BouncePage& page = pageOf(slot);
    const std::uint32_t place = slot % BouncePage::kSize;
    for (const auto& column : page.ends)
    {
      prefetchLine(column + place);
    }
    prefetchLine(page.bounces + place);
    if (parent != kNone)
    {
      prefetchLine(pageOf(parent).bounces + parent % BouncePage::kSize);
      prefetchLine(pageOf(parent).children + parent % BouncePage::kSize);
    }
  }
  void storeRun(const BounceColumns& front, std::size_t row, const GridSegments& segments,
    std::size_t at, std::uint32_t slot, std::size_t count);
  void link(std::uint32_t parent, std::uint32_t slot)
  {
    BouncePage& from = pageOf(parent);
    BouncePage& to = pageOf(slot);
    const std::uint32_t before = parent % BouncePage::kSize, place = slot % BouncePage::kSize;
    const bool isNear = partOf(parent) == partOf(slot);
    from.children[before] = isNear ? static_cast<std::uint16_t>(slot) : kCrossing;
    to.records[place].parent = isNear ? static_cast<std::uint16_t>(parent) : kCrossing;
    to.bounces[place] =
      static_cast<std::uint8_t>(std::min<int>(from.bounces[before] + 1, kManyBounces));
    if (!isNear)
    {
      children_[parent] = slot;
      parents_[slot] = parent;
    }
  }
  /// From the segment before it.
  void unlink(std::uint32_t slot)
  {
    const std::uint32_t parent = previous(slot);
    if (parent == kNone)
    {
      return;
    }
    pageOf(parent).children[parent % BouncePage::kSize] = kEnd;
    if (partOf(parent) != partOf(slot))
    {
      children_.erase(parent);
      parents_.erase(slot);
    }
  }

  BlockArena* arena_;
  std::uint32_t firstWalk_, numberOfWalks_;
  std::uint32_t size_;  ///< slots
  std::uint32_t bands_; ///< stored for each segment: none if all powers are the same
  PointGrid grid_;
  Power power_;
  std::vector<BouncePage*> pages_;
  std::vector<std::uint32_t> free_; ///< slots, except those of first segments
  std::unordered_map<std::uint32_t, std::uint32_t> children_, parents_; ///< links between parts
};

}
