// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace irradiance
{

/// The first and last time of an exposure, s.
struct TimeSpan
{
  double start, end;
};

/// The ends of the span and the `steps` between them. `steps` are in order.
inline std::vector<double> timesWithin(const std::vector<double>& steps, const TimeSpan& span)
{
  std::vector<double> times{ span.start };
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(times),
    [&](double step) { return step > span.start && step < span.end; });
  times.push_back(span.end);
  return times;
}

/// The ends of `intervals` equal parts of the span.
inline std::vector<double> uniformTimes(const TimeSpan& span, int intervals)
{
  std::vector<double> times;
  times.reserve(static_cast<std::size_t>(intervals) + 1);
  for (int i = 0; i < intervals; ++i)
  {
    times.push_back(span.start + (span.end - span.start) * (static_cast<double>(i) / intervals));
  }
  times.push_back(span.end);
  return times;
}

inline double middleOf(double start, double end)
{
  return start + (end - start) / 2;
}

/// The ends of the span, the `steps` between them, and equal parts of what would be longer than the
/// span over `intervals`. An even number of intervals: if it is odd, the longest is halved.
inline std::vector<double> firstTimes(
  const std::vector<double>& steps, const TimeSpan& span, int intervals)
{
  const std::vector<double> known = timesWithin(steps, span);
  std::vector<double> times{ span.start };
  std::size_t longest = 0;
  for (std::size_t i = 1; i < known.size(); ++i)
  {
    constexpr double rounding = 1e-9;
    const double parts = (known[i] - known[i - 1]) / (span.end - span.start) * intervals;
    const auto gap = uniformTimes(
      { known[i - 1], known[i] }, std::max(1, static_cast<int>(std::ceil(parts - rounding))));
    for (std::size_t part = 1; part < gap.size(); ++part)
    {
      times.push_back(gap[part]);
      const std::size_t end = times.size() - 1;
      longest = longest == 0 || times[end] - times[end - 1] > times[longest] - times[longest - 1]
        ? end
        : longest;
    }
  }
  if (times.size() % 2 == 0)
  {
    times.insert(times.begin() + static_cast<std::ptrdiff_t>(longest),
      middleOf(times[longest - 1], times[longest]));
  }
  return times;
}

/// The weight of a time in the trapezoidal rule, between the times before and after it; at an end,
/// the time itself is its neighbour.
inline double trapezoidWeight(double before, double after)
{
  return 0.5 * (after - before);
}

/// What an interval of time brings to a block, J.
struct IntervalMeasure
{
  double energy = 0; ///< area * exposure
  double error = 0;  ///< the estimated error of that, without
  double noise = 0;  ///< what looks like error, but single photons explain
};

/// An interval that is known at its ends and at one time between them.
struct HalvableInterval
{
  std::size_t id;
  double start, middle, end;
  std::vector<IntervalMeasure> blocks;
};

/**
 * Decides which intervals of time are halved, the worst first, until the error of every block is
 * small enough, and which are good enough to be forgotten. It knows nothing of where the measures
 * come from.
 *
 * An interval is settled for good if its error on each block is at most half of the tolerated error
 * of the block, shared out by length. So all of these take at most one half, and the other half is
 * for the rest: where irradiance jumps, the error of an interval falls with its length, but so does
 * its share.
 */
class TimeHalving
{
public:
  /// `span`: the length of all intervals. `tolerance`: relative to the energy of a block, > 0.
  /// `mostIntervals`: each HalvableInterval is two.
  TimeHalving(double span, double tolerance, std::size_t mostIntervals)
    : span_(span)
    , tolerance_(tolerance)
    , mostIntervals_(mostIntervals)
  {
  }

