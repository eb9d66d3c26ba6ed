// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectRounds_h
#define irradiance_DirectRounds_h

#include "DirectLight/DirectGather.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// What the cells of a part of the scene gather, round by round. Each round has samples and walks
/// of its own, so what rounds bring adds up, as with walks that start at the lights.
class DirectRounds
{
public:
  /// In which all is counted. Must outlive the call.
  struct Totals
  {
    CellSums& sums; ///< with room for the rounds
    PowerBalance& balance;
    const DealtBlocks& dealt; ///< what this rank adds, see DirectGather
  };

  explicit DirectRounds(const DirectGather::Settings& settings)
    : settings_(settings)
    , plan_(Replicates(settings.replicates, settings.firstWalk))
  {
  }

  /// Gathers for a further round, in which so many `walks` divide the flux of the lights.
  void append(
    const Frame& frame, const LampPieces& lamps, std::uint32_t walks, Execution& execution);
  /// Adds what was gathered for a round.
  void addTo(const Totals& totals, std::size_t round, const CancelPoint& cancelPoint) const;
  /// Takes away what all but the first `kept` rounds gathered. Their walks must have been taken
  /// back.
  void drop(std::size_t kept, const Totals& totals, const CancelPoint& cancelPoint);
  /// Follows a motion, see DirectGather::follow(), and changes the totals. Returns the walks, in
  /// order, that are born now and were not before, or the other way round.
  std::vector<std::uint32_t> follow(const Frame& frame, const Totals& totals, Execution& execution);

  /// Of the walks that may be born in the rounds so far.
  const WalkPlan& plan() const { return plan_; }
  std::int64_t quantaPerWalk() const { return settings_.quantaPerWalk; }
  const std::vector<std::unique_ptr<DirectGather>>& rounds() const { return rounds_; }
  const WalkStarts& startsOf(std::uint32_t walk) const
  {
    return rounds_[plan_.roundOf(walk)]->starts();
  }
  bool isBorn(std::uint32_t walk) const { return startsOf(walk).isBorn(walk); }
  /// With which it starts.
  const Power& powerOf(std::uint32_t walk) const { return startsOf(walk)[walk].power; }
  const DirectSample& sampleOf(std::uint32_t walk) const
  {
    const WalkStarts& starts = startsOf(walk);
    return starts.sampleOf(starts[walk]);
  }

private:
  DirectGather::Settings settings_; ///< of the first round
  WalkPlan plan_;
  std::vector<std::unique_ptr<DirectGather>> rounds_;
};

}

#endif
