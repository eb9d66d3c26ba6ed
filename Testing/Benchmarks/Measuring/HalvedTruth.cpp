// SPDX-License-Identifier: BSD-3-Clause
#include "Measuring/HalvedTruth.h"

#include <cmath>
#include <stdexcept>

namespace
{

constexpr double kAllowed = 1e-3;
constexpr double kSigmas = 6;

/// Of the runs from `first` on, every other one.
CellField meanOfHalf(const std::vector<CellField>& runs, std::size_t first)
{
  CellField sum = CellField::Zero(runs[0].size());
  int count = 0;
  for (std::size_t i = first; i < runs.size(); i += 2)
  {
    sum += runs[i];
    ++count;
  }
  return sum / count;
}

/// Of the mean of both.
CellField varianceOf(const CellField& a, const CellField& b)
{
  return 0.25 * (a - b).square();
}

}

double HalvedTruth::squaredError(
  const CellField& field, const CellField& areas, const CellSet& set) const
{
  const double mean = meanOf(set.of(0.5 * (first + second)), set.of(areas));
  return meanOf(set.of((field - first) * (field - second)), set.of(areas)) / (mean * mean);
}

Agreement requireAgreement(const std::string& who, const std::vector<CellField>& runs,
  const HalvedTruth& truth, const CellField& areas, const CellSet& set)
{
  const CellField a = set.of(meanOfHalf(runs, 0)), b = set.of(meanOfHalf(runs, 1));
  const CellField t = set.of(truth.first), u = set.of(truth.second);
  const CellField weights = set.of(areas) / set.of(areas).sum();
  const double mean = 0.5 * (weights * (t + u)).sum();
  const double ratio = 0.5 * (weights * (a + b)).sum() / mean;
  const double ratioError =
    std::sqrt((weights.square() * (varianceOf(a, b) + varianceOf(t, u))).sum()) / mean;

  // Without a systematic difference each product is 0 on the average, and so its square is its variance.
  const CellField products = weights * (a - t) * (b - u) / (mean * mean);
  const double square = products.sum(), squareError = std::sqrt(products.square().sum());
  const double systematic = std::copysign(std::sqrt(std::abs(square)), square);
  if (!(std::abs(ratio - 1) <= kSigmas * ratioError + kAllowed &&
        square <= kSigmas * squareError + kAllowed * kAllowed))
  {
    throw std::runtime_error(who + " differs from the truth on " + set.name +
      ": the mean irradiance is " + std::to_string(ratio) + " of it, where noise explains " +
      std::to_string(ratioError) + "; the systematic RMS difference of cells is " +
      std::to_string(systematic) + ", where noise explains " +
      std::to_string(std::sqrt(squareError)));
  }
  return { ratio, systematic };
}