  /// All intervals have as many blocks.
  void add(HalvableInterval interval) { open_.push_back(std::move(interval)); }
  /// The ids of those that are settled now; they are forgotten, but for their sums.
  std::vector<std::size_t> takeSettled()
  {
    const std::vector<IntervalMeasure> all = totals();
    const auto firstSettled = std::stable_partition(open_.begin(), open_.end(),
      [&](const HalvableInterval& interval) { return !isSettled(interval, all); });
    std::vector<std::size_t> ids;
    for (auto interval = firstSettled; interval != open_.end(); ++interval)
    {
      addTo(settled_, interval->blocks);
      settledIntervals_ += 2;
      ids.push_back(interval->id);
    }
    open_.erase(firstSettled, open_.end());
    return ids;
  }
  /// The id of the worst, which is to be replaced by its halves, so it is forgotten. Nothing if the
  /// tolerance is reached or no more can be done.
  std::optional<std::size_t> takeWorst()
  {
    const std::vector<IntervalMeasure> all = totals();
    const std::size_t intervals = settledIntervals_ + 2 * open_.size();
    if (relativeError() <= tolerance_ || intervals + 2 > mostIntervals_)
    {
      return std::nullopt;
    }
    auto worst = open_.end();
    double most = 0;
    for (auto interval = open_.begin(); interval != open_.end(); ++interval)
    {
      const double error = worstShare(interval->blocks, all, &IntervalMeasure::error);
      if (error > most && canHalve(*interval))
      {
        most = error;
        worst = interval;
      }
    }
    if (worst == open_.end())
    {
      return std::nullopt;
    }
    const std::size_t id = worst->id;
    open_.erase(worst);
    return id;
  }

  /// Of all intervals.
  std::vector<IntervalMeasure> totals() const
  {
    std::vector<IntervalMeasure> totals = settled_;
    for (const HalvableInterval& interval : open_)
    {
      addTo(totals, interval.blocks);
    }
    return totals;
  }
  /// The largest of a block, relative to its energy.
  double relativeError() const
  {
    const std::vector<IntervalMeasure> all = totals();
    return worstShare(all, all, &IntervalMeasure::error);
  }
  double relativeNoise() const
  {
    const std::vector<IntervalMeasure> all = totals();
    return worstShare(all, all, &IntervalMeasure::noise);
  }
  /// The largest error of a block over the tolerated error.
  double excess() const { return relativeError() / tolerance_; }

private:
  static void addTo(std::vector<IntervalMeasure>& sums, const std::vector<IntervalMeasure>& blocks)
  {
    sums.resize(std::max(sums.size(), blocks.size()));
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      sums[i].energy += blocks[i].energy;
      sums[i].error += blocks[i].error;
      sums[i].noise += blocks[i].noise;
    }
  }
  /// The largest error of a block, or the largest noise, relative to the energy of the block.
  static double worstShare(const std::vector<IntervalMeasure>& blocks,
    const std::vector<IntervalMeasure>& totals, double IntervalMeasure::*part)
  {
    double worst = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      worst = blocks[i].*part > 0 ? std::max(worst, blocks[i].*part / totals[i].energy) : worst;
    }
    return worst;
  }
  /// Whether there are numbers between its times.
  static bool canHalve(const HalvableInterval& interval)
  {
    const auto hasMiddle = [](double start, double end) {
      return start < middleOf(start, end) && middleOf(start, end) < end;
    };
    return hasMiddle(interval.start, interval.middle) && hasMiddle(interval.middle, interval.end);
  }
  bool isSettled(const HalvableInterval& interval, const std::vector<IntervalMeasure>& totals) const
  {
    const double share = 0.5 * tolerance_ * (interval.end - interval.start) / span_;
    for (std::size_t i = 0; i < totals.size(); ++i)
    {
      // What is certain already: more will come, and what is in doubt may turn out to be nothing.
      const double certain = std::max(0.0, totals[i].energy - totals[i].error);
      if (interval.blocks[i].error > share * certain)
      {
        return false;
      }
    }
    return true;
  }

  double span_, tolerance_;
  std::size_t mostIntervals_;
  std::vector<HalvableInterval> open_;
  std::vector<IntervalMeasure> settled_; ///< sums of each block
  std::size_t settledIntervals_ = 0;
};

}
