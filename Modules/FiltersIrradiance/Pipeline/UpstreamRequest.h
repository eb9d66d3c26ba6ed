// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_UpstreamRequest_h
#define irradiance_UpstreamRequest_h

#include "vtkInformationIntegerRequestKey.h"

namespace irradiance
{

/// Travels up the pipeline from a filter that needs more than usual to vtkIrradianceFilter. If that
/// has not computed it, it executes again. VTK's key manager owns such keys: they live as long as
/// the program.
class UpstreamRequest : public vtkInformationIntegerRequestKey
{
public:
  /// `given`: the name of a key on data objects, which says for which request they were made.
  UpstreamRequest(const char* name, const char* given);
};

}

#endif
