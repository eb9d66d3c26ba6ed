// SPDX-License-Identifier: BSD-3-Clause
#include "FilterRun.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkVersionMacros.h"

#include <exception>

namespace irradiance
{

SmpExecution executionOf(vtkAlgorithm* filter)
{
  return SmpExecution([filter](double progress) {
    filter->UpdateProgress(progress);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20221101)
    return !filter->CheckAbort();
#else
    return !filter->GetAbortExecute();
#endif
  });
}

int runFilter(vtkAlgorithm* filter, vtkDataObject* output, const std::function<void()>& compute)
{
  output->Initialize();
  try
  {
    compute();
  }
  catch (const Interrupted&)
  {
    output->Initialize();
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorWithObjectMacro(filter, << error.what());
    return 0;
  }
  return 1;
}

}
