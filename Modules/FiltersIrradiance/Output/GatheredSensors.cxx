// SPDX-License-Identifier: BSD-3-Clause
#include "Output/GatheredSensors.h"

#include "Data/ArrayNames.h"
#include "Execution/ProgressSpan.h"

#include <cmath>
#include <utility>

namespace irradiance
{

namespace
{

void gather(const SensorRun& run, std::uint32_t rays, const std::vector<std::size_t>& numbers,
  std::vector<SensorGather::Light>& lights)
{
  constexpr double kPrepared = 0.25; // of the progress, roughly, if sides are to be counted
  ProgressSpan preparing(run.execution, 0, kPrepared), gathering(run.execution, kPrepared, 1);
  const SensorGather gather(*run.engine, rays, preparing);
  run.forEachUnit(numbers.size(), gathering, [&](std::size_t first, std::size_t end) {
    const std::vector<std::size_t> unit(numbers.begin() + static_cast<std::ptrdiff_t>(first),
      numbers.begin() + static_cast<std::ptrdiff_t>(end));
    const std::vector<SensorGather::Light> found = gather.at(run.sensors, unit);
    for (std::size_t i = 0; i < unit.size(); ++i)
    {
      lights[unit[i]] = found[i];
    }
  });
}

}

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

std::string GatheredSensors::measure(const SensorRun& run, std::uint32_t rays, Kept& kept)
{
  const Kept before = std::exchange(kept, {});
  const bool isSameScene = before.engine.lock() == run.engine &&
    before.state == run.engine->state() && before.rays == rays;
  std::vector<SensorGather::Light> lights(run.sensors.size());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < lights.size(); ++i)
  {
    const bool isKept =
      isSameScene && i < before.sensors.size() && before.sensors[i] == run.sensors[i];
    isKept ? void(lights[i] = before.lights[i]) : changed.push_back(i);
  }
  if (!changed.empty())
  {
    gather(run, rays, changed, lights);
  }
  std::vector<char> areLost;
  for (const SensorGather::Light& light : lights)
  {
    set(static_cast<vtkIdType>(areLost.size()), light);
    areLost.push_back(std::isnan(light.value[0]) ? 1 : 0);
  }
  kept = { run.engine, run.engine->state(), rays, run.sensors, std::move(lights) };
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
