// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearestSensors_h
#define irradiance_NearestSensors_h

#include "Output/SensorRun.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"

namespace irradiance
{

/// What the photons nearest to sensors tell.
class NearestSensors
{
public:
  struct Settings
  {
    std::uint32_t photons; ///< for each sensor, >= 2
    double maximumRadius,  ///< m; 0: what suits the scene
      maximumDistance;     ///< m; likewise
  };

  /// Adds arrays to an output.
  NearestSensors(vtkDataSet* output, int bands);

  /// Collects photons and surfaces first. Returns a warning, or nothing. Throws Interrupted.
  std::string measure(const SensorRun& run, const Settings& settings);

private:
  vtkSmartPointer<vtkDoubleArray> irradiances_;
  vtkSmartPointer<vtkIdTypeArray> counts_;
  vtkSmartPointer<vtkDoubleArray> radii_;
};

}

#endif
