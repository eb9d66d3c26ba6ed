// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AloneRequest_h
#define irradiance_AloneRequest_h

class vtkInformation;

namespace irradiance
{

/// Travels up the pipeline to vtkIrradianceFilter: asks an input to be computed by this process
/// alone, whatever the Controller there, or, with false, no longer. For filters that share other
/// work over processes.
void requestAlone(vtkInformation* input, bool isAlone);

/// Whether somebody has asked this of an output.
bool isAloneRequested(vtkInformation* output);

}

#endif
