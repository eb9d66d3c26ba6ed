// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/ReplicateRequest.h"

#include "Pipeline/UpstreamRequest.h"

#include "vtkInformation.h"

namespace irradiance
{

namespace
{

vtkInformationIntegerKey* replicateRequest()
{
  static auto* const key = new UpstreamRequest("REPLICATES_NEEDED", "REPLICATES_WRITTEN");
  return key;
}

}

void requestReplicates(vtkInformation* input, bool areNeeded)
{
  // The key stays, with a 0: an absent one would not tell data with replicates from data without.
  input->Set(replicateRequest(), areNeeded ? 1 : 0);
}

bool areReplicatesRequested(vtkInformation* output)
{
  return output->Has(replicateRequest()) && output->Get(replicateRequest()) == 1;
}

}
