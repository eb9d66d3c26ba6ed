// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatheredSensors_h
#define irradiance_GatheredSensors_h

#include "Output/SensorRun.h"

#include "vtkDoubleArray.h"

namespace irradiance
{

/// What sensors gather, see SensorGather: irradiance, or the fluence rate of sensors without normals.
class GatheredSensors
{
public:
  /// Adds arrays to an output; with `haveErrors` one of standard errors.
  GatheredSensors(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors);

  /// With so many rays for each sensor. Returns a warning, or nothing. Throws Interrupted, and what
  /// SensorGather throws.
  std::string measure(const SensorRun& run, std::uint32_t rays);

private:
  vtkSmartPointer<vtkDoubleArray> values_, errors_; ///< or null
};

}

#endif
