// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/LampChoice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// With how many samples cells gather direct light at least; rounded up.
struct FewestSamples
{
  std::uint32_t small = 4; ///< >= 1
  std::uint32_t large = 4; ///< of cells that may receive four walks or more for each of `small`
  /// In place of `small` if there are few cells, for a share of the time that the walks take; 0:
  /// not decided.
  std::uint32_t mostOfSmall = 0;
  /// Of a sky to which the rays of all cells escape, for these and those; 0: as of other lights.
  std::uint32_t ofSky = 0;

  /// If not decided: as many as pay in the end, as of static cells, which gather once.
  FewestSamples asMany() const { return with(64); }
  /// If not decided: as what walks bring is noisy as well, as many as lights of this variance of a
  /// sample, see DirectPilot, need beside it.
  FewestSamples atVariance(double variance) const
  {
    constexpr double kLeast = 8, kMost = 32;
    return with(static_cast<std::uint32_t>(std::clamp(160 * std::sqrt(variance), kLeast, kMost)));
  }

  friend bool operator==(const FewestSamples& a, const FewestSamples& b)
  {
    return a.small == b.small && a.large == b.large && a.mostOfSmall == b.mostOfSmall &&
      a.ofSky == b.ofSky;
  }

private:
  FewestSamples with(std::uint32_t most) const
  {
    return { small, large, mostOfSmall > 0 ? mostOfSmall : most, ofSky };
  }
};

/**
 * How many samples each cell takes to gather its direct light, numbered through all cells.
 *
 * A cell takes as many as the power that it may receive calls for, beside the power of a walk, if
 * it is more than the fewest: samples stand where walks would arrive, and grow in number with the
 * walks. A mirror takes one for each walk that may start there, as walks of one sample would fly
 * the same way. Occluders do not matter to it. The numbers are the number of replicates times a
 * power of two; each replicate has samples that follow each other, so that they are a net of their
 * own.
 */
class DirectPlan
{
public:
  struct Settings
  {
    std::uint32_t walks;   ///< among which the flux of the lights is divided
    double walksPerSample; ///< that a cell may receive for each of its samples
    FewestSamples fewest;
    std::uint32_t replicates;
    double startsPerWalk =
      0; ///< walks that start at cells with the power of each of `walks`; 0: none
  };

  DirectPlan(const CellShapes& cells, const LampPieces& lamps, const Settings& settings,
    const CancelPoint& cancelPoint = {});

  std::size_t numberOfCells() const { return firsts_.size() - 1; }
  /// None of a cell that is not there, or dark on both sides.
  std::uint32_t samplesOf(std::size_t cell) const { return firsts_[cell + 1] - firsts_[cell]; }
  std::uint32_t first(std::size_t cell) const { return firsts_[cell]; }
  std::uint32_t size() const { return firsts_.back(); }
  std::size_t cellOf(std::uint32_t sample) const
  {
    return static_cast<std::size_t>(
      std::upper_bound(firsts_.begin(), firsts_.end(), sample) - firsts_.begin() - 1);
  }
  /// `sample`: among the samples of the cell.
  std::uint32_t replicateOf(std::size_t cell, std::uint32_t sample) const
  {
    return replicates_ == 1 ? 0 : sample / (samplesOf(cell) / replicates_);
  }
  std::uint32_t replicates() const { return replicates_; }

private:
  static constexpr double kMost = 65536, kMostOfMirror = 1048576;

  static std::uint32_t fewestOfSmall(const CellShapes& cells, const Settings& settings);
  /// Of a cell that may receive so many walks, and mirrors so many for each.
  std::uint32_t numberFor(double walks, double mirrored = 0) const;

  std::uint32_t replicates_;
  double walksPerSample_;
  FewestSamples fewest_;
  std::vector<std::uint32_t> firsts_; ///< by cell, and the number of all
};

}
