// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "PathVertex.h"

#include <cstddef>
#include <vector>

namespace pathtracedroom
{

/// Means over independent passes and their standard errors, for each bin.
class Estimates
{
public:
  explicit Estimates(std::size_t bins)
    : means_(bins, Spectrum::Zero())
    , squares_(bins, Spectrum::Zero())
  {
  }

  void add(const std::vector<Spectrum>& pass)
  {
    ++passes_;
    for (std::size_t bin = 0; bin < pass.size(); ++bin)
    {
      const Spectrum difference = pass[bin] - means_[bin];
      means_[bin] += difference / passes_;
      squares_[bin] += difference * (pass[bin] - means_[bin]);
    }
  }

  std::size_t numberOfBins() const { return means_.size(); }
  int passes() const { return passes_; }
  const Spectrum& mean(std::size_t bin) const { return means_[bin]; }
  /// With passes() - 1 degrees of freedom; needs two passes.
  Spectrum standardError(std::size_t bin) const
  {
    return (squares_[bin] / (passes_ - 1) / passes_).sqrt();
  }

private:
  int passes_ = 0;
  std::vector<Spectrum> means_;
  std::vector<Spectrum> squares_; ///< sums of squared differences from the mean
};

}
