// SPDX-License-Identifier: BSD-3-Clause
#include "Output/GatheredSensors.h"

#include "Data/ArrayNames.h"
#include "Execution/ProgressSpan.h"
#include "Views/SensorGather.h"

#include <cmath>

namespace irradiance
{

GatheredSensors::GatheredSensors(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors)
{
  const std::string name = haveNormals ? irradianceName() : kFluenceRate;
  values_ = addPointArray<vtkDoubleArray>(output, name, bands);
  if (haveErrors)
  {
    errors_ = addPointArray<vtkDoubleArray>(output, standardErrorName(name), bands);
  }
  output->GetPointData()->SetActiveScalars(name.c_str());
}

std::string GatheredSensors::measure(const SensorRun& run, std::uint32_t rays)
{
  constexpr double kPrepared = 0.25; // of the progress, roughly, if sides are to be counted
  ProgressSpan preparing(run.execution, 0, kPrepared), gathering(run.execution, kPrepared, 1);
  const SensorGather gather(run.engine, rays, preparing);
  std::vector<char> areLost(run.sensors.size());
  run.forEachUnit(gathering, [&](std::size_t first, std::size_t end) {
    const std::vector<SensorGather::Light> found = gather.at(run.sensors, first, end);
    for (std::size_t i = first; i < end; ++i)
    {
      const SensorGather::Light& light = found[i - first];
      for (int band = 0; band < values_->GetNumberOfComponents(); ++band)
      {
        const auto point = static_cast<vtkIdType>(i);
        const auto component = static_cast<std::size_t>(band);
        values_->SetTypedComponent(point, band, light.value[component]);
        errors_ ? errors_->SetTypedComponent(point, band, light.standardError[component]) : void();
      }
      areLost[i] = std::isnan(light.value[0]) ? 1 : 0;
    }
  });
  return run.textOfLost(areLost, "a million sizes of the scene from it",
    "values are NaN, as rounding would tell what they see");
}

}
