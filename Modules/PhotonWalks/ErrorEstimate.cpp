#include "ErrorEstimate.h"

#include "StudentT.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace irradiance
{

ErrorEstimate::ErrorEstimate(const CellSums& sums, const WalkPlan& plan, std::size_t rounds,
  const std::array<double, Power::kMaxBands>& photon)
  : sums_(sums)
  , rounds_(rounds)
  , walks_(plan.rounds()[rounds - 1].endWalk)
  , photon_(photon)
{
  double squares = 0;
  for (std::uint32_t replicate = 0; replicate < plan.deal().replicates(); ++replicate)
  {
    share_.push_back(double(plan.deal().share(replicate, walks_)) / walks_);
    squares += share_.back() * share_.back();
  }
  unbiased_ = 1 / (1 - squares);
}

double ErrorEstimate::confidenceFactor(std::uint32_t replicates)
{
  return studentQuantile(kConfidence, static_cast<int>(replicates) - 1);
}

double ErrorEstimate::standardError(
  std::uint32_t object, std::size_t cell, int side, int band) const
{
  const auto replicates = static_cast<std::uint32_t>(share_.size());
  const std::int64_t total = sum({ object, cell, side, 0 }, band);
  const double photon = photon_[static_cast<std::size_t>(band)];
  if (replicates < 2 || walks_ < kFewestPhotons || total == 0 ||
    static_cast<double>(total) < kFewestPhotons * photon)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double squares = 0;
  for (std::uint32_t i = 0; i < replicates; ++i)
  {
    const double off = static_cast<double>(sums_.sum(object, cell, side, band, i, rounds_)) -
      share_[i] * static_cast<double>(total);
    squares += off * off;
  }
  // Sums come in steps of a photon, so that replicates may agree by chance: the variance within a
  // step is the least that can be claimed.
  return std::sqrt(std::max(unbiased_ * squares, replicates * photon * photon / 12));
}

std::int64_t ErrorEstimate::sum(const CellSide& part, int band) const
{
  std::int64_t total = 0;
  for (std::uint32_t i = 0; i < share_.size(); ++i)
  {
    total += sums_.sum(part.object, part.cell, part.side, band, i, rounds_);
  }
  return total;
}

double ErrorEstimate::relativeError(const CellSide& part, int band, double mean) const
{
  const double photon = photon_[static_cast<std::size_t>(band)];
  if (photon == 0)
  {
    return 0; // no light has this band
  }
  const auto received = static_cast<double>(sum(part, band));
  if (received == 0)
  {
    return 3 * photon / (mean * part.area); // a mean of 3 photons gives none in 5 % of all cases
  }
  const double error = standardError(part.object, part.cell, part.side, band);
  return std::isnan(error)
    ? std::numeric_limits<double>::infinity()
    : confidenceFactor(static_cast<std::uint32_t>(share_.size())) * error / received;
}

double ErrorEstimate::relativeErrorOfMostArea(const SceneObjects& objects) const
{
  const int bands = objects.fixed.surface->bands;
  std::vector<CellSide> parts;
  std::array<double, Power::kMaxBands> received{};
  double area = 0;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      for (int side = 0; side < sums_.sides() && areas[cell] > 0; ++side)
      {
        parts.push_back({ object, cell, side, areas[cell] });
        area += areas[cell];
        for (int band = 0; band < bands; ++band)
        {
          received[static_cast<std::size_t>(band)] += static_cast<double>(sum(parts.back(), band));
        }
      }
    }
  }
  std::vector<std::pair<double, double>> errors; // with the area
  for (const CellSide& part : parts)
  {
    double worst = 0;
    for (int band = 0; band < bands; ++band)
    {
      worst =
        std::max(worst, relativeError(part, band, received[static_cast<std::size_t>(band)] / area));
    }
    errors.emplace_back(worst, part.area);
  }
  std::sort(errors.begin(), errors.end());
  double within = 0;
  for (const auto& [error, itsArea] : errors)
  {
    within += itsArea;
    if (within >= kConfidence * area)
    {
      return error;
    }
  }
  return 0; // nothing has an area
}

}
