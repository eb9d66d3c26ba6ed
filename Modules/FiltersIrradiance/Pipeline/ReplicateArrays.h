// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ReplicateArrays_h
#define irradiance_ReplicateArrays_h

#include <string>

class vtkInformation;

namespace irradiance
{

/**
 * Cell arrays that a vtkIrradianceFilter writes for those who ask for them, and for nobody else. With
 * ComputeStandardError: what each replicate by itself says of the irradiance.
 *
 * One component for each replicate and band, the bands of the first replicate first, W/m2. `suffix`: Front,
 * Back, or none.
 */
inline std::string replicatesName(const std::string& suffix)
{
  return "Irradiance" + suffix + "Replicates";
}

/// With or without standard errors: the irradiance that one photon of full power is, in each band, W/m2.
inline std::string photonName(const std::string& suffix)
{
  return "Irradiance" + suffix + "OfPhoton";
}

/// Asks for the arrays of an input, or, with false, no longer.
void requestReplicates(vtkInformation* input, bool areNeeded);

/// Whether somebody has asked an output for them.
bool areReplicatesRequested(vtkInformation* output);

}

#endif
