// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Execution/Execution.h"
#include "Tally/CellSums.h"

#include <algorithm>
#include <array>
#include <optional>

namespace irradiance
{

/// Probability that |T| <= t, with Student's distribution of `freedom` >= 1 degrees; t >= 0.
double studentProbability(double t, int freedom);

/// The t that |T| does not exceed with `probability`, 0 < probability < 1.
double studentQuantile(double probability, int freedom);

/// What knows on how many photons estimates of cells draw that are not the cells' own sums.
class PhotonShares
{
public:
  virtual ~PhotonShares() = default;
  /// A photon's effective part in the estimate of a cell, 0..1: the estimate draws on 1 / this for
  /// each photon that the cell expects.
  virtual double photonShare(const CellSide& cell) const = 0;
  /// The variance of its estimate that comes of the rays of the cell, quanta^2; nothing if it casts
  /// none.
  virtual std::optional<double> rayVariance(const CellSide& /*cell*/, int /*band*/) const
  {
    return {};
  }
};

/// How far the area is from a target. Promises are parts of the variance, times the area, summed up
/// over what lies between the target and `reached`: what is worse is not needed.
struct TargetMiss
{
  /// The least e for which kConfidence of the area is known to within e times its own irradiance,
  /// with probability kConfidence; infinite if there is none. A cell that received nothing is known
  /// to within 3 photons; its e is 3 photons over what its area receives on average. The worst band
  /// of a cell counts, and each side alone if they are kept apart.
  double reached = 0;
  double byWalks = 0;    ///< what twice the walks take away
  double byRays = 0;     ///< what twice the rays of cells that gather take away
  double beyondRays = 0; ///< the part of the area that misses the target and casts no rays
};

/**
 * Estimates the error of the cell sums from the replicates of the first rounds of walks. The same
 * integers give the same bits: all is summed up in the order of replicates and cells.
 *
 * With few photons the spread of the replicates is skewed, and too small where the sum is too small
 * by chance. Then the error counts as unknown. See Documentation/Theory.md, 5.1.
 */
class ErrorEstimate
{
public:
  /// Photons of full power that a cell has to receive before its error is known.
  static constexpr double kFewestPhotons = 25;
  /// Probability with which the truth lies in the interval, and the part of the area that has to
  /// reach a target.
  static constexpr double kConfidence = 0.95;

  /// `quantaPerWalk`: of the most powerful walk at its start, in each band. `shares`: what made the
  /// sums, if they are not what arrived; the errors are of the sums as they are, which are not the
  /// truth where these are biased. `sums` and `shares` must outlive the estimate.
  ErrorEstimate(const CellSums& sums, const WalkPlan& plan, std::size_t rounds,
    const Bands& quantaPerWalk, const PhotonShares* shares = nullptr);

  /// The variance of what n replicates tell, from their spread. What they tell comes in steps, as
  /// photons do, so replicates may agree by chance: the variance within a step is the least that
  /// can be claimed. `squaredSteps`: n * a squared step, or the sum of several.
  static double variance(double spread, double squaredSteps)
  {
    return std::max(spread, squaredSteps / 12);
  }

  /// Half the width of the interval of kConfidence, in standard errors: Student's t.
  static double confidenceFactor(std::uint32_t replicates);

  /// Of a cell's sum, in quanta; NaN where too few photons arrived.
  double standardError(const CellSide& cell, int band) const { return received(cell, band).error; }

  std::uint32_t replicates() const { return static_cast<std::uint32_t>(share_.size()); }
  /// What one replicate alone says of a cell's sum, in quanta: its own, over its share of the
  /// walks.
  double ofReplicate(const CellSide& cell, int band, std::uint32_t replicate) const
  {
    return sums_.sum(cell, band, replicate, rounds_) / share_[replicate];
  }
  /// What one photon of full power effectively brings to a cell, in quanta.
  double quantaPerPhoton(const CellSide& cell, int band) const
  {
    return quantaPerWalk_[static_cast<std::size_t>(band)] *
      (shares_ ? shares_->photonShare(cell) : 1.0);
  }

  /// `areSidesApart`: the sides of cells count each alone.
  TargetMiss missOf(
    double target, const SceneCells& cells, bool areSidesApart, Execution& execution) const;

private:
  /// What a cell, or one of its sides, has received in a band, its standard error, and what one
  /// photon of full power effectively brings to it; quanta. `spread`: the variance that the
  /// replicates show.
  struct Received
  {
    double quanta, error, quantaPerPhoton, spread;
  };
  struct Part
  {
    CellSide cell;
    double area; ///< m2
    std::array<Received, Power::kMaxBands> received{};
    // In its worst band:
    double error = 0;
    bool castsRays = false;
    double ofRays = 0; ///< the part of its variance that comes of rays
  };
  Received received(const CellSide& cell, int band) const;
  /// All cells, or sides of cells, that have an area.
  std::vector<Part> partsOf(
    const SceneCells& cells, bool areSidesApart, Execution& execution) const;
  /// Sets what is said of the worst bands.
  void judge(std::vector<Part>& parts) const;
  double partOfRays(const Received& received, double rayVariance) const;
  /// `average`: quanta that a cell of this area receives on average. `factor`: confidenceFactor().
  static double relativeError(const Received& received, double average, double factor);

  const CellSums& sums_;
  const PhotonShares* shares_;
  std::size_t rounds_;
  std::uint32_t walks_;
  Bands quantaPerWalk_;
  std::vector<double> share_; ///< of each replicate in the walks
  double unbiased_;           ///< 1 / (1 - sum of the squared shares)
};

}
