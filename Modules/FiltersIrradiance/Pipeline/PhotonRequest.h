// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_PhotonRequest_h
#define irradiance_PhotonRequest_h

class vtkInformation;
class vtkInformationIntegerKey;

namespace irradiance
{

/// Travels up the pipeline from a filter that needs photons to vtkIrradianceFilter. If that has not
/// kept them (nothing can move, so it had no reason to), it executes again.
vtkInformationIntegerKey* photonRequest();

/// Asks for the photons of an input.
void requestPhotons(vtkInformation* input);

/// Whether somebody has asked an output for its photons.
bool arePhotonsRequested(vtkInformation* output);

/// Likewise for what each side of the cells received: a filter that does not tell sides apart keeps
/// the photons, from which that is counted.
void requestSides(vtkInformation* input);
bool areSidesRequested(vtkInformation* output);

}

#endif
