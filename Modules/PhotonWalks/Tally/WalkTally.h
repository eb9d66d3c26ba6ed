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

  int sides() const { return sums_.sides(); }
  /// Where the photons of a walk on a cell are tallied.
  std::size_t slotOf(std::uint32_t walk, const SceneCell& cell) const
  {
    return sums_.slotOf(walk, cell);
  }
  std::size_t backOf(std::size_t slot) const { return sums_.backOf(slot); }
  /// Prefetches the sum that a photon will change.
  void prefetch(std::size_t slot) const { sums_.prefetch(slot); }
  /// A photon arrives.
  void receive(std::size_t slot, bool isFront, const Power& power)
  {
    sums_.collect(slot, isFront, power, 1, deposits_);
    countReceived(1, power);
  }
  /// Photons of one power in one band arrive.
  void receive(const std::vector<std::size_t>& slots, const Power& power)
  {
    const std::size_t before = deposits_.size();
    deposits_.resize(before + slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i)
    {
      deposits_[before + i] = { slots[i], power[0] };
    }
    countReceived(static_cast<std::int64_t>(slots.size()), power);
  }
  void escape(std::int64_t photons, const Power& power)
  {
    balance_.segments += photons;
    balance_.escaped += photons * power;
  }
  /// Of what arrived, photons leave again.
  void release(std::int64_t photons, const Power& power) { balance_.absorbed -= photons * power; }
  /// Drops what was tallied for the cells; the caller drops the balance.
  void discard() { deposits_.clear(); }
  void check() const { checkReceived(balance_); }
  /// Subtracts the segments of a stored walk from `first` on.
  void remove(const WalkBlock& block, const SegmentRef& first);

private:
  void countReceived(std::int64_t photons, const Power& power)
  {
    const Power all = photons * power;
    balance_.segments += photons;
    balance_.received += all.total();
    balance_.absorbed += all;
  }

  CellSums& sums_;
  PowerBalance& balance_;
  std::vector<Deposit> deposits_;
};

}

#endif
