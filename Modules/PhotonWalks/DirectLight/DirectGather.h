// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_DirectGather_h
#define irradiance_DirectGather_h

#include "DirectLight/CellPart.h"
#include "DirectLight/WalkStarts.h"
#include "Sampling/WalkPlan.h"
#include "Tally/PowerBalance.h"

namespace irradiance
{

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
    std::uint32_t walks; ///< among which the flux of the lights is divided
    std::uint32_t replicates;
    std::int64_t quantaPerWalk; ///< with which a walk starts, in all bands together
    DirectPlan::Density density;
    std::uint32_t firstWalk; ///< the number of the first walk that may be born
    std::uint64_t seed;
    std::size_t round; ///< of the sums to which it adds
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
  double quantaPerWatt() const { return quantaPerWatt_; }
  const WalkStarts& starts() const { return starts_; }
  /// Of all that the cells gather, quanta squared: see DirectLight::variance().
  double variance(int band) const
  {
    return quantaPerWatt_ * quantaPerWatt_ * light_.variance()[static_cast<std::size_t>(band)];
  }

  /// Adds what was gathered, or with `sign` -1 takes it away. Of several ranks each does so for the
  /// cells that are dealt to it as blocks are.
  void addTo(CellSums& sums, PowerBalance& balance, const DealtBlocks& dealt, int sign,
    const CancelPoint& cancelPoint) const;

  /// The samples that a motion of other objects changed. See DirectLight::follow().
  std::vector<std::uint32_t> follow(const Frame& frame, Execution& execution)
  {
    return light_.follow(frame, execution);
  }
  /// Adds what these samples bring now, or takes away what they brought.
  void change(const std::vector<std::uint32_t>& samples, CellSums& sums, PowerBalance& balance,
    const DealtBlocks& dealt) const;

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

}

#endif
