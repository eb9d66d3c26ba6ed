// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatheringBias_h
#define irradiance_GatheringBias_h

#include <cmath>
#include <limits>
#include <vector>

namespace irradiance
{

/// By which part the mean irradiance of the cells that gather is expected to be too large, as their
/// rays read means of cells; an estimate from checks.
struct GatheringBias
{
  double mean = std::numeric_limits<double>::quiet_NaN();
  /// From the variance between replicates.
  double standardError = std::numeric_limits<double>::quiet_NaN();
};

/// `excess`: what all cells receive too much, by replicate. `received`: what they do receive, in
/// all replicates. Not known without replicates, or where nothing is received.
inline GatheringBias gatheringBiasOf(const std::vector<double>& excess, double received)
{
  const auto count = static_cast<double>(excess.size());
  double sum = 0, squares = 0;
  for (const double part : excess)
  {
    sum += part;
  }
  for (const double part : excess)
  {
    squares += std::pow(count * part - sum, 2);
  }
  return excess.size() > 1 && received > 0
    ? GatheringBias{ sum / received, std::sqrt(squares / (count * (count - 1))) / received }
    : GatheringBias{};
}

}

#endif
