// SPDX-License-Identifier: BSD-3-Clause
#include "ReplicateSums.h"

#include "Tally/ErrorEstimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiance
{

void ReplicateSums::add(
  const double* irradiance, vtkDoubleArray* replicates, vtkDoubleArray* photons, double weight)
{
  const double* now = replicates->GetPointer(0);
  const double* before = before_ ? before_->GetPointer(0) : nullptr;
  const double* photon = photons->GetPointer(0);
  for (std::size_t i = 0; i < exposures_.size(); ++i)
  {
    exposures_[i] += weight * now[i];
  }
  for (std::size_t i = 0; i < counts_.size(); ++i)
  {
    Counts& counts = counts_[i];
    const double number = photon[i] > 0 ? irradiance[i] / photon[i] : 0;
    bool isSame = before != nullptr;
    for (std::size_t r = 0; r < replicates_ && isSame; ++r)
    {
      isSame = now[firstOf(i) + r * bands_] == before[firstOf(i) + r * bands_];
    }
    if (!isSame)
    {
      counts.photonSquares += counts.runPhoton * counts.runPhoton;
      counts.runPhoton = 0;
      counts.photons += number;
    }
    counts.runPhoton += weight * photon[i];
    counts.photonTime += weight * number;
    counts.litTime += number > 0 ? weight : 0;
  }
  before_ = replicates;
}

double ReplicateSums::standardError(std::size_t i, double exposure) const
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  constexpr double fewest = ErrorEstimate::kFewestPhotons * (1 - 1e-9); // numbers are rounded
  const Counts& counts = counts_[i];
  if (replicates_ < 2 || counts.photons < fewest)
  {
    return unknown;
  }
  const auto number = static_cast<double>(replicates_);
  double mean = 0, squares = 0;
  for (std::size_t r = 0; r < replicates_; ++r)
  {
    mean += exposures_[firstOf(i) + r * bands_] / number;
  }
  for (std::size_t r = 0; r < replicates_; ++r)
  {
    squares += std::pow(exposures_[firstOf(i) + r * bands_] - mean, 2);
  }
  const double photonSquares = counts.photonSquares + counts.runPhoton * counts.runPhoton;
  const double variance = std::max(squares / (number * (number - 1)), number * photonSquares / 12);
  const bool hasMany = counts.photonTime >= fewest * counts.litTime;
  return hasMany || exposure * exposure >= ErrorEstimate::kFewestPhotons * variance
    ? std::sqrt(variance)
    : unknown;
}

}
