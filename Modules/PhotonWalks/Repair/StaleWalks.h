// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_StaleWalks_h
#define irradiance_StaleWalks_h

#include "Execution/Execution.h"
#include "Repair/StaleMark.h"
#include "Repair/TailBound.h"
#include "Repair/WalkVerifier.h"
#include "Tally/CellSums.h"

namespace irradiance
{

/**
 * The stored walks that wait for their repair, what their stale tails have brought to the cells, and
 * what their new ones can bring. All in quanta, exact at any time. Several threads may work on
 * different blocks.
 */
class StaleWalks
{
public:
  /// For the stored walks of the first `blocks` blocks of the plan. `sides` as in CellSums.
  StaleWalks(const SceneObjects& objects, int sides, const WalkPlan& plan, std::size_t blocks,
    const SobolSequence& samples);

  bool isEmpty() const;
  std::size_t numberOfBlocks() const { return blocks_.size(); }
  StaleMarks& marks(std::size_t block) { return blocks_[block].marks; }
  const StaleMarks& marks(std::size_t block) const { return blocks_[block].marks; }

  /// Marks what a verification found, by block. It must not have looked at tails that were marked
  /// before. Throws Interrupted.
  void add(const std::vector<std::vector<StaleSegment>>& found,
    const std::vector<WalkBlock>& history, Execution& execution);
  /// Takes a walk out whose tail is about to be replaced; its mark stays until forgetRepaired().
  void repair(
    std::size_t block, const WalkBlock& walks, StaleMark& mark, std::vector<Deposit>& deposits);
  void forgetRepaired(std::size_t block);

  /// What stale tails have brought to the cells.
  const CellSums& sums() const { return sums_; }
  /// Hands in what repair() collected.
  void take(const std::vector<Deposit>& deposits) { sums_.add(deposits); }
  /// Carried by the first stale segments.
  Power power() const;
  /// All cells together receive at most so many quanta from the tails once they are repaired;
  /// infinity where no bound is known.
  double gainBound(int band) const;
  std::size_t bytes() const;

private:
  struct Block
  {
    StaleMarks marks;
    Power power;
    Power gain;
  };

  void add(std::size_t block, const WalkBlock& walks, const std::vector<StaleSegment>& found);
  /// What the segments from the mark to `end` bring.
  void tally(const WalkBlock& walks, const StaleMark& mark, std::uint32_t end, int sign,
    std::vector<Deposit>& deposits) const;
  static void count(Block& block, const WalkBlock& walks, const StaleMark& mark, int sign);

  WalkPlan plan_;
  std::vector<Block> blocks_;
  CellSums sums_;
  TailBound bound_;
};

}

#endif
