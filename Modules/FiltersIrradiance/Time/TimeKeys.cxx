// SPDX-License-Identifier: BSD-3-Clause
#include "Time/TimeKeys.h"

#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace irradiance
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

std::string rangeText(const TimeSpan& span)
{
  return joined(span.start, " to ", span.end);
}

void checkWithin(const char* name, double time, const TimeSpan& range)
{
  throwIf(!(time >= range.start && time <= range.end), name, " is ", time,
    ", outside of the input's times, which are ", rangeText(range));
}

/// The time that data say to be of. Files have some times alone, and take the nearest. Data that do
/// not change over time (no TIME_RANGE) are of any time.
double givenTime(vtkInformation* input, double time)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  auto* key = vtkDataObject::DATA_TIME_STEP();
  return input->Has(Pipeline::TIME_RANGE()) && data && data->GetInformation()->Has(key)
    ? data->GetInformation()->Get(key)
    : time;
}

bool isOfTime(vtkInformation* input, double time, const TimeSpan& span)
{
  constexpr double rounding = 1e-9;
  return std::abs(givenTime(input, time) - time) <= rounding * (span.end - span.start);
}

}

std::vector<double> stepsOf(vtkInformation* input)
{
  const double* given = input->Get(Pipeline::TIME_STEPS());
  const int count = given ? input->Length(Pipeline::TIME_STEPS()) : 0;
  const std::set<double> steps(given, given + count);
  return { steps.begin(), steps.end() };
}

void uniteTimes(vtkInformationVector** inputs, int ports, vtkInformationVector* outputs,
  const std::vector<double>& further)
{
  std::set<double> all(further.begin(), further.end());
  double range[2] = { HUGE_VAL, -HUGE_VAL };
  const auto extend = [&range](double first, double last) {
    range[0] = std::min(range[0], first);
    range[1] = std::max(range[1], last);
  };
  for (int port = 0; port < ports; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      const std::vector<double> own = stepsOf(input);
      all.insert(own.begin(), own.end());
      if (const double* given = input->Get(Pipeline::TIME_RANGE()))
      {
        extend(given[0], given[1]);
      }
    }
  }
  std::vector<double> steps(all.begin(), all.end());
  if (!steps.empty())
  {
    extend(steps.front(), steps.back());
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    output->Remove(Pipeline::TIME_STEPS());
    output->Remove(Pipeline::TIME_RANGE());
    if (!steps.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
    }
    if (range[0] <= range[1])
    {
      output->Set(Pipeline::TIME_RANGE(), range, 2);
    }
  }
}

TimeSpan timeSpan(vtkInformation* input, double startTime, double endTime)
{
  auto* key = Pipeline::TIME_RANGE();
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
  else
  {
    throwIf(!std::isfinite(startTime) || !std::isfinite(endTime), "StartTime is ", startTime,
      " and EndTime is ", endTime,
      ", but the input has no times (TIME_RANGE or TIME_STEPS) that could tell how long the "
      "exposure lasts: give both, or move something over time");
  }
  const TimeSpan span{ std::isnan(startTime) ? range.start : startTime,
    std::isnan(endTime) ? range.end : endTime };
  checkWithin("StartTime", span.start, range);
  checkWithin("EndTime", span.end, range);
  throwIf(!(span.start < span.end), "the limits are the wrong way round, or equal: StartTime is ",
    span.start, ", EndTime is ", span.end, " (the input's times are ", rangeText(range), ")");
  return span;
}

std::vector<double> stepTimes(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = stepsOf(input);
  throwIf(steps.size() < 2, "IntegrationMode is TimeSteps, but the input has ", steps.size(),
    " TIME_STEPS, and 2 at least are needed: choose Uniform or ErrorControlled");
  throwIf(std::none_of(steps.begin(), steps.end(),
            [&](double step) { return step >= span.start && step <= span.end; }),
    "none of the input's TIME_STEPS is within ", rangeText(span),
    " (StartTime to EndTime), so IntegrationMode TimeSteps is not possible");
  return timesWithin(steps, span);
}

std::optional<double> timeBetweenSteps(vtkInformation* input, const TimeSpan& span)
{
  const std::vector<double> steps = stepsOf(input);
  return steps.empty() ? std::nullopt
                       : std::optional<double>(middleOf(span.start, timesWithin(steps, span)[1]));
}

void checkTime(vtkInformation* input, double time, const TimeSpan& span)
{
  throwIf(!isOfTime(input, time, span), "the input was asked for time ", time,
    ", but came with that of ", givenTime(input, time),
    ": choose IntegrationMode TimeSteps with StartTime and EndTime among the TIME_STEPS, or put a "
    "vtkTemporalInterpolator before this filter");
}

bool comesAtStepsOnly(vtkExecutive* executive, int port, const TimeSpan& span)
{
  vtkInformation* output = executive->GetOutputInformation(port);
  auto* asked = Pipeline::UPDATE_TIME_STEP();
  if (output->Has(asked) && !isOfTime(output, output->Get(asked), span))
  {
    return true;
  }
  vtkAlgorithm* algorithm = executive->GetAlgorithm();
  for (int input = 0; input < algorithm->GetNumberOfInputPorts(); ++input)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(input); ++i)
    {
      vtkAlgorithmOutput* from = algorithm->GetInputConnection(input, i);
      if (from && comesAtStepsOnly(from->GetProducer()->GetExecutive(), from->GetIndex(), span))
      {
        return true;
      }
    }
  }
  return false;
}

bool forgetAborted(vtkExecutive* executive)
{
  bool isAborted = executive->GetAlgorithm()->GetAbortExecute() != 0;
  executive->GetAlgorithm()->SetAbortExecute(0); // VTK 9.3 would abort again
  for (int port = 0; port < executive->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < executive->GetNumberOfInputConnections(port); ++i)
    {
      vtkExecutive* input = executive->GetInputExecutive(port, i);
      isAborted = (input && forgetAborted(input)) || isAborted;
    }
  }
  for (int port = 0; isAborted && port < executive->GetNumberOfOutputPorts(); ++port)
  {
    if (vtkDataObject* data = executive->GetOutputData(port))
    {
      data->GetInformation()->Remove(vtkDataObject::DATA_TIME_STEP());
    }
  }
  return isAborted;
}

}
