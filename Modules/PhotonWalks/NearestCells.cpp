// SPDX-License-Identifier: BSD-3-Clause
#include "NearestCells.h"

#include "Execution/SlicedPass.h"

#include <cmath>
#include <limits>

namespace irradiance
{

NearestCells::Middles NearestCells::middlesOf(
  const SceneObject& object, const Checkpoint& checkpoint)
{
  const std::size_t cells = object.material->numberOfCells;
  Middles middles{ std::vector<Vector3>(cells, Vector3::Zero()),
    std::vector<Vector3>(cells, Vector3::Zero()), std::vector<double>(cells, 0.0) };
  CheckpointPace pace(checkpoint);
  for (std::size_t i = 0; object.isPresent && i < object.body->mesh().size(); ++i)
  {
    const Triangle triangle = transformed(object.worldFromObject, object.body->mesh()[i]);
    const std::size_t cell = object.material->cellOfTriangle[i];
    const double area = triangle.area();
    middles.positions[cell] += area * (triangle.a + triangle.b + triangle.c) / 3;
    middles.normals[cell] += triangle.areaVector();
    middles.areas[cell] += area;
    pace.step();
  }
  return middles;
}

NearestCells::NearestCells(const NearestPhotons& photons, const CellSums& sums, std::uint32_t count,
  double photon, Execution& execution)
  : count_(count)
  , sides_(static_cast<std::size_t>(sums.sides()))
  , bands_(static_cast<std::size_t>(photons.objects().staticObject.material->bands))
{
  const SceneObjects& objects = photons.objects();
  std::vector<Sensor> sensors;
  std::vector<std::size_t> places; // of the densities of their sides
  std::size_t cells = 0;
  double received = 0, area = 0; // photons, m2
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    firstCell_.push_back(cells);
    const Middles middle = middlesOf(objects[object], checkpointOf(execution, 0));
    for (std::size_t cell = 0; cell < middle.areas.size(); ++cell)
    {
      area += middle.areas[cell];
      for (std::size_t side = 0; side < sides_; ++side)
      {
        double power = 0;
        for (int band = 0; band < static_cast<int>(bands_); ++band)
        {
          power += static_cast<double>(sums.sum(object, cell, static_cast<int>(side), band));
        }
        received += power / photon;
        const double length = middle.normals[cell].norm();
        if (power / photon < count && length > 0)
        {
          const Vector3 normal = middle.normals[cell] / length;
          sensors.push_back(
            { middle.positions[cell] / middle.areas[cell], side == 0 ? normal : Vector3(-normal) });
          places.push_back(((cells + cell) * sides_ + side) * bands_);
        }
      }
    }
    cells += middle.areas.size();
  }
  densities_.assign(cells * sides_ * bands_, std::numeric_limits<double>::quiet_NaN());
  maximumRadius_ = received > 0 ? 2 * std::sqrt(count * area / received / 3.141592653589793) : 0;
  if (!(maximumRadius_ > 0))
  {
    return;
  }
  constexpr std::size_t kUnit = 32;
  SlicedPass pass{ (sensors.size() + kUnit - 1) / kUnit, {} };
  pass.work = [&](std::size_t unit, const Deadline&) {
    for (std::size_t i = unit * kUnit; i < std::min((unit + 1) * kUnit, sensors.size()); ++i)
    {
      estimate(photons, sensors[i], &densities_[places[i]]);
    }
    return true;
  };
  pass.run(execution);
}

/// Where sides are not kept apart, what both receive.
void NearestCells::estimate(
  const NearestPhotons& photons, const Sensor& sensor, double* densities) const
{
  for (const double side : { 1.0, -1.0 })
  {
    const NearestEstimate estimate =
      nearestEstimate(photons, { sensor.position, side * sensor.normal }, count_, maximumRadius_);
    for (std::size_t band = 0; band < bands_ && estimate.area > 0; ++band)
    {
      const double density =
        static_cast<double>(estimate.power[static_cast<int>(band)]) / estimate.area;
      densities[band] = density + (side > 0 ? 0 : densities[band]);
    }
    if (sides_ == 2 || !(estimate.area > 0))
    {
      return;
    }
  }
}

}
