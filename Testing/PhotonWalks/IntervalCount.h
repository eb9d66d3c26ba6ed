// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntervalCount_h
#define irradiance_IntervalCount_h

#include "Estimates/ErrorEstimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace irradiance::test
{

/// Counts the 95 % intervals that hold a truth.
class IntervalCount
{
public:
  explicit IntervalCount(std::uint32_t replicates)
    : factor_(ErrorEstimate::confidenceFactor(replicates))
  {
  }

  /// `off`: the estimate less the truth.
  void add(double off, double standardError)
  {
    ASSERT_GT(standardError, 0);
    held_ += std::abs(off) <= factor_ * standardError ? 1 : 0;
    squares_ += std::pow(off / standardError, 2);
    ++known_;
  }

  int known() const { return known_; }
  double shareThatHolds() const { return double(held_) / known_; }

  /// At least 90 % hold it, and errors are not much smaller than claimed.
  void expectHonest() const
  {
    std::printf("%d intervals: %.1f %% hold the truth; errors are %.2f of those claimed\n", known_,
      100.0 * held_ / known_, std::sqrt(squares_ / known_));
    EXPECT_GT(held_, 0.9 * known_);
    EXPECT_GT(squares_ / known_, 0.25) << "nor much too wide";
  }

private:
  double factor_, squares_ = 0;
  int held_ = 0, known_ = 0;
};

}

#endif
