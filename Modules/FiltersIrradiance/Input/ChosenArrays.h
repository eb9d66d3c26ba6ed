// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_ChosenArrays_h
#define irradiance_ChosenArrays_h

#include "Input/InputConnection.h"

#include <string>

namespace irradiance
{

/// Finds the arrays that the filter was told to read in a part, and notes among its warnings which
/// ones it will overlook: on the points, or nearly called as the array of a quantity that the part
/// has no array for.
void findArrays(vtkAlgorithm* filter, InputPart& part);

/// Throws InputError if the filter was told to read an array of the points or of the field data, or
/// one that no input has.
void checkChosenArrays(vtkAlgorithm* filter, const SceneInputs& inputs);

/// What to say of a scene without light: which arrays it could come from, and which ones are there
/// but not read.
std::string noLightWarning(vtkAlgorithm* filter, const SceneInputs& inputs);

}

#endif
