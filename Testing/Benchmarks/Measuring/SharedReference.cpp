// SPDX-License-Identifier: BSD-3-Clause
#include "Measuring/SharedReference.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

constexpr int kRuns = 8;                   // of each program
constexpr std::uint64_t kFirstSeed = 1000; // those that are measured are smaller
constexpr double kAllowed = 1e-3;
constexpr double kSigmas = 6;

/// Of independent values, or fields of them.
template <class Value>
struct Runs
{
  Value mean, variance; ///< the variance of one run
};

template <class Value>
Runs<Value> summarize(const std::vector<Value>& runs, const Value& zero)
{
  Runs<Value> all{ zero, zero };
  for (const Value& run : runs)
  {
    all.mean += run / kRuns;
  }
  for (const Value& run : runs)
  {
    const Value difference = run - all.mean;
    all.variance += difference * difference / (kRuns - 1);
  }
  return all;
}

/// Of one program.
struct Half
{
  Half(const CellField& areas, const SharedReference::Shoot& shoot)
  {
    std::vector<CellField> runs;
    std::vector<double> means;
    for (int run = 0; run < kRuns; ++run)
    {
      runs.push_back(shoot(kFirstSeed + static_cast<std::uint64_t>(run)));
      means.push_back(meanOf(runs.back(), areas));
    }
    cells = summarize<CellField>(runs, CellField::Zero(areas.size()));
    whole = summarize(means, 0.0);
  }

  Runs<CellField> cells;
  Runs<double> whole; ///< the mean over the area
};

double square(double x)
{
  return x * x;
}

}

SharedReference::SharedReference(const CellField& areas, const Shoot& ours, const Shoot& theirs)
  : areas_(areas)
{
  const Half a(areas, ours), b(areas, theirs);
  reference_ = 0.5 * (a.cells.mean + b.cells.mean);
  const double differenceSquared = squareOf(a.cells.mean - b.cells.mean);
  ownSquaredError_ = 0.25 * differenceSquared;

  ratio_ = a.whole.mean / b.whole.mean;
  const double ratioError = std::sqrt(
    (a.whole.variance / square(a.whole.mean) + b.whole.variance / square(b.whole.mean)) / kRuns);
  // Squares of normal variables, each with the weight of its cell.
  const CellField weights = areas * (a.cells.variance + b.cells.variance);
  const double spread = std::sqrt(2 * weights.square().sum()) / weights.sum();
  const double noise = weights.sum() / kRuns / areas.sum() / square(meanOf(reference_, areas));
  overNoise_ = std::sqrt(differenceSquared / noise);
  if (!(std::abs(ratio_ - 1) <= kSigmas * ratioError + kAllowed &&
        differenceSquared <= noise * (1 + kSigmas * spread) + square(kAllowed)))
  {
    throw std::runtime_error("The answers differ: the mean irradiance is " +
      std::to_string(ratio_) + " of the plain tracer's, the RMS difference of cells " +
      std::to_string(overNoise_) + " of what noise explains");
  }
}

double SharedReference::squaredError(const CellField& field) const
{
  return squareOf(field - reference_) - ownSquaredError_;
}

double SharedReference::squareOf(const CellField& difference) const
{
  return meanOf(difference.square(), areas_) / square(meanOf(reference_, areas_));
}
