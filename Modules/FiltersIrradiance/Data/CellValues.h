// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellValues_h
#define irradiance_CellValues_h

#include "Exposure/ReplicateSums.h"

class vtkDataArray;

namespace irradiance
{

/// The values of an array as doubles; they share it if it has doubles. Null for null.
SharedValues valuesOf(vtkDataArray* array);

}

#endif
