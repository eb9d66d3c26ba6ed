// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace irradiance
{

/// Values that live as long as this does.
using SharedValues = std::shared_ptr<const double[]>;

/**
 * The exposure that each replicate finds, and what their scatter tells of the error. Photons at
 * different times come from the same walks, so the errors of different times depend on each other;
 * replicates do not. See Documentation/Theory.md, 5.5.
 */
class ReplicateSums
{
public:
  ReplicateSums() = default;
  /// `values`: bands * cells.
  ReplicateSums(std::size_t values, int bands, int replicates)
    : bands_(static_cast<std::size_t>(bands))
    , replicates_(static_cast<std::size_t>(replicates))
    , exposures_(values * replicates_)
    , counts_(values)
  {
  }

  std::size_t count() const { return replicates_; }

  /// Adds a time. `irradiance`: of all walks. `replicates`: what each replicate says of it; the
  /// replicates of a cell come one after the other, each with all bands. `photons`: the irradiance
  /// that one photon is. W/m2.
  void add(
    const double* irradiance, const SharedValues& replicates, const double* photons, double weight);

  /// Ends the runs of all cells (see Counts): the next time that is added begins new ones.
  void endRuns() { before_ = nullptr; }
  /// Appends the sums over later times. `isShared`: their first time is the last one of these.
  void append(const ReplicateSums& next, bool isShared);

  /// What a replicate finds for the i-th value, J/m2.
  double& exposure(std::size_t i, std::size_t replicate)
  {
    return exposures_[firstOf(i) + replicate * bands_];
  }
  /// From now on the i-th value draws on the photons of others, too, and one of them effectively
  /// brings `photon` to it, J/m2.
  void drawOnPhotons(std::size_t i, double photon);

  /// The square of the standard error of a mean, from its terms.
  static double varianceOfMean(const std::vector<double>& terms);
  /// Of the i-th value, whose exposure is `exposure`; NaN where it is not known.
  double standardError(std::size_t i, double exposure) const;

private:
  /// What is known of the photons that a cell received in a band. A run is a span of time in which
  /// its replicates do not change, so that its photons are the same. One photon of a run, in all of
  /// it, is some J/m2.
  struct Counts
  {
    double firstRun = 0, lastRun = 0; ///< J/m2 of a photon; of a single run, the last
    double photonSquares = 0;         ///< sum of its squares over the runs between
    double firstPhotons = 0;          ///< in the first run
    double photons = 0;               ///< those that arrived, counted once in each run
    double photonTime = 0;            ///< number of photons * s
    double litTime = 0;               ///< s in which any arrived
    bool isOneRun = true;

    void beginRun();
    void append(const Counts& next, bool isShared);
  };

  std::size_t firstOf(std::size_t i) const
  {
    return i / bands_ * replicates_ * bands_ + i % bands_;
  }

  std::size_t bands_ = 0, replicates_ = 0;
  std::vector<double> exposures_; ///< J/m2, in the order of the arrays
  std::vector<Counts> counts_;
  std::vector<double>
    photons_; ///< see drawOnPhotons(); 0: the value draws on its own; empty: all do
  bool isBegun_ = false;
  SharedValues before_; ///< replicates of the last time; null: its runs have ended
};

}
