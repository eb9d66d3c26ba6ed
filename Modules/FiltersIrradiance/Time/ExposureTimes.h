// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ExposureTimes_h
#define irradiance_ExposureTimes_h

#include <optional>
#include <vector>

class vtkInformation;

namespace irradiance
{

/// The first and last time of an exposure, s.
struct TimeSpan
{
  double start, end;
};

/// The span of an exposure, given the properties of the same names (NaN: the end of what the input
/// has). Throws InputError.
TimeSpan timeSpan(vtkInformation* input, double startTime, double endTime);

/// The ends of the span and the TIME_STEPS of the input between them. Throws InputError.
std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span);

/// The ends of `intervals` equal parts of the span.
std::vector<double> uniformTimes(const TimeSpan& span, int intervals);

/// The ends of the span, the TIME_STEPS of the input between them, and equal parts of what would be
/// longer than the span over `intervals`. An even number of intervals: if it is odd, the longest is halved.
std::vector<double> firstTimes(vtkInformation* input, const TimeSpan& span, int intervals);

/// A time at which the input has no step, if it has TIME_STEPS.
std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span);

inline double middleOf(double start, double end)
{
  return start + (end - start) / 2;
}

/// The weight of a time in the trapezoidal rule, between the times before and after it; at an end, the
/// time itself is its neighbour.
inline double trapezoidWeight(double before, double after)
{
  return 0.5 * (after - before);
}

}

#endif
