// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntegrationTimes_h
#define irradiance_IntegrationTimes_h

#include <cstddef>
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
std::vector<double> timesWithin(const std::vector<double>& steps, const TimeSpan& span);

/// The ends of `intervals` equal parts of the span.
std::vector<double> uniformTimes(const TimeSpan& span, int intervals);

/// The ends of the span, the `steps` between them, and equal parts of what would be longer than the
/// span over `intervals`. An even number of intervals: if it is odd, the longest is halved.
std::vector<double> firstTimes(
  const std::vector<double>& steps, const TimeSpan& span, int intervals);

inline double middleOf(double start, double end)
{
  return start + (end - start) / 2;
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
  std::vector<std::size_t> takeSettled();
  /// The id of the worst, which is to be replaced by its halves, so it is forgotten. Nothing if the
  /// tolerance is reached or no more can be done.
  std::optional<std::size_t> takeWorst();

  /// Of all intervals.
  std::vector<IntervalMeasure> totals() const;
  /// The largest of a block, relative to its energy.
  double relativeError() const;
  double relativeNoise() const;
  /// The largest error of a block over the tolerated error.
  double excess() const { return relativeError() / tolerance_; }

private:
  bool isSettled(
    const HalvableInterval& interval, const std::vector<IntervalMeasure>& totals) const;

  double span_, tolerance_;
  std::size_t mostIntervals_;
  std::vector<HalvableInterval> open_;
  std::vector<IntervalMeasure> settled_; ///< sums of each block
  std::size_t settledIntervals_ = 0;
};

}

#endif
