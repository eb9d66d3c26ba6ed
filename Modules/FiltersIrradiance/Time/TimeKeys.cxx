// SPDX-License-Identifier: BSD-3-Clause
#include "Time/TimeKeys.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <limits>

namespace irradiance
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

void sortOnce(std::vector<double>& times)
{
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

}

std::vector<double> stepsOf(vtkInformation* input)
{
  std::vector<double> steps;
  if (const double* given = input->Get(Pipeline::TIME_STEPS()))
  {
    steps.assign(given, given + input->Length(Pipeline::TIME_STEPS()));
  }
  sortOnce(steps);
  return steps;
}

TimeKeys::TimeKeys(vtkInformationVector** inputs, int ports)
  : first_(std::numeric_limits<double>::infinity())
  , last_(-first_)
{
  for (int port = 0; port < ports; ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      addSteps(stepsOf(input));
      if (const double* range = input->Get(Pipeline::TIME_RANGE()))
      {
        addRange(range[0], range[1]);
      }
    }
  }
}

void TimeKeys::addSteps(const std::vector<double>& steps)
{
  steps_.insert(steps_.end(), steps.begin(), steps.end());
  for (const double step : steps)
  {
    addRange(step, step);
  }
}

void TimeKeys::addRange(double first, double last)
{
  first_ = std::min(first_, first);
  last_ = std::max(last_, last);
}

void TimeKeys::write(vtkInformationVector* outputs)
{
  sortOnce(steps_);
  const double range[2] = { first_, last_ };
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    output->Remove(Pipeline::TIME_STEPS());
    output->Remove(Pipeline::TIME_RANGE());
    if (!steps_.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), steps_.data(), static_cast<int>(steps_.size()));
    }
    if (first_ <= last_)
    {
      output->Set(Pipeline::TIME_RANGE(), range, 2);
    }
  }
}

}
