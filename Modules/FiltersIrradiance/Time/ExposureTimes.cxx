// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureTimes.h"

#include "Progress/InputError.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace irradiance
{

namespace
{

std::vector<double> timesOf(vtkInformation* input)
{
  auto* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
  std::vector<double> times;
  if (input->Has(key))
  {
    times.assign(input->Get(key), input->Get(key) + input->Length(key));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::string rangeText(const TimeSpan& span)
{
  return text(span.start) + " to " + text(span.end);
}

double checkedTime(const char* name, double time, const TimeSpan& range)
{
  if (!(time >= range.start && time <= range.end))
  {
    throw InputError(std::string(name) + " is " + text(time) +
      ", outside of the input's times, which are " + rangeText(range));
  }
  return time;
}

}

TimeSpan timeSpan(vtkInformation* input, double startTime, double endTime)
{
  auto* key = vtkStreamingDemandDrivenPipeline::TIME_RANGE();
  const std::vector<double> times = timesOf(input);
  TimeSpan range{ -HUGE_VAL, HUGE_VAL };
  if (input->Has(key) && input->Length(key) == 2)
  {
    range = { input->Get(key)[0], input->Get(key)[1] };
  }
  else if (!times.empty())
  {
    range = { times.front(), times.back() };
  }
  else if (!std::isfinite(startTime) || !std::isfinite(endTime))
  {
    throw InputError("StartTime is " + text(startTime) + " and EndTime is " + text(endTime) +
      ", but the input has no times (TIME_RANGE or TIME_STEPS) that could tell how long the "
      "exposure lasts: give both, or move something over time");
  }
  const TimeSpan span{ std::isnan(startTime) ? range.start : startTime,
    std::isnan(endTime) ? range.end : endTime };
  checkedTime("StartTime", span.start, range);
  checkedTime("EndTime", span.end, range);
  if (!(span.start < span.end))
  {
    throw InputError("the limits are the wrong way round, or equal: StartTime is " +
      text(span.start) + ", EndTime is " + text(span.end) + " (the input's times are " +
      rangeText(range) + ")");
  }
  return span;
}

namespace
{

/// The ends of the span and the steps between them.
std::vector<double> timesWithin(const std::vector<double>& steps, const TimeSpan& span)
{
  std::vector<double> times{ span.start };
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(times),
    [&](double step) { return step > span.start && step < span.end; });
  times.push_back(span.end);
  return times;
}

}

std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = timesOf(input);
  if (steps.size() < 2)
  {
    throw InputError("IntegrationMode is TimeSteps, but the input has " +
      std::to_string(steps.size()) +
      " TIME_STEPS, and 2 at least are needed: choose Uniform or ErrorControlled");
  }
  if (std::none_of(steps.begin(), steps.end(),
        [&](double step) { return step >= span.start && step <= span.end; }))
  {
    throw InputError("none of the input's TIME_STEPS is within " + rangeText(span) +
      " (StartTime to EndTime), so IntegrationMode TimeSteps is not possible");
  }
  return timesWithin(steps, span);
}

std::vector<double> uniformTimes(const TimeSpan& span, int intervals)
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

std::vector<double> firstTimes(vtkInformation* input, const TimeSpan& span, int intervals)
{
  const std::vector<double> known = timesWithin(timesOf(input), span);
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

std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = timesOf(input);
  if (steps.empty())
  {
    return std::nullopt;
  }
  return middleOf(span.start, timesWithin(steps, span)[1]);
}

}
