// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ExposureNode_h
#define irradiance_ExposureNode_h

#include "Exposure/IntegrationTimes.h"
#include "Exposure/ReplicateSums.h"

#include <array>
#include <string>
#include <vector>

namespace irradiance
{

/// A block over all times.
struct ExposureBlock
{
  std::string name;          ///< for messages
  std::vector<double> areas; ///< of its cells, m2; empty: there were none yet
};

/// The irradiance of all cells at one time.
class ExposureNode
{
public:
  /// A side of the cells of a block, or both together.
  struct Side
  {
    std::size_t bands;
    SharedValues irradiance, photon; ///< W/m2; `photon`: null if it is not known
  };

  /// `sides`: of each block, none without cells.
  ExposureNode(
    double time, std::vector<std::vector<Side>> sides, const std::vector<ExposureBlock>& blocks);

  /// Of the trapezoids between three times, on each block. Its error: by how much it differs from
  /// one trapezoid over both intervals, summed up over cells, sides and bands, in so far as photons
  /// that arrive by chance do not explain it.
  using Three = std::array<const ExposureNode*, 3>;
  static std::vector<IntervalMeasure> measure(
    const Three& nodes, const std::vector<ExposureBlock>& blocks);

private:
  /// Adds the weighted sum of the nodes to the error and the noise of a measure, J.
  static void addDifference(const Three& nodes, const std::array<double, 3>& weights,
    std::size_t block, std::size_t side, const std::vector<double>& areas,
    IntervalMeasure& measure);

  double time_;
  std::vector<std::vector<Side>> sides_;
  std::vector<double> powers_; ///< of each block, W: of all cells, sides and bands
};

}

#endif
