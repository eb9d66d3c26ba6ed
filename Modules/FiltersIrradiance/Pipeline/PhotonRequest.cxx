// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/PhotonRequest.h"

#include "Pipeline/UpstreamRequest.h"

#include "vtkInformation.h"

namespace irradiance
{

namespace
{

vtkInformationIntegerKey* sideRequest()
{
  static auto* const key = new UpstreamRequest("SIDES_NEEDED", "SIDES_KEPT");
  return key;
}

}

vtkInformationIntegerKey* photonRequest()
{
  static auto* const key = new UpstreamRequest("PHOTONS_NEEDED", "PHOTONS_KEPT");
  return key;
}

void requestPhotons(vtkInformation* input)
{
  input->Set(photonRequest(), 1);
}

bool arePhotonsRequested(vtkInformation* output)
{
  return output->Has(photonRequest()) != 0;
}

void requestSides(vtkInformation* input)
{
  input->Set(sideRequest(), 1);
}

bool areSidesRequested(vtkInformation* output)
{
  return output->Has(sideRequest()) != 0;
}

}
