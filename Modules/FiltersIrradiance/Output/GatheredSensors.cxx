// SPDX-License-Identifier: BSD-3-Clause
#include "Output/GatheredSensors.h"

#include "Data/ArrayNames.h"

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

std::string GatheredSensors::measure(
  const SensorRun& run, const Settings& settings, StoredSensors& stored)
{
  stored.update(run.engine, run.sensors, settings.rays, settings.keepsRays, run.execution);
  std::vector<char> areLost;
  for (const SensorGather::Light& light : stored.lights())
  {
    set(static_cast<vtkIdType>(areLost.size()), light);
    areLost.push_back(std::isnan(light.value[0]) ? 1 : 0);
  }
  return run.textOfLost(areLost, "a million sizes of the scene from it",
    "values are NaN, as rounding would tell what they see");
}

void GatheredSensors::set(vtkIdType point, const SensorGather::Light& light)
{
  for (int band = 0; band < values_->GetNumberOfComponents(); ++band)
  {
    const auto i = static_cast<std::size_t>(band);
    values_->SetTypedComponent(point, band, light.value[i]);
    if (errors_)
    {
      errors_->SetTypedComponent(point, band, light.standardError[i]);
    }
  }
}

}
