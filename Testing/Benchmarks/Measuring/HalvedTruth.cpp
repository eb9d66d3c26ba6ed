// SPDX-License-Identifier: BSD-3-Clause
#include "Measuring/HalvedTruth.h"

#include <cmath>
#include <stdexcept>

namespace
{

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

HalvedTruth combined(const HalvedTruth& a, const HalvedTruth& b, const CellField& areas,
  const std::vector<CellSet>& sets)
{
  HalvedTruth both = a;
  for (const CellSet& set : sets)
  {
    const double noiseOfA = meanOf(set.of((a.first - a.second).square()), set.of(areas));
    const double noiseOfB = meanOf(set.of((b.first - b.second).square()), set.of(areas));
    const double share = noiseOfA / (noiseOfA + noiseOfB);
    both.first.segment(set.first, set.count) += share * set.of(b.first - a.first);
    both.second.segment(set.first, set.count) += share * set.of(b.second - a.second);
  }
  return both;
}

Agreement requireAgreement(const std::string& who, const std::vector<CellField>& runs,
  const HalvedTruth& truth, const CellField& areas, const CellSet& set, double allowed)
{
  const CellField a = set.of(meanOfHalf(runs, 0)), b = set.of(meanOfHalf(runs, 1));
  const CellField t = set.of(truth.first), u = set.of(truth.second);
  const CellField weights = set.of(areas) / set.of(areas).sum();
  const double mean = 0.5 * (weights * (t + u)).sum();
  const double ratio = 0.5 * (weights * (a + b)).sum() / mean;
  const double ratioError =
    std::sqrt((weights.square() * (varianceOf(a, b) + varianceOf(t, u))).sum()) / mean;

  const double square = (weights * (a - t) * (b - u)).sum() / (mean * mean);
  // The variance of such a product by noise alone; if anything too large, as each cell's is from
  // two values.
  const CellField noise = weights * 2 * (varianceOf(a, b) + varianceOf(t, u)) / (mean * mean);
  const double squareError = std::sqrt(noise.square().sum());
  const double systematic = std::copysign(std::sqrt(std::abs(square)), square);
  if (!(std::abs(ratio - 1) <= kSigmas * ratioError + allowed &&
        square <= kSigmas * squareError + allowed * allowed))
  {
    throw std::runtime_error(who + " differs from the truth on " + set.name +
      ": the mean irradiance is " + std::to_string(ratio) + " of it, where noise explains " +
      std::to_string(ratioError) + "; the systematic RMS difference of cells is " +
      std::to_string(systematic) + ", where noise explains " +
      std::to_string(std::sqrt(squareError)));
  }
  return { ratio, systematic };
}
