// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/WalkHistory.h"
#include "Sampling/SobolSequence.h"
#include "Surfaces/SceneObjects.h"
#include "Tally/CellSums.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace irradiance
{

/// From this segment on a stored walk is no longer valid, and it has not been shot again yet. The
/// ray of the segment and all before it are valid.
struct StaleMark
{
  std::uint32_t walk;
  std::uint32_t bounce : 21;     ///< a walk has at most 2^20 segments
  std::uint32_t powerClass : 11; ///< what it carries: more if larger, 0: repaired
  std::int64_t gain;             ///< see StalePower

  SegmentRef first() const { return { walk, bounce }; }
};

/// The marks of a block, ordered by walk, at most one per walk.
using StaleMarks = std::vector<StaleMark>;

inline bool isStale(const StaleMarks& marks, const SegmentRef& segment)
{
  const auto found = std::lower_bound(marks.begin(), marks.end(), segment.walk,
    [](const StaleMark& mark, std::uint32_t walk) { return mark.walk < walk; });
  return found != marks.end() && found->walk == segment.walk && segment.bounce >= found->bounce;
}

/// Of stale walks: the power that their first stale segments carry, and an upper bound of the quanta
/// that all cells together receive from their new tails.
struct StalePower
{
  Power carried, gain;

  /// Of a walk; `sign` -1 takes it away.
  void add(const Power& power, std::int64_t most, int sign)
  {
    for (int band = 0; band < Power::kMaxBands; ++band)
    {
      carried[band] += sign * power[band];
      gain[band] += power[band] > 0 ? sign * most : 0; // a band without power gains none
    }
  }
};

/**
 * The stored walks that await repair, the power that their stale tails brought to the cells, and a
 * bound of what their new tails can bring. All in quanta, exact at any time. Several threads may
 * work on different blocks.
 */
class StaleWalks
{
public:
  /// For the stored walks of so many blocks.
  StaleWalks(const SceneObjects& objects, std::size_t blocks, const SobolSequence& samples);

  /// Changes to materials of the same cells. `history`: of the walks.
  void repaint(const SceneObjects& objects, const WalkHistory& history);

  bool isEmpty() const
  {
    return numberOfUnborn_ == 0 &&
      std::all_of(
        blocks_.begin(), blocks_.end(), [](const Block& block) { return block.marks.empty(); });
  }
  /// Whether static parts came since walks are stale, so that nothing is known of the new hits.
  bool mayMeetOthers() const { return mayMeetOthers_; }
  void setMayMeetOthers(bool may) { mayMeetOthers_ = may; }
  std::size_t numberOfBlocks() const { return blocks_.size(); }
  StaleMarks& marks(std::size_t block) { return blocks_[block].marks; }
  const StaleMarks& marks(std::size_t block) const { return blocks_[block].marks; }

  /// All marked walks, by classes whose stale segments carry similar power, the strongest first:
  /// the weakest StaleMark::powerClass of each, and how many walks it has. Each but the last has at
  /// least `enough`.
  std::vector<std::pair<std::uint16_t, std::size_t>> classes(std::size_t enough) const;

  /// Marks the first stale segments of walks of a block, ordered by walk, as a verification found
  /// them. It must have skipped the tails that were marked before.
  void add(std::size_t block, const WalkHistory& history, const std::vector<SegmentRef>& found);
  /// Takes out a walk whose tail is about to be replaced; its mark stays until forgetRepaired().
  void repair(const WalkHistory& history, StaleMark& mark, std::vector<Deposit>& deposits)
  {
    tally(history, mark, kAll, -1, deposits);
    blocks_[history.indexOf(mark.walk)].power.add(history.power(mark.first()), mark.gain, -1);
    mark.powerClass = 0;
  }
  void forgetRepaired(std::size_t block)
  {
    StaleMarks& marks = blocks_[block].marks;
    marks.erase(std::remove_if(marks.begin(), marks.end(),
                  [](const StaleMark& mark) { return mark.powerClass == 0; }),
      marks.end());
  }

  /// Takes out a walk that is about to be removed, if it is marked.
  void forget(const WalkHistory& history, std::uint32_t walk);

  /// Walks that are to start and are not stored yet.
  std::size_t numberOfUnborn() const { return numberOfUnborn_; }
  /// Notes which these are. `powerOf(walk)`: with which it will start.
  template <class PowerOf>
  void setUnborn(const std::vector<std::uint32_t>& walks, const PowerOf& powerOf)
  {
    numberOfUnborn_ = walks.size();
    unborn_ = {};
    for (const std::uint32_t walk : walks)
    {
      const Power power = powerOf(walk);
      unborn_.add(power, gainOf(walk, 0, power), 1);
    }
  }

  /// The power that the stale tails brought to the cells.
  const CellSums& sums() const { return sums_; }
  /// Adds the deposits that repair() collected.
  void take(const std::vector<Deposit>& deposits) { sums_.add(deposits); }
  /// Of all, and of walks that are not stored yet, from their first segments on.
  StalePower power() const
  {
    StalePower sum = unborn_;
    for (const Block& block : blocks_)
    {
      sum.carried += block.power.carried;
      sum.gain += block.power.gain;
    }
    return sum;
  }
  /// False if a material reflects more than kMostReflecting.
  bool isBoundKnown() const { return reflectance_ <= kMostReflecting; }
  std::size_t bytes() const
  {
    std::size_t sum = blocks_.capacity() * sizeof(Block);
    for (const Block& block : blocks_)
    {
      sum += block.marks.capacity() * sizeof(StaleMark);
    }
    return sum;
  }

private:
  /// Beyond this the bound would take long, and be a hundred times the power or more.
  static constexpr double kMostReflecting = 0.99;

  static constexpr std::uint32_t kAll = 0xffffffffu; ///< segments of a walk

  struct Block
  {
    StaleMarks marks;
    StalePower power;
  };

  /// Collects the deposits of the segments from the mark to `end`.
  void tally(const WalkHistory& history, const StaleMark& mark, std::uint32_t end, int sign,
    std::vector<Deposit>& deposits) const;
  /**
   * The most that the rest of a walk can bring to all cells together in any one band, wherever it
   * goes: what it brings if it never escapes and always hits the cell that reflects most. Whether
   * it survives a hit is decided by its own samples, so the bound is certain, not a mean; 0 if it
   * is not known. `incoming`: what segment `bounce` carries. See Documentation/Theory.md, 4.1.
   */
  std::int64_t gainOf(std::uint32_t walk, std::uint32_t bounce, const Power& incoming) const
  {
    // No band ever carries more than the strongest does now.
    std::int64_t received = isBoundKnown() ? incoming.largest() : 0;
    while (isBoundKnown() && samples_.sample(walk, ++bounce, SampleUse::Survival)[0] < reflectance_)
    {
      received += incoming.largest();
    }
    return received;
  }

  std::vector<Block> blocks_;
  CellSums sums_;
  std::size_t numberOfUnborn_ = 0;
  StalePower unborn_;
  SobolSequence samples_;
  bool mayMeetOthers_ = false;
  double reflectance_; ///< in all, also let through: the largest of any triangle
};

}
