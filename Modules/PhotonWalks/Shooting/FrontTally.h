// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Shooting/WalkFront.h"
#include "Surfaces/SceneTriangles.h"
#include "Tally/PhotonCounts.h"
#include "Tally/PowerBalance.h"

namespace irradiance
{

/// Adds what a front brings to the cells and the balance, or takes it back: the one place where the
/// result gains or loses a photon. The cells are updated when the tally is destroyed.
class FrontTally
{
public:
  /// `photon`: the power of each walk, if there is one band. `expected`: about how many photons
  /// will come or go: many are counted in a table, few stand in a list, see PhotonCounts. The other
  /// arguments must outlive the tally.
  FrontTally(const SceneTriangles& triangles, CellSums& sums, PowerBalance& balance,
    const Power& photon, std::size_t expected);
  ~FrontTally() { sums_.add(deposits_); }
  FrontTally(const FrontTally&) = delete;
  FrontTally& operator=(const FrontTally&) = delete;

  /// Walks start.
  void emit(const WalkFront& front) { balance_.emitted += powerOf(front); }
  /// Walks that had started are no more. What they brought is for remove().
  void unemit(const Power& started) { balance_.emitted -= started; }
  /// The cells that are hit receive what the walks carry; what hits nothing escapes. Reads walk,
  /// hit and hitSide.
  void receive(const WalkFront& front) { change(front, 1); }
  /// Of what arrived, this front leaves again.
  void release(const WalkFront& front) { balance_.absorbed -= powerOf(front); }
  /// Walks that had left where light arrived are no more, as unemit().
  void unrelease(const Power& started) { balance_.absorbed += started; }
  /**
   * Takes back what tails of walks brought: all their segments, in any order, as receive() took
   * them, with the sides that were hit and, with several bands, their powers. `starting`: what the
   * first segments of the tails carry in all. This power was released before, or emitted; it is
   * under way again, as new tails take the place of these.
   */
  void remove(const WalkFront& tails, const Power& starting)
  {
    change(tails, -1);
    balance_.absorbed += powerOf(tails) - starting;
  }
  void check() const { checkReceived(balance_); }

private:
  /// Slots at a time: they stay in the nearest memory.
  static constexpr std::size_t kTogether = 512;
  static_assert(kTogether % WalkFront::kGroup == 0);

  Power powerOf(const WalkFront& front) const;
  /// `sign`: 1 to add what a front brings, -1 to remove it.
  void change(const WalkFront& front, int sign);
  void changePhotons(const WalkFront& front, std::size_t first, std::size_t end, int sign);
  void changePowers(const WalkFront& front, std::size_t first, std::size_t end, int sign);

  const SceneTriangles& triangles_;
  CellSums& sums_;
  PowerBalance& balance_;
  Power photon_;
  PhotonCounts counts_;           ///< one band
  std::vector<Deposit> deposits_; ///< several bands
  alignas(64) std::uint32_t slots_[kTogether];
};

}
