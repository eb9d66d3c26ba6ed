// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Ranks.h"
#include "Geometry/Ray.h"
#include "Sampling/WalkPlan.h"
#include "Surfaces/Power.h"
#include "Surfaces/SceneCells.h"

#include <array>
#include <cassert>
#include <memory>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

namespace irradiance
{

/// The power that a photon adds to a sum, negative when the photon is removed.
struct Deposit
{
  std::size_t slot;
  std::int64_t quanta;
};

/// Objects [first, second) whose cells gather direct light together.
using CellPart = std::pair<std::uint32_t, std::uint32_t>;

/// The power that each side of a cell receives, in quanta. Adding a photon adds its power, removing
/// it subtracts it. Threads collect deposits and add many at a time; the result does not depend on
/// their order.
///
/// What walks bring is whole quanta. What cells gather themselves is kept apart, in floating point:
/// so a cell that receives next to nothing of all power knows that to as many digits as others.
///
/// Each round and each replicate of the plan has sums of its own.
class CellSums
{
public:
  CellSums() = default;
  /// There is room for `rounds` rounds of the plan. `sides`: 1 where both sides of a cell share one
  /// sum.
  explicit CellSums(const SceneObjects& objects, const WalkPlan& plan = {}, std::size_t rounds = 1,
    const CellPart& gatherers = {}, int sides = 2);
  /// With room for what all cells gather alone, and none for walks.
  static CellSums ofGathered(
    const SceneObjects& objects, const WalkPlan& plan = {}, std::size_t rounds = 1)
  {
    CellSums sums(objects, plan, 0, { 0, objects.size() });
    sums.areShot_ = false;
    sums.setRounds(rounds);
    return sums;
  }

  /// Changes to objects of which some have other cells than before. These start with nothing; all
  /// others keep their sums. `staticCells`: see KeptParts.
  void replace(const SceneObjects& objects, const std::vector<std::uint32_t>& staticCells = {},
    const CancelPoint& cancelPoint = {});
  /// Makes room for further rounds, or drops the last ones.
  void setRounds(std::size_t rounds, const CancelPoint& cancelPoint = {});
  /// Likewise, for a plan with as many rounds, which differs from the one of before in these alone.
  void setRounds(const WalkPlan& plan, const CancelPoint& cancelPoint = {})
  {
    plan_ = plan;
    setRounds(plan.rounds().size(), cancelPoint);
  }
  /// Changes to a plan with another number of walks in its only round, whose photons have other
  /// quanta. All sums are of photons.
  void rescale(const WalkPlan& plan, std::int64_t quantaBefore, std::int64_t quanta)
  {
    plan_ = plan;
    for (std::size_t i = 0; quanta != quantaBefore && i < sums_.size(); ++i)
    {
      sums_[i] = sums_[i] / quantaBefore * quanta;
    }
  }
  std::size_t rounds() const { return rounds_; }
  std::size_t bytes() const
  {
    return sums_.capacity() * sizeof(sums_[0]) + gathered_.capacity() * sizeof(gathered_[0]);
  }
  const CellPart& gatherers() const { return gatherers_; }
  bool gathers(const SceneCell& cell) const
  {
    return cell.object >= gatherers_.first && cell.object < gatherers_.second;
  }

