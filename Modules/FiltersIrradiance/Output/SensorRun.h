// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorRun_h
#define irradiance_SensorRun_h

#include "Data/NamedArray.h"
#include "Execution/SlicedPass.h"
#include "IrradianceEngine.h"
#include "Photons/Sensor.h"

#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace irradiance
{

/// Sensors that are to be measured, and where the values go: to point arrays of the output.
struct SensorRun
{
  const std::vector<Sensor>& sensors;
  std::shared_ptr<IrradianceEngine> engine; ///< of the scene, up to date
  Execution& execution;
  vtkDataSet* output; ///< with a point for each sensor

  int bands() const { return engine->objects().staticObject.material->bands; }
  /// Calls measure(first, end) for so many sensors, some at a time, on all threads. Throws
  /// Interrupted.
  template <class Measure>
  void forEachUnit(std::size_t count, Execution& part, const Measure& measure) const
  {
    constexpr std::size_t kUnit = 64;
    forEachSliced((count + kUnit - 1) / kUnit, part,
      [&](std::size_t unit) { measure(unit * kUnit, std::min((unit + 1) * kUnit, count)); });
  }
  /// "2 of 5 sensors lie farther than `where`: the first is point 1 at (...). Their `what`"; empty
  /// if none is lost.
  std::string textOfLost(
    const std::vector<char>& areLost, const std::string& where, const std::string& what) const;
};

/// Adds a point array, whose values are to be set.
template <class Array>
vtkSmartPointer<Array> addPointArray(vtkDataSet* data, const std::string& name, int components)
{
  return addArray<Array>(data->GetPointData(), name, components, data->GetNumberOfPoints());
}

}

#endif
