// SPDX-License-Identifier: BSD-3-Clause
#include "Estimates/ErrorEstimate.h"

#include <cmath>

namespace irradiance
{

namespace
{

/// The least error that parts with this total area do not exceed.
template <class Parts>
double quantileOfArea(const Parts& parts, double area)
{
  std::vector<std::pair<double, double>> errorsWithAreas;
  errorsWithAreas.reserve(parts.size());
  for (const auto& part : parts)
  {
    errorsWithAreas.emplace_back(part.error, part.area);
  }
  std::sort(errorsWithAreas.begin(), errorsWithAreas.end());
  double within = 0;
  for (const auto& [error, itsArea] : errorsWithAreas)
  {
    within += itsArea;
    if (within >= area)
    {
      return error;
    }
  }
  return 0; // nothing has an area
}

}

/// The finite sums of Abramowitz and Stegun 26.7.3 (odd) and 26.7.4 (even degrees of freedom).
double studentProbability(double t, int freedom)
{
  const double angle = std::atan(t / std::sqrt(static_cast<double>(freedom)));
  const double sine = std::sin(angle), cosine = std::cos(angle);
  const bool isOdd = freedom % 2 != 0;
  double term = isOdd ? cosine : 1, sum = 0;
  for (int i = isOdd ? 1 : 0; i <= freedom - 2; i += 2)
  {
    sum += term;
    term *= cosine * cosine * (i + 1) / (i + 2);
  }
  return isOdd ? 2 / kPi * (angle + sine * sum) : sine * sum;
}

double studentQuantile(double probability, int freedom)
{
  double below = 0, above = 1;
  while (studentProbability(above, freedom) < probability)
  {
    above *= 2;
  }
  double middle = 0.5 * above;
  while (below < middle && middle < above)
  {
    (studentProbability(middle, freedom) < probability ? below : above) = middle;
    middle = 0.5 * (below + above);
  }
  return above;
}

ErrorEstimate::ErrorEstimate(const CellSums& sums, const WalkPlan& plan, std::size_t rounds,
  const Bands& quantaPerWalk, const PhotonShares* shares)
  : sums_(sums)
  , shares_(shares)
  , rounds_(rounds)
  , walks_(plan.walksAfter(rounds))
  , quantaPerWalk_(quantaPerWalk)
{
  double squares = 0;
  for (std::uint32_t replicate = 0; replicate < plan.replicates().count(); ++replicate)
  {
    share_.push_back(double(plan.replicates().share(replicate, walks_)) / walks_);
    squares += share_.back() * share_.back();
  }
  unbiased_ = 1 / (1 - squares);
}

double ErrorEstimate::confidenceFactor(std::uint32_t replicates)
{
  return studentQuantile(kConfidence, static_cast<int>(replicates) - 1);
}

ErrorEstimate::Received ErrorEstimate::received(const CellSide& cell, int band) const
{
  const auto replicates = static_cast<std::uint32_t>(share_.size());
  const auto ofReplicate = [&](std::uint32_t i) { return sums_.sum(cell, band, i, rounds_); };
  double quanta = 0;
  for (std::uint32_t i = 0; i < replicates; ++i)
  {
    quanta += ofReplicate(i);
  }
  const double quantaPerPhoton = this->quantaPerPhoton(cell, band);
  if (replicates < 2 || walks_ < kFewestPhotons || quanta == 0 ||
    quanta < kFewestPhotons * quantaPerPhoton)
  {
    return { quanta, std::nan(""), quantaPerPhoton, 0 };
  }
  double squares = 0;
  for (std::uint32_t i = 0; i < replicates; ++i)
  {
    const double off = ofReplicate(i) - share_[i] * quanta;
    squares += off * off;
  }
  return { quanta,
    std::sqrt(variance(unbiased_ * squares, replicates * quantaPerPhoton * quantaPerPhoton)),
    quantaPerPhoton, unbiased_ * squares };
}

double ErrorEstimate::relativeError(const Received& received, double average, double factor)
{
  if (received.quantaPerPhoton == 0)
  {
    return 0; // no light has this band
  }
  if (received.quanta == 0)
  {
    // Where 3 photons are expected, none arrives in 5 % of cases.
    return 3 * received.quantaPerPhoton / average;
  }
  return std::isnan(received.error) ? kInfinity : factor * received.error / received.quanta;
}

std::vector<ErrorEstimate::Part> ErrorEstimate::partsOf(
  const SceneCells& cells, bool areSidesApart, Execution& execution) const
{
  std::vector<Part> parts;
  cells.numbers().forEach([&](const SceneCell& cell) {
    if (const double area = cells.area(cell); area > 0)
    {
      forEachSide(cell, areSidesApart, [&](const CellSide& side) {
        parts.push_back({ side, area });
      });
    }
  });
  constexpr std::size_t kPartsPerUnit = 4096;
  forEachSliced(
    (parts.size() + kPartsPerUnit - 1) / kPartsPerUnit, execution, [&](std::size_t unit) {
      for (std::size_t i = unit * kPartsPerUnit;
           i < std::min((unit + 1) * kPartsPerUnit, parts.size()); ++i)
      {
        for (int band = 0; band < sums_.bands(); ++band)
        {
          parts[i].received[static_cast<std::size_t>(band)] = received(parts[i].cell, band);
        }
      }
    });
  return parts;
}

/// Where replicates scatter more than rays explain, the rest is due to walks. All else (the steps
/// of single photons, unknown errors) falls with more rays.
double ErrorEstimate::partOfRays(const Received& received, double rayVariance) const
{
  const bool isKnown = received.quanta != 0 && !std::isnan(received.error);
  return isKnown ? 1 - std::max(0.0, received.spread - rayVariance) / std::pow(received.error, 2)
                 : 1.0;
}

void ErrorEstimate::judge(std::vector<Part>& parts) const
{
  double area = 0;
  Bands sums{}; // quanta
  for (const Part& part : parts)
  {
    area += part.area;
    for (std::size_t band = 0; band < sums.size(); ++band)
    {
      sums[band] += part.received[band].quanta;
    }
  }
  const double factor = confidenceFactor(static_cast<std::uint32_t>(share_.size()));
  for (Part& part : parts)
  {
    for (int band = 0; band < sums_.bands(); ++band)
    {
      const auto i = static_cast<std::size_t>(band);
      const double error = relativeError(part.received[i], sums[i] / area * part.area, factor);
      if (error > part.error)
      {
        const std::optional<double> rayVariance =
          shares_ ? shares_->rayVariance(part.cell, band) : std::nullopt;
        part.error = error;
        part.castsRays = rayVariance.has_value();
        part.ofRays = rayVariance ? partOfRays(part.received[i], *rayVariance) : 0;
      }
    }
  }
}

TargetMiss ErrorEstimate::missOf(
  double target, const SceneCells& cells, bool areSidesApart, Execution& execution) const
{
  std::vector<Part> parts = partsOf(cells, areSidesApart, execution);
  judge(parts);
  double area = 0;
  for (const Part& part : parts)
  {
    area += part.area;
  }
  TargetMiss miss;
  miss.reached = quantileOfArea(parts, kConfidence * area);
  for (const Part& part : parts)
  {
    const bool misses = part.error > target, isNeeded = part.error <= miss.reached;
    miss.byWalks += misses && isNeeded ? part.area * (1 - part.ofRays) / 2 : 0;
    miss.byRays += misses && isNeeded ? part.area * part.ofRays / 2 : 0;
    miss.beyondRays += misses && !part.castsRays ? part.area / area : 0;
  }
  return miss;
}

}