  /// Where the photons of a walk on the front of a cell are added.
  std::size_t slotOf(std::uint32_t walk, const SceneCell& cell) const
  {
    return slotOf({ cell, 0 }, plan_.replicates().replicateOf(walk), plan_.roundOf(walk));
  }
  /// Where what a replicate brings to a side of a cell in a round is added.
  std::size_t slotOf(const CellSide& cell, std::uint32_t replicate, std::size_t round) const
  {
    assert(sides_ == 1 || cell.side != CellSide::kBoth);
    const std::size_t part = numbers_[cell] * static_cast<std::size_t>(sides_) +
      (sides_ == 2 ? static_cast<std::size_t>(cell.side) : 0);
    return round * roundSize_ + part * sideSize() + replicate * static_cast<std::size_t>(bands_);
  }
  /// How slots are numbered: by round, then cell, side, replicate and band.
  std::size_t slotsPerRound() const { return roundSize_; }
  std::size_t slotsPerCell() const { return static_cast<std::size_t>(sides_) * sideSize(); }
  /// Of all rounds.
  std::size_t slots() const { return sums_.size(); }
  /// Where the photons on the back of a cell with this slot are added.
  std::size_t backOf(std::size_t slot) const { return slot + (sides_ == 2 ? sideSize() : 0); }
  SceneCell cellOf(const TriangleId& id) const
  {
    return { id.object, materials_[id.object]->cellOfTriangle[id.triangle] };
  }
  /// Appends the deposits of a photon on a cell with this slot. `sign`: 1 to add it, -1 to remove
  /// it.
  void collect(std::size_t slot, bool isFront, const Power& power, int sign,
    std::vector<Deposit>& deposits) const
  {
    const std::size_t first = isFront ? slot : backOf(slot);
    for (int band = 0; band < bands_; ++band)
    {
      deposits.push_back({ first + static_cast<std::size_t>(band), sign * power[band] });
    }
  }
  /// May be called by many threads at once.
  void add(const std::vector<Deposit>& deposits);
  /// Adds counts of photons of one power, one for each slot of the sums, and sets them to 0. May be
  /// called by many threads at once.
  void addCounts(std::int32_t* counts, std::int64_t quanta)
  {
    for (std::size_t i = 0; i < sums_.size();)
    {
      const std::size_t part = i >> partShift(),
                        end = std::min((part + 1) << partShift(), sums_.size());
      const std::lock_guard<std::mutex> lock((*mutexes_)[part]);
      for (; i < end; ++i)
      {
        sums_[i] += counts[i] * quanta;
        counts[i] = 0;
      }
    }
  }
  /// Adds what a cell of the gatherers gathers; `sign` -1 takes it away. For one thread alone.
  void addGathered(std::size_t slot, bool isFront, const Bands& quanta, int sign)
  {
    double* const sums = &gathered_[gatheredPlace(isFront ? slot : backOf(slot))];
    for (int band = 0; band < bands_; ++band)
    {
      sums[band] += sign * quanta[static_cast<std::size_t>(band)];
    }
  }
  /// Adds other sums of the same cells, round by round and replicate by replicate. The gatherers of
  /// these must be some of its own.
  void add(const CellSums& others, const CancelPoint& cancelPoint);
  /// Likewise what they gathered alone.
  void addGathered(const CellSums& others, const CancelPoint& cancelPoint);
  /// Adds up the sums of all ranks. What a side of a cell gathers must be known to one of them
  /// alone.
  void sumOver(Ranks& ranks, const CancelPoint& cancelPoint);

  /// What a side of a cell, or both, received in all.
  double sum(const CellSide& cell, int band) const { return sum(cell, band, rounds_); }
  /// Likewise, in the first `rounds` rounds.
  double sum(const CellSide& cell, int band, std::size_t rounds) const
  {
    return static_cast<double>(shot(cell, band, rounds)) +
      overReplicates([&](std::uint32_t i) { return gathered(cell, band, i, rounds); });
  }
  /// The part of one replicate.
  double sum(const CellSide& cell, int band, std::uint32_t replicate, std::size_t rounds) const
  {
    return static_cast<double>(shot(cell, band, replicate, rounds)) +
      gathered(cell, band, replicate, rounds);
  }
  /// Likewise, in all bands.
  Bands sums(const CellSide& cell, std::uint32_t replicate, std::size_t rounds) const
  {
    Bands sums{};
    for (int band = 0; band < bands_; ++band)
    {
      sums[static_cast<std::size_t>(band)] = sum(cell, band, replicate, rounds);
    }
    return sums;
  }
  /// What walks brought.
  std::int64_t shot(const CellSide& cell, int band, std::size_t rounds) const
  {
    return overReplicates([&](std::uint32_t i) { return shot(cell, band, i, rounds); });
  }
  std::int64_t shot(
    const CellSide& cell, int band, std::uint32_t replicate, std::size_t rounds) const
  {
    return overSides(cell, [&](const CellSide& side) {
      return sumOf(sums_, slotOf(side, replicate, 0), roundSize_, band, rounds);
    });
  }
  /// What the cell gathered.
  double gathered(const CellSide& cell, int band, std::uint32_t replicate, std::size_t rounds) const
  {
    return !gathers(cell) ? 0.0 : overSides(cell, [&](const CellSide& side) {
      return sumOf(
        gathered_, gatheredPlace(slotOf(side, replicate, 0)), gatheredSize_, band, rounds);
    });
  }

