// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/WalkStarts.h"
#include "Sampling/WalkPlan.h"
#include "Tally/PowerBalance.h"

#include <memory>
#include <vector>

namespace irradiance
{

/// The static object alone.
constexpr CellPart kStaticPart{ 0, 1 };

/// The static part, and those that have all dynamic objects. When an object of one moves, all of
/// them gather anew. There are more of these the fewer cells there are, as each has sums for all
/// cells.
std::vector<CellPart> cellParts(const SceneObjects& objects);

/**
 * The direct light of the cells of one part of the scene, from the lights of one group, and the
 * walks that start where it arrived. It follows motions as long as none of its own cells moves.
 *
 * In the balance all that the lights emit is absorbed where the samples say that it arrives, or
 * escapes. The power of a walk that starts is taken from what is absorbed; from there on it counts
 * as other walks do.
 */
class DirectGather
{
public:
  struct Settings
  {
    CellPart part;
    std::uint32_t replicates;
    std::uint32_t firstWalk;    ///< the number of the first walk that may be born
    std::int64_t quantaPerWalk; ///< with which a walk starts, in all bands together
    double walksPerSample;      ///< that a cell may receive for each of its samples
    FewestSamples fewest;
    std::uint64_t seed;
    // DirectRounds sets these for each round.
    std::uint32_t walks = 0; ///< among which the flux of the lights is divided
    std::size_t round = 0;   ///< of the sums to which it adds
  };

  /// In which all is counted. Must outlive the call.
  struct Totals
  {
    CellSums& sums; ///< with room for the rounds
    PowerBalance& balance;
    const DealtBlocks& dealt; ///< the cells that this rank adds, dealt as blocks are
  };

  /// Gathers. The arguments must outlive it.
  DirectGather(
    const Frame& frame, const LampPieces& lamps, const Settings& settings, Execution& execution);
  DirectGather(const DirectGather&) = delete;
  DirectGather& operator=(const DirectGather&) = delete;

  /// What each sample brings, and whether it does.
  const DirectLight& light() const { return light_; }
  std::size_t bytes() const
  {
    return cells_.bytes() + plan_.numberOfCells() * sizeof(std::uint32_t) + light_.bytes() +
      starts_.bytes();
  }
  const WalkStarts& starts() const { return starts_; }
  /// Of all that the cells gather, quanta squared: see DirectLight::variance().
  double variance(int band) const
  {
    return quantaPerWatt_ * quantaPerWatt_ * light_.variance()[static_cast<std::size_t>(band)];
  }

  /// Adds what was gathered, or with `sign` -1 takes it away.
  void addTo(const Totals& totals, int sign, const CancelPoint& cancelPoint) const;
  /// Follows a motion of other objects, see DirectLight::follow(), and changes the totals. Returns
  /// the walks, in order, that are born now and were not before, or the other way round.
  std::vector<std::uint32_t> follow(const Frame& frame, const Totals& totals, Execution& execution);

private:
  /// What cells receive now, and did not before.
  static void count(const Power& power, PowerBalance& balance);

  Settings settings_;
  const SceneTriangles& triangles_;
  const LampPieces& lamps_;
  double quantaPerWatt_;
  CellShapes cells_;
  DirectPlan plan_;
  DirectLight light_;
  WalkStarts starts_;
};

/// What the cells of a part of the scene gather, round by round. Each round has samples and walks
/// of its own, so what rounds bring adds up, as with walks that start at the lights.
class DirectRounds
{
public:
  explicit DirectRounds(const DirectGather::Settings& settings)
    : settings_(settings)
    , plan_(Replicates(settings.replicates, settings.firstWalk))
  {
  }

  /// Gathers for a further round, in which so many `walks` divide the flux of the lights.
  void append(
    const Frame& frame, const LampPieces& lamps, std::uint32_t walks, Execution& execution);
  /// Takes away what all but the first `kept` rounds gathered. Their walks must have been taken
  /// back.
  void drop(std::size_t kept, const DirectGather::Totals& totals, const CancelPoint& cancelPoint);
  /// Follows a motion, see DirectLight::follow(), and changes the totals. Returns the walks, in
  /// order, that are born now and were not before, or the other way round.
  std::vector<std::uint32_t> follow(
    const Frame& frame, const DirectGather::Totals& totals, Execution& execution);

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
