// SPDX-License-Identifier: BSD-3-Clause
#include "Output/SensorLight.h"

#include "Data/ArrayNames.h"
#include "Execution/Execution.h"
#include "IrradianceEngine.h"
#include "Photons/NearestPhotons.h"
#include "Pipeline/WalkMemory.h"
#include "Views/SensorFinalGather.h"

#include "vtkDataSet.h"
#include "vtkIdTypeArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace irradiance
{

namespace
{

/// "2 of 5 sensors lie farther than `where`: the first is point 1 at (...). Their `what`"; empty if
/// none is lost.
std::string textOfLost(const std::vector<Sensor>& sensors, const std::vector<char>& areLost,
  const std::string& where, const std::string& what)
{
  const auto lost = std::find(areLost.begin(), areLost.end(), char{ 1 });
  if (lost == areLost.end())
  {
    return {};
  }
  const auto first = static_cast<std::size_t>(lost - areLost.begin());
  const Vector3& position = sensors[first].position;
  std::ostringstream message;
  message << std::count(areLost.begin(), areLost.end(), char{ 1 }) << " of " << sensors.size()
          << " sensors lie farther than " << where << ": the first is point " << first << " at ("
          << position[0] << ", " << position[1] << ", " << position[2] << "). Their " << what;
  return message.str();
}

/// Adds arrays of what each light group brings, beside those of all.
void addGroups(const SensorRun& run, const LightArrays& whole, const GroupSensors& stored)
{
  for (const LightGroup& group : run.groups.all())
  {
    const auto count = static_cast<vtkIdType>(run.sensors.size());
    const LightArrays arrays(run.output->GetPointData(), nameOfGroup(whole.name(), group.name),
      whole.bands(), count, whole.haveErrors());
    for (vtkIdType i = 0; i < count; ++i)
    {
      arrays.set(i, SensorFinalGather::lightOf(stored.ofGroup(group, static_cast<std::size_t>(i))));
    }
  }
}

}

LightArrays addGatheredLight(vtkDataSet* output, int bands, bool haveNormals, bool haveErrors)
{
  const std::string name = haveNormals ? irradianceName() : kFluenceRate;
  vtkPointData* points = output->GetPointData();
  const LightArrays arrays(points, name, bands, output->GetNumberOfPoints(), haveErrors);
  points->SetActiveScalars(name.c_str());
  return arrays;
}

std::string gatherLight(
  const SensorRun& run, const LightArrays& arrays, std::uint32_t rays, GroupSensors& stored)
{
  stored.update(
    run.groups, run.sensors, rays, mayKeepRays(run.sensors.size(), rays), run.execution);
  std::vector<char> areLost;
  vtkIdType unknown = 0; // errors, of values that are known
  for (const GroupSensors::Replicates& replicates : stored.replicates())
  {
    const SensorFinalGather::Light light = SensorFinalGather::lightOf(replicates);
    arrays.set(static_cast<vtkIdType>(areLost.size()), light);
    areLost.push_back(std::isnan(light.value[0]) ? 1 : 0);
    const auto* const errors = light.standardError.data();
    const bool isUnknown = std::any_of(
      errors, errors + arrays.bands(), [](double number) { return std::isnan(number); });
    unknown += areLost.back() == 0 && isUnknown ? 1 : 0;
  }
  if (arrays.haveErrors())
  {
    addTuple<vtkIdTypeArray>(run.output->GetFieldData(), "NumberOfUnknownErrors", { unknown });
  }
  if (run.areGroupsApart)
  {
    addGroups(run, arrays, stored);
  }
  return textOfLost(run.sensors, areLost, "a million sizes of the scene from it",
    "values are NaN, as rounding would tell what they see");
}

void addNearestLight(vtkDataSet* output, int bands)
{
  vtkPointData* points = output->GetPointData();
  const vtkIdType count = output->GetNumberOfPoints();
  addArray<vtkDoubleArray>(points, irradianceName(), bands, count);
  addArray<vtkIdTypeArray>(points, kNumberOfPhotons, 1, count);
  addArray<vtkDoubleArray>(points, kSearchRadius, 1, count);
  points->SetActiveScalars(irradianceName().c_str());
}

std::string measureNearestLight(
  const SensorRun& run, std::uint32_t photons, double maximumRadius, double maximumDistance)
{
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  constexpr std::size_t kUnit = 64; // sensors
  const int bands = run.groups.any().objects().staticObject.material->bands;
  addNearestLight(run.output, bands);
  vtkPointData* points = run.output->GetPointData();
  auto* irradiances = vtkDoubleArray::SafeDownCast(points->GetArray(irradianceName().c_str()));
  auto* counts = vtkIdTypeArray::SafeDownCast(points->GetArray(kNumberOfPhotons));
  auto* radii = vtkDoubleArray::SafeDownCast(points->GetArray(kSearchRadius));
  for (vtkDataArray* array : { static_cast<vtkDataArray*>(irradiances),
         static_cast<vtkDataArray*>(counts), static_cast<vtkDataArray*>(radii) })
  {
    array->Fill(0);
  }
  double distance = 0;
  std::vector<char> areLost(run.sensors.size());
  run.groups.forEachLit([&](const LightGroup& group) {
    IrradianceEngine& engine = *group.engine;
    engine.collectPhotons(run.execution);
    engine.prepareSurfaces(run.execution);
    const NearestPhotons nearest = engine.nearestPhotons();
    distance = maximumDistance > 0 ? maximumDistance : usualDistance(nearest);
    const double radius = maximumRadius > 0 ? maximumRadius : usualRadius(nearest, photons);
    const std::deque<PointDirectLight> lights = gatheredLightsOf(engine);
    forEachSliced((run.sensors.size() + kUnit - 1) / kUnit, run.execution, [&](std::size_t unit) {
      for (std::size_t i = unit * kUnit; i < std::min((unit + 1) * kUnit, areLost.size()); ++i)
      {
        const auto point = static_cast<vtkIdType>(i);
        const std::optional<Foot> foot = nearest.footOf(run.sensors[i], distance);
        const NearestEstimate estimate = foot ? nearestEstimate(nearest, *foot, photons, radius)
                                              : NearestEstimate{ {}, 0, kUnknown, 0 };
        areLost[i] = foot ? 0 : 1;
        const Bands direct = foot ? directLightAt(*foot, i, lights, engine.scene()) : Bands{};
        for (int band = 0; band < bands; ++band)
        {
          const double found = estimate.area > 0 ? direct[static_cast<std::size_t>(band)] +
              engine.watts(estimate.power[band]) / estimate.area
                                                 : kUnknown;
          irradiances->SetTypedComponent(
            point, band, irradiances->GetTypedComponent(point, band) + group.shown(found, band));
        }
        counts->SetTypedComponent(point, 0,
          std::max(counts->GetTypedComponent(point, 0), static_cast<vtkIdType>(estimate.found)));
        const double widest = radii->GetTypedComponent(point, 0);
        radii->SetTypedComponent(
          point, 0, estimate.radius > widest || !foot ? estimate.radius : widest);
      }
    });
  });
  std::ostringstream where;
  where << distance << " m from a surface that faces as they do";
  return textOfLost(run.sensors, areLost, where.str(),
    "Irradiance is NaN, as the photons on surfaces tell nothing of sensors in the air: Estimate "
    "Gathered measures there. MaximumDistance says how far from a surface sensors may lie");
}

}
