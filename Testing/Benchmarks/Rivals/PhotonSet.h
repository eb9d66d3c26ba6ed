// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace irradiance
{

/**
 * References to the photons of one cell: a hash table with open addressing, double hashing and a
 * size that follows the number of photons (section 4.2 of the paper).
 *
 * The table consists of buckets, each as long as a cache line. A photon lies in the first bucket of
 * its probe sequence that had room when it came, so nearly all are found in one access to memory.
 *
 * Removal just empties a slot. No tombstone has to keep a probe sequence together, because no
 * search ends at an empty slot: what is sought is always there. For the same reason insert() and
 * remove() take O(1), but contains() looks everywhere for a photon that is not in the set.
 */
class PhotonSet
{
public:
  std::size_t size() const { return size_; }
  /// `photon` must not be in the set.
  void insert(const SegmentRef& photon);
  /// `photon` must be in the set.
  void remove(const SegmentRef& photon);
  bool contains(const SegmentRef& photon) const;
  /// Makes room for `size` photons in all.
  void reserve(std::size_t size);
  /// Prefetches what insert() and remove() read first.
  void prefetch(const SegmentRef& photon) const;

  /// Calls visit(SegmentRef) for each photon. The order depends on what was inserted and
  /// removed before, so sums of rounded numbers must sort first.
  template <class Visit>
  void forEach(const Visit& visit) const
  {
    for (std::size_t i = 0; i < slots_; ++i)
    {
      if (table_[i] != kEmpty)
      {
        visit(SegmentRef{
          static_cast<std::uint32_t>(table_[i] >> 32), static_cast<std::uint32_t>(table_[i]) });
      }
    }
  }

  /// Memory held outside of the object itself.
  std::size_t bytes() const { return slots_ * sizeof(Key); }

private:
  using Key = std::uint64_t; ///< the walk, then the bounce

  static constexpr Key kEmpty = ~Key{ 0 }; ///< no walk has the number 2^32 - 1
  static constexpr std::size_t kBucket = 8;
  static constexpr std::size_t kNone = ~std::size_t{ 0 };

  static Key keyOf(const SegmentRef& photon) { return Key{ photon.walk } << 32 | photon.bounce; }
  static std::size_t slotsFor(std::size_t size);
  std::size_t buckets() const { return (slots_ + kBucket - 1) / kBucket; }
  /// The first slot of the probe sequence of `key` that holds `sought`; kNone if no slot does.
  std::size_t findSlot(Key key, Key sought) const;
  void resize(std::size_t slots);

  std::unique_ptr<Key[]> table_;
  std::size_t slots_ = 0; ///< of at most one bucket, or of a prime number of buckets
  std::size_t size_ = 0;
};

}
