// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Exposure/IntegrationTimes.h"
#include "Exposure/ReplicateSums.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
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
    double time, std::vector<std::vector<Side>> sides, const std::vector<ExposureBlock>& blocks)
    : time_(time)
    , sides_(std::move(sides))
    , powers_(sides_.size())
  {
    for (std::size_t i = 0; i < sides_.size(); ++i)
    {
      for (const Side& side : sides_[i])
      {
        double power = 0;
        for (std::size_t k = 0; k < blocks[i].areas.size() * side.bands; ++k)
        {
          power += blocks[i].areas[k / side.bands] * side.irradiance.get()[k];
        }
        powers_[i] += power;
      }
    }
  }

  /// Of the trapezoids between three times, on each block. Its error: by how much it differs from
  /// one trapezoid over both intervals, summed up over cells, sides and bands, in so far as photons
  /// that arrive by chance do not explain it.
  using Three = std::array<const ExposureNode*, 3>;
  static std::vector<IntervalMeasure> measure(
    const Three& nodes, const std::vector<ExposureBlock>& blocks)
  {
    const double start = nodes[0]->time_, middle = nodes[1]->time_, end = nodes[2]->time_;
    const std::array<double, 3> weights = differenceWeights(start, middle, end);
    const std::array<double, 3> parts{ middle - start, end - start, end - middle };
    std::vector<IntervalMeasure> measures(blocks.size());
    for (std::size_t block = 0; block < blocks.size(); ++block)
    {
      std::size_t sides = 0;
      for (std::size_t node = 0; node < nodes.size(); ++node)
      {
        measures[block].energy += 0.5 * parts[node] * nodes[node]->powers_[block];
        sides = std::max(sides, nodes[node]->sides_[block].size());
      }
      for (std::size_t side = 0; side < sides; ++side)
      {
        addDifference(nodes, weights, block, side, blocks[block].areas, measures[block]);
      }
    }
    return measures;
  }

private:
  /// How two trapezoids between three times differ from one: a weighted sum of the values at these
  /// times.
  static std::array<double, 3> differenceWeights(double start, double middle, double end)
  {
    const double length = end - start, before = middle - start, after = end - middle;
    // As large as the error can be if something appears anywhere between the times.
    const double scale = 0.5 * length * std::max(before / after, after / before);
    return { -scale * after / length, scale, -scale * before / length };
  }
  /// Of the values 0 to n - 1, pairs of neighbours are added up; a last one without neighbour stays.
  static void addPairs(std::vector<double>& values, std::size_t n)
  {
    for (std::size_t i = 0; i < n / 2; ++i)
    {
      values[i] = values[2 * i] + values[2 * i + 1];
    }
    if (n % 2 == 1)
    {
      values[n / 2] = values[n - 1];
    }
  }
  /**
   * Adds up the sizes of differences: `error` gains what the noise of photons does not explain,
   * `noise` the rest. `variances`: what the differences would have if all photons arrived
   * independently; 0: there is no noise. Neighbours in the vectors should be neighbours in space.
   *
   * A difference is signal as far as it exceeds some standard deviations. Much light that is off by
   * little hides in the noise of single values, but not in the noise of their sums. So values are
   * also taken together, by two, four, eight, up to all; the grouping with the most signal counts.
   */
  static void splitDifference(
    std::vector<double> differences, std::vector<double> variances, IntervalMeasure& measure)
  {
    constexpr double deviations = 3; // by chance, 0.0008 deviations are beyond on the average
    double all = 0, signal = 0;
    for (const double difference : differences)
    {
      all += std::abs(difference);
    }
    for (std::size_t n = differences.size(); n > 0; n = n == 1 ? 0 : n - n / 2)
    {
      double beyond = 0;
      for (std::size_t i = 0; i < n; ++i)
      {
        beyond += std::max(0.0, std::abs(differences[i]) - deviations * std::sqrt(variances[i]));
      }
      signal = std::max(signal, beyond);
      addPairs(differences, n);
      addPairs(variances, n);
    }
    signal = std::min(signal, all); // sums are rounded
    measure.error += signal;
    measure.noise += all - signal;
  }
  /// Adds the weighted sum of the nodes to the error and the noise of a measure, J.
  static void addDifference(const Three& nodes, const std::array<double, 3>& weights,
    std::size_t block, std::size_t side, const std::vector<double>& areas, IntervalMeasure& measure)
  {
    std::vector<double> differences, variances;
    for (std::size_t node = 0; node < nodes.size(); ++node)
    {
      if (side >= nodes[node]->sides_[block].size())
      {
        continue; // no cells, so no irradiance
      }
      const Side& values = nodes[node]->sides_[block][side];
      const std::size_t bands = values.bands;
      const double* irradiance = values.irradiance.get();
      const double* photon = values.photon.get();
      differences.resize(areas.size() * bands);
      variances.resize(areas.size() * bands);
      for (std::size_t i = 0; i < areas.size() * bands; ++i)
      {
        const std::size_t value =
          i % bands * areas.size() + i / bands; // bands apart, as cells are neighbours
        const double weight = weights[node] * areas[i / bands];
        differences[value] += weight * irradiance[i];
        // n photons vary by sqrt(n).
        variances[value] += photon ? weight * weight * irradiance[i] * photon[i] : 0;
      }
    }
    splitDifference(std::move(differences), std::move(variances), measure);
  }

  double time_;
  std::vector<std::vector<Side>> sides_;
  std::vector<double> powers_; ///< of each block, W: of all cells, sides and bands
};

}
