// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/UpstreamRequest.h"

namespace irradiance
{

namespace
{

constexpr const char* kLocation = "vtkIrradianceFilter";

}

UpstreamRequest::UpstreamRequest(const char* name, const char* given)
  : vtkInformationIntegerRequestKey(name, kLocation)
{
  this->DataKey = new vtkInformationIntegerKey(given, kLocation);
}

}
