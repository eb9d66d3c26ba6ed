// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FrontTally_h
#define irradiance_FrontTally_h

#include "Shooting/WalkFront.h"
#include "Surfaces/SceneTriangles.h"
#include "Tally/PhotonCounts.h"
#include "Tally/PowerBalance.h"

namespace irradiance
{

/// Adds what a front brings to the cells and the balance, as WalkTally does walk by walk. The cells are
/// updated when the tally is destroyed.
class FrontTally
{
public:
  /// `photon`: the power of each walk, if there is one band. `expected`: about how many photons will come.
  /// The other arguments must outlive the tally.
  FrontTally(const SceneTriangles& triangles, CellSums& sums, PowerBalance& balance,
    const Power& photon, std::size_t expected);
  ~FrontTally() { sums_.add(deposits_); }
  FrontTally(const FrontTally&) = delete;
  FrontTally& operator=(const FrontTally&) = delete;

  bool keepsSides() const { return sums_.sides() == 2; }
  /// Walks start.
  void emit(const WalkFront& front) { balance_.emitted += powerOf(front); }
  /// The cells that are hit receive what the walks carry; what hits nothing escapes. Reads walk, hit and,
  /// if sides are kept apart, hitSide.
  void receive(const WalkFront& front);
  /// Of what arrived, this front leaves again.
  void release(const WalkFront& front) { balance_.absorbed -= powerOf(front); }
  /// Drops what was tallied for the cells; the caller drops the balance.
  void discard();
  void check() const { checkReceived(balance_); }

private:
  /// Slots at a time: they stay in the nearest memory.
  static constexpr std::size_t kTogether = 512;
  static_assert(kTogether % WalkFront::kGroup == 0);

  Power powerOf(const WalkFront& front) const;
  void receiveGroups(const WalkFront& front, std::size_t first, std::size_t end);
  /// Walks of several rounds: each has sums of its own.
  void addRounds(const WalkFront& front, std::size_t first, std::size_t end);
  void receivePowers(const WalkFront& front, std::size_t first, std::size_t end);

  const SceneTriangles& triangles_;
  CellSums& sums_;
  PowerBalance& balance_;
  Power photon_;
  PhotonCounts counts_;           ///< one band
  std::vector<Deposit> deposits_; ///< several bands
  FrontColumn<std::uint32_t> slots_;
};

}

#endif
