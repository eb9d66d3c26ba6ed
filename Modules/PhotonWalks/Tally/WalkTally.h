// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkTally_h
#define irradiance_WalkTally_h

#include "History/WalkBlock.h"
#include "Tally/CellSums.h"
#include "Tally/PowerBalance.h"

namespace irradiance
{

/// Adds what hits receive to the cells and the balance, or subtracts it. The cells are updated when
/// the tally is destroyed.
class WalkTally
{
public:
  WalkTally(CellSums& sums, PowerBalance& balance)
    : sums_(sums)
    , balance_(balance)
  {
  }
  ~WalkTally() { sums_.add(deposits_); }
  WalkTally(const WalkTally&) = delete;
  WalkTally& operator=(const WalkTally&) = delete;

  /// `sign`: 1 to add, -1 to subtract.
  void add(std::uint32_t walk, const Hit& hit, bool isFront, const Power& incoming,
    const Power& reflectedPower, int sign);
  /// Drops what was tallied for the cells; the caller drops the balance.
  void discard() { deposits_.clear(); }
  /// Prefetches the sum that a hit will change.
  void prefetch(std::uint32_t walk, const Hit& hit) const { sums_.prefetch(walk, hit.id); }
  /// Subtracts the segments of a stored walk from `firstBounce` on.
  void remove(const WalkBlock& block, std::uint32_t walkInBlock, std::uint32_t walk,
    std::uint32_t firstBounce);

private:
  CellSums& sums_;
  PowerBalance& balance_;
  std::vector<Deposit> deposits_;
};

}

#endif
