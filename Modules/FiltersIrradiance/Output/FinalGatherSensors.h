// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_FinalGatherSensors_h
#define irradiance_FinalGatherSensors_h

#include "Output/LightArrays.h"
#include "Output/SensorRun.h"
#include "Views/StoredSensors.h"

#include <cstdint>
#include <string>

namespace irradiance
{

/// What sensors gather, see SensorFinalGather: irradiance, or the fluence rate of sensors without
/// normals.
class FinalGatherSensors
{
public:
  /// Adds arrays to an output; with `haveErrors` one of standard errors.
  FinalGatherSensors(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors);

  /// By so many rays for each sensor; what is `stored` is used again, and updated. Returns a
  /// warning, or nothing. Throws Interrupted, and what SensorFinalGather throws.
  std::string measure(const SensorRun& run, std::uint32_t rays, StoredSensors& stored);

private:
  LightArrays arrays_;
};

}

#endif
