// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_KdBins_h
#define irradiance_KdBins_h

#include "Trees/KdBounds.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

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

/// Where items begin, end, or lie flat on one axis, in ascending order. All places are finite.
class KdEvents
{
public:
  /// All events at one place.
  struct Step
  {
    float x;
    std::uint32_t ending, lying, beginning;
  };

  void clear()
  {
    for (std::vector<float>& places : places_)
    {
      places.clear();
    }
  }
  /// Adds the requested events of an item. A flat item has only one event.
  void add(float lower, float upper, bool takesLower, bool takesUpper)
  {
    if (takesLower)
    {
      places_[lower == upper ? kFlat : kBegin].push_back(lower);
    }
    if (takesUpper && lower != upper)
    {
      places_[kEnd].push_back(upper);
    }
  }
  void sort()
  {
    for (std::size_t kind = 0; kind < places_.size(); ++kind)
    {
      std::sort(places_[kind].begin(), places_[kind].end());
      places_[kind].push_back(HUGE_VALF);
      next_[kind] = places_[kind].data();
    }
  }
  /// After sort(): goes to the next place; false if there is none.
  bool next(Step& step)
  {
    step.x = std::min({ *next_[kBegin], *next_[kEnd], *next_[kFlat] });
    if (step.x == HUGE_VALF)
    {
      return false;
    }
    const auto pass = [&](std::size_t kind) {
      const float* const first = next_[kind];
      while (*next_[kind] == step.x)
      {
        ++next_[kind];
      }
      return static_cast<std::uint32_t>(next_[kind] - first);
    };
    step.ending = pass(kEnd);
    step.lying = pass(kFlat);
    step.beginning = pass(kBegin);
    return true;
  }

private:
  static constexpr std::size_t kBegin = 0, kEnd = 1, kFlat = 2;

  std::array<std::vector<float>, 3> places_; ///< by kind
  std::array<const float*, 3> next_{};
};

}

#endif
