// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_MeanReflectance_h
#define irradiance_MeanReflectance_h

#include "Surfaces/SceneObjects.h"

namespace irradiance
{

/// The part of the light that an object reflects, diffusely and specularly, if it arrives alike
/// everywhere: the mean over its area and the bands, 0..1; 0 for an object without area.
double meanReflectance(const SceneObject& object);

}

#endif
