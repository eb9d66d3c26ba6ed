// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/AloneRequest.h"

#include "Pipeline/UpstreamRequest.h"

#include "vtkInformation.h"

namespace irradiance
{

namespace
{

vtkInformationIntegerKey* aloneRequest()
{
  static auto* const key = new UpstreamRequest("ALONE_NEEDED", "ALONE_COMPUTED");
  return key;
}

}

void requestAlone(vtkInformation* input, bool isAlone)
{
  // Where nobody ever asked there is no key, and nothing executes again.
  if (isAlone || input->Has(aloneRequest()))
  {
    input->Set(aloneRequest(), isAlone ? 1 : 0);
  }
}

bool isAloneRequested(vtkInformation* output)
{
  return output->Has(aloneRequest()) && output->Get(aloneRequest()) == 1;
}

}
