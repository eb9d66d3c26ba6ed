// SPDX-License-Identifier: BSD-3-Clause
#include "Output/NearestSensors.h"

#include "Data/ArrayNames.h"
#include "Photons/NearestEstimate.h"
#include "Views/SensorFinalGather.h"

#include <limits>
#include <optional>
#include <sstream>

namespace irradiance
{

NearestSensors::NearestSensors(vtkDataSet* output, int bands)
  : irradiances_(addPointArray<vtkDoubleArray>(output, irradianceName(), bands))
  , counts_(addPointArray<vtkIdTypeArray>(output, kNumberOfPhotons, 1))
  , radii_(addPointArray<vtkDoubleArray>(output, kSearchRadius, 1))
{
  output->GetPointData()->SetActiveScalars(irradianceName().c_str());
}

std::string NearestSensors::measure(const SensorRun& run, const Settings& settings)
{
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  IrradianceEngine& engine = *run.engine;
  engine.collectPhotons(run.execution);
  engine.prepareSurfaces(run.execution);
  const NearestPhotons nearest = engine.nearestPhotons();
  const double maximumDistance =
    settings.maximumDistance > 0 ? settings.maximumDistance : usualDistance(nearest);
  const double maximumRadius =
    settings.maximumRadius > 0 ? settings.maximumRadius : usualRadius(nearest, settings.photons);
  const std::deque<PointDirectLight> lights = gatheredLightsOf(engine);
  std::vector<char> areLost(run.sensors.size());
  run.forEachUnit(run.sensors.size(), run.execution, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i)
    {
      const auto point = static_cast<vtkIdType>(i);
      const std::optional<Foot> foot = nearest.footOf(run.sensors[i], maximumDistance);
      const NearestEstimate estimate = foot
        ? nearestEstimate(nearest, *foot, settings.photons, maximumRadius)
        : NearestEstimate{ {}, 0, kUnknown, 0 };
      areLost[i] = foot ? 0 : 1;
      const Bands direct = foot ? directLightAt(*foot, i, lights, engine.scene()) : Bands{};
      for (int band = 0; band < irradiances_->GetNumberOfComponents(); ++band)
      {
        irradiances_->SetTypedComponent(point, band,
          estimate.area > 0 ? direct[static_cast<std::size_t>(band)] +
              engine.watts(estimate.power[band]) / estimate.area
                            : kUnknown);
      }
      counts_->SetTypedComponent(point, 0, static_cast<vtkIdType>(estimate.found));
      radii_->SetTypedComponent(point, 0, estimate.radius);
    }
  });
  std::ostringstream where;
  where << maximumDistance << " m from a surface that faces as they do";
  return run.textOfLost(areLost, where.str(),
    "Irradiance is NaN, as the photons on surfaces tell nothing of sensors in the air: Estimate "
    "Gathered measures there. MaximumDistance says how far from a surface sensors may lie");
}

}
