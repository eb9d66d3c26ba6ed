// SPDX-License-Identifier: BSD-3-Clause
#include "Output/FinalGatherSensors.h"

#include "Data/ArrayNames.h"
#include "Pipeline/WalkMemory.h"

#include "vtkIdTypeArray.h"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

std::string nameOf(bool haveNormals)
{
  return haveNormals ? irradianceName() : kFluenceRate;
}

}

FinalGatherSensors::FinalGatherSensors(
  vtkDataSet* output, int bands, bool haveNormals, bool haveErrors)
  : arrays_(
      output->GetPointData(), nameOf(haveNormals), bands, output->GetNumberOfPoints(), haveErrors)
{
  output->GetPointData()->SetActiveScalars(nameOf(haveNormals).c_str());
}

std::string FinalGatherSensors::measure(
  const SensorRun& run, std::uint32_t rays, StoredSensors& stored)
{
  stored.update(
    run.engine, run.sensors, rays, mayKeepRays(run.sensors.size(), rays), run.execution);
  std::vector<char> areLost;
  vtkIdType unknown = 0; // errors, of values that are known
  const auto isNan = [](double number) { return std::isnan(number); };
  for (const SensorFinalGather::Light& light : stored.lights())
  {
    arrays_.set(static_cast<vtkIdType>(areLost.size()), light);
    areLost.push_back(std::isnan(light.value[0]) ? 1 : 0);
    const auto* const errors = light.standardError.data();
    unknown += areLost.back() == 0 && std::any_of(errors, errors + run.bands(), isNan) ? 1 : 0;
  }
  if (arrays_.haveErrors())
  {
    addTuple<vtkIdTypeArray>(run.output->GetFieldData(), kNumberOfUnknownErrors, { unknown });
  }
  return run.textOfLost(areLost, "a million sizes of the scene from it",
    "values are NaN, as rounding would tell what they see");
}

}
