// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SegmentIndex_h
#define irradiance_SegmentIndex_h

#include "History/BounceScan.h"
#include "History/IndexScan.h"

#include <cstdint>
#include <vector>

namespace irradiance
{

/**
 * An index over the stored segments of up to 64 blocks, for scenes of many moved bodies: what a
 * BounceScan takes for each segment and body is taken for each group of like segments first. It finds
 * the same segments. A scene of fewer than kFromBodies bodies should have none: a scan has tested the balls
 * of some hundred bodies before an index is built and kept.
 *
 * Segments are sorted by where both their ends are, then grouped by 16, and by 256. A group is known by a
 * segment in its middle and by how far from that one's ends those of the others are.
 *
 * What is stored after the index was built has to be added, and is tested flat. What is removed is not
 * told: an entry counts only while its slot holds the same ends.
 */
class SegmentIndex
{
public:
  static constexpr std::size_t kBlocks = 64;
  static constexpr std::size_t kFromBodies = 256;

  using Blocks = std::vector<const BounceBlock*>; ///< up to kBlocks, always the same ones

  SegmentIndex() = default;
  explicit SegmentIndex(const Blocks& blocks);

  /// Segments were stored in these slots of a block.
  void add(const Blocks& blocks, std::size_t block, const std::uint32_t* slots, std::size_t count);
  /// Whether so much was added that a new index pays.
  bool isWorn() const { return 4 * tail_.references.size() > sorted_.references.size() + 1024; }

  /// For each block, what BounceScan::find lists.
  void find(const Blocks& blocks, const BounceScan& scan,
    std::vector<std::vector<std::uint32_t>>& slots) const;

  std::size_t bytes() const;

private:
  /// Segments, or groups of them with a radius.
  struct Columns
  {
    std::vector<std::int16_t> ends[6];
    std::vector<float> radius;
    std::vector<std::uint32_t> references; ///< block and slot

    void resize(std::size_t size);
    IndexColumns view() const;
    std::size_t bytes() const;
  };

  using Flags = std::vector<std::vector<std::uint16_t>>; ///< by block, see PageScan

  // A reference holds the number of the block above that of the slot.
  static constexpr unsigned kSlotBits = 26;
  static constexpr std::uint32_t kNothing = 0xffffffffu; // where a group is not full

  std::vector<std::uint64_t> sortedKeys(const Blocks& blocks) const;
  template <std::size_t kCount>
  static Columns groupsOf(const Columns& members);
  void flagTags(const Blocks& blocks, const BounceScan& scan, Flags& flagged) const;
  void flagNear(const Blocks& blocks, const BounceScan& scan, Flags& flagged) const;
  void flagEntry(
    const Blocks& blocks, const Columns& entries, std::size_t entry, Flags& flagged) const;

  Columns sorted_, groups_,
    tops_;       ///< `sorted_` is filled up with copies of the last, without references
  Columns tail_; ///< to a multiple of 16
  std::size_t inTail_ = 0;
};

}

#endif