  /// Replaces what the walks of a replicate brought in the first round.
  void set(const CellSide& cell, int band, std::uint32_t replicate, std::int64_t quanta)
  {
    sums_[slotOf(cell, replicate, 0) + static_cast<std::size_t>(band)] = quanta;
  }
  /// Replaces what a cell of the gatherers gathered for a replicate in the first round.
  void setGathered(const CellSide& cell, int band, std::uint32_t replicate, double quanta)
  {
    gathered_[gatheredPlace(slotOf(cell, replicate, 0)) + static_cast<std::size_t>(band)] = quanta;
  }
  /// Likewise, in all bands.
  void setGathered(const CellSide& cell, std::uint32_t replicate, const Bands& quanta)
  {
    std::copy_n(quanta.begin(), bands_, &gathered_[gatheredPlace(slotOf(cell, replicate, 0))]);
  }

  const CellNumbers& numbers() const { return numbers_; }
  int sides() const { return sides_; }
  int bands() const { return bands_; }
  const WalkPlan& plan() const { return plan_; }

private:
  /// Of the objects before this one, in a round.
  std::size_t slotsBefore(std::uint32_t object) const
  {
    return (object < numbers_.numberOfObjects() ? numbers_[{ object, 0 }] : numbers_.size()) *
      slotsPerCell();
  }
  /// Where the sum of a slot stands among those that are gathered.
  std::size_t gatheredPlace(std::size_t slot) const
  {
    const std::size_t round = roundSize_ > 0 ? slot / roundSize_ : 0;
    return round * gatheredSize_ + slot - round * roundSize_ - gatheredFirst_;
  }
  template <class Sum>
  std::invoke_result_t<Sum, std::uint32_t> overReplicates(const Sum& sum) const
  {
    std::invoke_result_t<Sum, std::uint32_t> total = 0;
    for (std::uint32_t replicate = 0; replicate < plan_.replicates().count(); ++replicate)
    {
      total += sum(replicate);
    }
    return total;
  }
  /// Of a side, or of both.
  template <class Sum>
  std::invoke_result_t<Sum, CellSide> overSides(const CellSide& cell, const Sum& sum) const
  {
    return cell.side == CellSide::kBoth && sides_ == 2
      ? sum(CellSide{ cell, 0 }) + sum(CellSide{ cell, 1 })
      : sum(cell);
  }
  template <class Number>
  static Number sumOf(const std::vector<Number>& sums, std::size_t first, std::size_t size,
    int band, std::size_t rounds)
  {
    Number total = 0;
    for (std::size_t round = 0; !sums.empty() && round < rounds; ++round)
    {
      total += sums[first + round * size + static_cast<std::size_t>(band)];
    }
    return total;
  }
  /// Sums of one side of a cell.
  std::size_t sideSize() const
  {
    return plan_.replicates().count() * static_cast<std::size_t>(bands_);
  }

  WalkPlan plan_;
  int sides_ = 2;
  int bands_ = 1;
  CellNumbers numbers_;
  std::vector<std::shared_ptr<const Material>> materials_;
  std::size_t rounds_ = 0;
  std::size_t roundSize_ = 0;      ///< sums of a round
  std::vector<std::int64_t> sums_; ///< none where all is gathered
  bool areShot_ = true;            ///< there is room for what walks bring
  CellPart gatherers_;
  std::size_t gatheredFirst_ = 0, gatheredSize_ = 0; ///< slots of the gatherers in a round
  std::vector<double> gathered_;
  /// Of consecutive parts of the sums, so that threads seldom wait for each other.
  static constexpr std::size_t kParts = 16;
  using Mutexes = std::array<std::mutex, kParts>;
  /// The part of a slot is the slot shifted down by this.
  unsigned partShift() const
  {
    return static_cast<unsigned>(64 - __builtin_clzll(sums_.size() / kParts + 1));
  }
  std::unique_ptr<Mutexes> mutexes_ = std::make_unique<Mutexes>();
};

}
