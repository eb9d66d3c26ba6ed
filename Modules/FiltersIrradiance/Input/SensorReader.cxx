// SPDX-License-Identifier: BSD-3-Clause
#include "Input/SensorReader.h"

#include "Progress/InputError.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <cmath>
#include <sstream>

namespace irradiance
{

namespace
{

[[noreturn]] void fail(vtkIdType point, const char* what, const Vector3& value)
{
  std::ostringstream message;
  message << "the sensors, point " << point << ": the " << what << " (" << value[0] << ", "
          << value[1] << ", " << value[2] << ") is ";
  message << (value.allFinite() ? "of length 0" : "not finite");
  throw InputError(message.str());
}

}

vtkDataArray* sensorNormals(vtkDataSet* input)
{
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  return normals ? normals : input->GetPointData()->GetArray("Normals");
}

std::vector<Sensor> readSensors(vtkDataSet* input, vtkDataArray* normals)
{
  if (normals && normals->GetNumberOfComponents() != 3)
  {
    throw InputError("the normals of the sensors have " +
      std::to_string(normals->GetNumberOfComponents()) + " components; three are needed");
  }
  std::vector<Sensor> sensors(static_cast<std::size_t>(input->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    Sensor& sensor = sensors[static_cast<std::size_t>(i)];
    input->GetPoint(i, sensor.position.data());
    if (!sensor.position.allFinite())
    {
      fail(i, "position", sensor.position);
    }
    sensor.normal.setZero();
    if (normals)
    {
      normals->GetTuple(i, sensor.normal.data());
      const double length = sensor.normal.stableNorm();
      if (!(length > 0) || !std::isfinite(length))
      {
        fail(i, "normal", sensor.normal);
      }
      sensor.normal /= length;
    }
  }
  return sensors;
}

}
