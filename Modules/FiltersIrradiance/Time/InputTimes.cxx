// SPDX-License-Identifier: BSD-3-Clause
#include "Time/InputTimes.h"

#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>

namespace irradiance
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

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

void checkTime(vtkInformation* input, double time, const TimeSpan& span)
{
  if (!isOfTime(input, time, span))
  {
    throw InputError("the input was asked for time " + text(time) + ", but came with that of " +
      text(givenTime(input, time)) +
      ": choose IntegrationMode TimeSteps with StartTime and EndTime among the TIME_STEPS, or put "
      "a vtkTemporalInterpolator before this filter");
  }
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
