// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "EngineRun.h"

#include "../RayCasting/RandomVectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace irradiance::test
{

/// Calls visit(direction, solidAngle) for the middles of steps of two thirds of a degree, in which
/// there is no chance.
template <class Visit>
void forEachDirection(const Visit& visit)
{
  constexpr int kSteps = 270, kTurns = 2 * kSteps;
  constexpr double kStep = M_PI / kSteps;
  for (int i = 0; i < kSteps * kTurns; ++i)
  {
    const double polar = kStep * (i / kTurns + 0.5), azimuth = kStep * (i % kTurns + 0.5);
    visit(Vector3(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
            std::cos(polar)),
      std::sin(polar) * kStep * kStep);
  }
}

/// That directions have a density, up to a factor: in bins of 15 degrees chi-square is beyond 4.5
/// sigma in 1 of 300,000. They never leave what is not 0.
template <class Density, class Sample>
void expectDensity(const Density& density, const Sample& sample)
{
  constexpr int kAcross = 12, kAround = 24, kSamples = kIsSanitized ? 4000 : 10000;
  const auto binOf = [](const Vector3& d) {
    const double turns = std::atan2(d.y(), d.x()) / (2 * M_PI);
    const int row = static_cast<int>(std::acos(d.z()) / M_PI * kAcross),
              column = static_cast<int>((turns - std::floor(turns)) * kAround);
    return static_cast<std::size_t>(std::min(row, kAcross - 1) * kAround + column);
  };
  std::vector<double> expected(kAcross * kAround), counts(expected.size());
  double all = 0, chiSquare = 0, bins = 0;
  forEachDirection([&](const Vector3& d, double solidAngle) {
    const double part = density(d) * solidAngle;
    expected[binOf(d)] += part;
    all += part;
  });
  RandomVectors random(8);
  for (int i = 0; i < kSamples; ++i)
  {
    const double u = random.uniform(0x1p-33, 1 - 0x1p-33);
    const Vector3 direction = sample({ u, random.uniform(0x1p-33, 1 - 0x1p-33) });
    EXPECT_NEAR(direction.norm(), 1, 1e-12);
    EXPECT_GT(density(direction), 0) << direction.transpose();
    counts[binOf(direction)] += 1;
  }
  for (std::size_t bin = 0; bin < counts.size(); ++bin)
  {
    const double mean = expected[bin] / all * kSamples;
    chiSquare += mean > 8 ? std::pow(counts[bin] - mean, 2) / mean : 0;
    bins += mean > 8 ? 1 : 0;
  }
  EXPECT_GE(bins, 4);
  EXPECT_LT(chiSquare, chiSquareLimit(bins, 4.5));
}

}
