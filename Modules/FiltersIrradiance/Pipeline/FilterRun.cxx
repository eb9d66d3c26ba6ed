// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/FilterRun.h"

#include "Progress/InputError.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationRequestKey.h"
#include "vtkObjectFactory.h"
#include "vtkVersionMacros.h"

#include <exception>

namespace irradiance
{

namespace
{

/// On data: an error left it empty.
vtkInformationIntegerKey* failedKey()
{
  static auto* const key = new vtkInformationIntegerKey("FAILED", "vtkIrradianceFilter");
  return key;
}

bool hasInputFailed(vtkAlgorithm* filter)
{
  bool hasFailed = false;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      vtkDataObject* input = filter->GetInputDataObject(port, i);
      hasFailed = hasFailed || (input && input->GetInformation()->Has(failedKey()));
    }
  }
  return hasFailed;
}

class RanksPipeline : public vtkCompositeDataPipeline
{
public:
  vtkTypeMacro(RanksPipeline, vtkCompositeDataPipeline);
  static RanksPipeline* New();

  std::function<void()> upstreamFailed;

protected:
  int ForwardUpstream(vtkInformation* request) override
  {
    const int result = this->Superclass::ForwardUpstream(request);
    if (result == 0 && request->Has(REQUEST_DATA()))
    {
      upstreamFailed();
    }
    return result;
  }
  using vtkCompositeDataPipeline::ForwardUpstream;
};

vtkStandardNewMacro(RanksPipeline);

void fail(vtkDataObject* output)
{
  output->Initialize();
  output->GetInformation()->Set(failedKey(), 1);
}

}

int setInputTypes(vtkInformation* port, const char* composite, const char* other)
{
  port->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), composite);
  port->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), other);
  return 1;
}

std::uint32_t checked(const char* name, vtkIdType value, vtkIdType low, vtkIdType high)
{
  throwIf(
    value < low || value > high, name, " is ", value, "; ", low, " to ", high, " are possible");
  return static_cast<std::uint32_t>(value);
}

void checkWithin(const char* name, double value, double low, double high)
{
  throwIf(!(value >= low && value <= high), name, " is ", value, "; it has to be ",
    high < VTK_DOUBLE_MAX ? joined(low, " to ", high)
      : low == 0          ? "0 or more"
                          : "finite");
}

vtkMTimeType upstreamTime(vtkAlgorithm* filter, int port, int connection)
{
  vtkExecutive* producer = filter->GetInputExecutive(port, connection);
  vtkMTimeType time = 0;
  producer->ComputePipelineMTime(nullptr, producer->GetInputInformation(),
    producer->GetOutputInformation(), filter->GetInputConnection(port, connection)->GetIndex(),
    &time);
  return time;
}

SmpExecution executionOf(vtkAlgorithm* filter, Ranks* ranks)
{
  const auto report = [filter](double progress) {
    filter->UpdateProgress(progress);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20221101)
    return !filter->CheckAbort();
#else
    return !filter->GetAbortExecute();
#endif
  };
  return SmpExecution(report, ranks);
}

void forgetAbort(vtkAlgorithm* filter)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20221101)
  filter->SetAbortOutput(false);
#else
  filter->SetAbortExecute(0);
#endif
}

vtkExecutive* newRanksPipeline(std::function<void()> upstreamFailed)
{
  auto* pipeline = RanksPipeline::New();
  pipeline->upstreamFailed = std::move(upstreamFailed);
  return pipeline;
}

int runFilter(
  vtkAlgorithm* filter, vtkDataObject* output, const std::function<void()>& compute, Ranks* ranks)
{
  output->Initialize();
  output->GetInformation()->Remove(failedKey());
  if (hasInputFailed(filter))
  {
    fail(output);
    if (ranks)
    {
      ranks->withdraw();
    }
    return 1;
  }
  try
  {
    ranks ? ranks->together(compute) : compute();
  }
  catch (const Interrupted&)
  {
    output->Initialize();
  }
  catch (const std::exception& error)
  {
    fail(output);
    vtkErrorWithObjectMacro(filter, << error.what());
    return 0;
  }
  return 1;
}

}
