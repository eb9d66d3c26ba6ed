// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorReader_h
#define irradiance_SensorReader_h

#include "Photons/Sensor.h"

#include <vector>

class vtkDataArray;
class vtkDataSet;

namespace irradiance
{

/// The active normals of the points, or else the array "Normals"; null if there are none.
vtkDataArray* sensorNormals(vtkDataSet* input);

/// All points. Without normals they receive from all directions. Throws InputError, which names the
/// point, for a position or a normal that is not finite, or a normal of length 0; and for normals
/// that are no vectors.
std::vector<Sensor> readSensors(vtkDataSet* input, vtkDataArray* normals);

}

#endif
