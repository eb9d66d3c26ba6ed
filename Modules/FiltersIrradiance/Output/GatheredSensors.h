// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatheredSensors_h
#define irradiance_GatheredSensors_h

#include "Output/LightArrays.h"
#include "Output/SensorRun.h"
#include "Views/StoredSensors.h"

#include <cstdint>
#include <string>

namespace irradiance
{

/// What sensors gather, see SensorGather: irradiance, or the fluence rate of sensors without
/// normals.
class GatheredSensors
{
public:
  /// Adds arrays to an output; with `haveErrors` one of standard errors.
  GatheredSensors(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors);

  /// By rays as the settings say; what is `stored` is used again, and updated. Returns a warning,
  /// or nothing. Throws Interrupted, and what SensorGather throws.
  struct Settings
  {
    std::uint32_t rays; ///< for each sensor
    bool keepsRays;
  };
  std::string measure(const SensorRun& run, const Settings& settings, StoredSensors& stored);

private:
  LightArrays arrays_;
};

}

#endif
