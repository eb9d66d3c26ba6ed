// SPDX-License-Identifier: BSD-3-Clause
#include "Time/ExposureTimes.h"

#include "Progress/InputError.h"
#include "Time/TimeKeys.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

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
  const std::vector<double> times = stepsOf(input);
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

std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = stepsOf(input);
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

std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = stepsOf(input);
  if (steps.empty())
  {
    return std::nullopt;
  }
  return middleOf(span.start, timesWithin(steps, span)[1]);
}

}
