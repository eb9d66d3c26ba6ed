// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_GatheredSensors_h
#define irradiance_GatheredSensors_h

#include "Output/SensorRun.h"
#include "Views/SensorGather.h"

#include "vtkDoubleArray.h"

#include <memory>

namespace irradiance
{

/// What sensors gather, see SensorGather: irradiance, or the fluence rate of sensors without normals.
class GatheredSensors
{
public:
  /// What was found last, for which state of which engine: sensors that stay, in a scene that stays, keep it.
  struct Kept
  {
    std::weak_ptr<const IrradianceEngine> engine;
    std::uint64_t state = 0;
    std::uint32_t rays = 0;
    std::vector<Sensor> sensors;
    std::vector<SensorGather::Light> lights;
  };

  /// Adds arrays to an output; with `haveErrors` one of standard errors.
  GatheredSensors(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors);

  /// With so many rays for each sensor; what is `kept` is used again, and updated. Returns a warning, or nothing.
  /// Throws Interrupted, and what SensorGather throws.
  std::string measure(const SensorRun& run, std::uint32_t rays, Kept& kept);

private:
  void set(vtkIdType point, const SensorGather::Light& light);

  vtkSmartPointer<vtkDoubleArray> values_, errors_; ///< or null
};

}

#endif
