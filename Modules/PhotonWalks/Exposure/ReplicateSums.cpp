// SPDX-License-Identifier: BSD-3-Clause
#include "Exposure/ReplicateSums.h"

#include "Estimates/ErrorEstimate.h"

#include <cmath>
#include <limits>

namespace irradiance
{

void ReplicateSums::Counts::beginRun()
{
  if (isOneRun)
  {
    firstRun = lastRun;
    isOneRun = false;
  }
  else
  {
    photonSquares += lastRun * lastRun;
  }
  lastRun = 0;
}

void ReplicateSums::Counts::append(const Counts& next, bool isShared)
{
  if (!isShared)
  {
    beginRun();
  }
  lastRun += next.isOneRun ? next.lastRun : next.firstRun;
  if (!next.isOneRun)
  {
    beginRun();
    photonSquares += next.photonSquares;
    lastRun = next.lastRun;
  }
  photons += isShared ? next.photons - next.firstPhotons : next.photons;
  photonTime += next.photonTime;
  litTime += next.litTime;
}

void ReplicateSums::append(const ReplicateSums& next, bool isShared)
{
  for (std::size_t i = 0; i < exposures_.size(); ++i)
  {
    exposures_[i] += next.exposures_[i];
  }
  for (std::size_t i = 0; i < counts_.size(); ++i)
  {
    counts_[i].append(next.counts_[i], isShared);
  }
  before_ = next.before_;
}

void ReplicateSums::add(
  const double* irradiance, const SharedValues& replicates, const double* photons, double weight)
{
  const double* now = replicates.get();
  const double* before = before_.get();
  for (std::size_t i = 0; i < exposures_.size(); ++i)
  {
    exposures_[i] += weight * now[i];
  }
  for (std::size_t i = 0; i < counts_.size(); ++i)
  {
    Counts& counts = counts_[i];
    const double number = photons[i] > 0 ? irradiance[i] / photons[i] : 0;
    bool isSame = before != nullptr;
    for (std::size_t r = 0; r < replicates_ && isSame; ++r)
    {
      isSame = now[firstOf(i) + r * bands_] == before[firstOf(i) + r * bands_];
    }
    if (!isBegun_)
    {
      counts.firstPhotons = counts.photons = number;
    }
    else if (!isSame)
    {
      counts.beginRun();
      counts.photons += number;
    }
    counts.lastRun += weight * photons[i];
    counts.photonTime += weight * number;
    counts.litTime += number > 0 ? weight : 0;
  }
  before_ = replicates;
  isBegun_ = true;
}

void ReplicateSums::drawOnPhotons(std::size_t i, double photon)
{
  photons_.resize(counts_.size());
  photons_[i] = photon;
}

double ReplicateSums::varianceOfMean(const std::vector<double>& terms)
{
  const auto number = static_cast<double>(terms.size());
  double mean = 0, squares = 0;
  for (const double term : terms)
  {
    mean += term / number;
  }
  for (const double term : terms)
  {
    squares += std::pow(term - mean, 2);
  }
  return squares / (number * (number - 1));
}

double ReplicateSums::standardError(std::size_t i, double exposure) const
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  constexpr double fewest = ErrorEstimate::kFewestPhotons * (1 - 1e-9); // numbers are rounded
  const Counts& counts = counts_[i];
  const bool drawsOnOthers = !photons_.empty() && photons_[i] > 0;
  const bool maySuffice =
    drawsOnOthers ? exposure >= fewest * photons_[i] : counts.photons >= fewest;
  if (replicates_ < 2 || !maySuffice)
  {
    return unknown;
  }
  const double firstRun = counts.isOneRun ? 0 : counts.firstRun;
  const double photonSquares = drawsOnOthers
    ? photons_[i] * photons_[i]
    : firstRun * firstRun + counts.photonSquares + counts.lastRun * counts.lastRun;
  std::vector<double> exposures(replicates_);
  for (std::size_t r = 0; r < replicates_; ++r)
  {
    exposures[r] = exposures_[firstOf(i) + r * bands_];
  }
  const double variance = ErrorEstimate::variance(
    varianceOfMean(exposures), static_cast<double>(replicates_) * photonSquares);
  const bool doPhotonsSuffice = !drawsOnOthers && counts.photonTime >= fewest * counts.litTime;
  return doPhotonsSuffice || exposure * exposure >= ErrorEstimate::kFewestPhotons * variance
    ? std::sqrt(variance)
    : unknown;
}

}
