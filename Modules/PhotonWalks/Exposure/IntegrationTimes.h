// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntegrationTimes_h
#define irradiance_IntegrationTimes_h

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

}

#endif
