// SPDX-License-Identifier: BSD-3-Clause
#include "PhotonRequest.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationIntegerRequestKey.h"

namespace irradiance
{

namespace
{

/// On the data object: for which request it was made.
vtkInformationIntegerKey* keptPhotons()
{
  static auto* const key = new vtkInformationIntegerKey("PHOTONS_KEPT", "vtkIrradianceFilter");
  return key;
}

class RequestKey : public vtkInformationIntegerRequestKey
{
public:
  RequestKey()
    : vtkInformationIntegerRequestKey("PHOTONS_NEEDED", "vtkIrradianceFilter")
  {
    this->DataKey = keptPhotons();
  }
};

}

// Keys are owned by VTK's key manager and live as long as the program.
vtkInformationIntegerKey* photonRequest()
{
  static auto* const key = new RequestKey;
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

}
