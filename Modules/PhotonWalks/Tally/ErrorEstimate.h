// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ErrorEstimate_h
#define irradiance_ErrorEstimate_h

#include "Execution/Execution.h"
#include "Tally/CellSums.h"

#include <array>

namespace irradiance
{

/**
 * What the replicates of the first rounds of walks tell about the error of the cell sums. The same
 * integers give the same bits: all is summed up in the order of replicates and cells.
 *
 * With fewer photons the spread of the replicates is skewed, and too small where the sum is too small
 * by chance: then nothing is told. See Theory, 5.1.
 */
class ErrorEstimate
{
public:
  /// Photons of full power that a cell has to receive, before its error is known.
  static constexpr double kFewestPhotons = 25;
  /// Probability with which the truth lies in the interval, and the part of the area for which a
  /// target is to be reached.
  static constexpr double kConfidence = 0.95;

  /// `photon`: quanta with which the most powerful walk starts, in each band. `sums` must outlive
  /// the estimate.
  ErrorEstimate(const CellSums& sums, const WalkPlan& plan, std::size_t rounds,
    const std::array<double, Power::kMaxBands>& photon);

  /// Half of the interval of kConfidence is so many standard errors: Student's t.
  static double confidenceFactor(std::uint32_t replicates);

  /// Of a cell's sum, in quanta; NaN where too few photons tell too little.
  double standardError(std::uint32_t object, std::size_t cell, int side, int band) const
  {
    return received(object, cell, side, band).error;
  }

  /// The least e such that kConfidence of the area is known to e times its own irradiance, with
  /// kConfidence; infinite if there is none. What has received nothing is known to 3 photons, of
  /// which e is then the ratio to what an area of this size receives on average. The worst band of a
  /// cell counts, each side by itself if they are kept apart.
  double relativeErrorOfMostArea(const SceneObjects& objects, Execution& execution) const;

private:
  /// What a cell, or one of its sides, has received in a band, and its standard error; quanta.
  struct Received
  {
    double quanta, error;
  };
  struct CellSide
  {
    std::uint32_t object;
    std::size_t cell;
    int side;
    double area; ///< m2
    std::array<Received, Power::kMaxBands> received{};
  };
  Received received(std::uint32_t object, std::size_t cell, int side, int band) const;
  /// All with an area.
  std::vector<CellSide> cellSides(const SceneObjects& objects, Execution& execution) const;
  /// `average`: quanta that an area of this size receives on average. `factor`: confidenceFactor().
  double relativeError(const Received& received, int band, double average, double factor) const;

  const CellSums& sums_;
  std::size_t rounds_;
  std::uint32_t walks_;
  std::array<double, Power::kMaxBands> photon_;
  std::vector<double> share_; ///< of each replicate in the walks
  double unbiased_;           ///< 1 / (1 - sum of the squared shares)
};

}

#endif
