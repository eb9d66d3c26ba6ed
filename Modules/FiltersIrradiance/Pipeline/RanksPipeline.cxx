// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/RanksPipeline.h"

#include "vtkInformation.h"
#include "vtkInformationRequestKey.h"
#include "vtkObjectFactory.h"

namespace irradiance
{

vtkStandardNewMacro(RanksPipeline);

int RanksPipeline::ForwardUpstream(vtkInformation* request)
{
  const int result = this->Superclass::ForwardUpstream(request);
  if (result == 0 && request->Has(REQUEST_DATA()) && upstreamFailed)
  {
    upstreamFailed();
  }
  return result;
}

}
