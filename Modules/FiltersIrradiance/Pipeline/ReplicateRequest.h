// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ReplicateRequest_h
#define irradiance_ReplicateRequest_h

class vtkInformation;

namespace irradiance
{

/// Travels up the pipeline to vtkIrradianceFilter: asks an input for the arrays replicatesName()
/// and photonName(), or, with false, no longer.
void requestReplicates(vtkInformation* input, bool areNeeded);

/// Whether somebody has asked an output for them.
bool areReplicatesRequested(vtkInformation* output);

}

#endif
