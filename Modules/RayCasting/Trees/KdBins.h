// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdBins_h
#define irradiance_KdBins_h

#include "Trees/KdItem.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace irradiance
{

/// Counts how many items begin and end in each of the equal parts of an interval.
class KdBins
{
public:
  static constexpr std::uint32_t kMost = 128;

  void reset(double lower, double upper, int size)
  {
    size_ = size;
    last_ = static_cast<float>(size - 1);
    lower_ = roundDown(lower);
    width_ = (upper - lower_) / size;
    // The scale stays finite, because infinity times zero is NaN.
    constexpr double kMostScale = std::numeric_limits<float>::max();
    scale_ = width_ > 0 ? static_cast<float>(std::min(1 / width_, kMostScale)) : 0.0f;
    std::fill_n(begins_.begin(), size + 1, 0);
    std::fill_n(ends_.begin(), size + 1, 0);
  }

  int size() const { return size_; }
  double edge(int bin) const { return lower_ + bin * width_; }
  /// The bin of x >= `lower`; monotonic in x. Rounding may choose the neighbour of the right bin if
  /// x is within 2^-22 of the interval's length of their common edge.
  int of(float x) const { return static_cast<int>(std::min((x - lower_) * scale_, last_)); }

  void add(float lower, float upper)
  {
    ++begins_[of(lower) + 1];
    ++ends_[of(upper)];
  }
  /// Ends the counting. Call it before the sums below.
  void accumulate()
  {
    for (int bin = 0; bin < size_; ++bin)
    {
      begins_[bin + 1] += begins_[bin];
      ends_[size_ - 1 - bin] += ends_[size_ - bin];
    }
  }
  /// Number of items that begin in the bins before this one.
  std::uint32_t begunBefore(int bin) const { return begins_[bin]; }
  /// Number of items that end in this bin or after it.
  std::uint32_t endingFrom(int bin) const { return ends_[bin]; }

private:
  int size_ = 1;
  float last_ = 0, lower_ = 0, scale_ = 0;
  double width_ = 0;
  std::array<std::uint32_t, kMost + 1> begins_, ends_;
};

}

#endif
