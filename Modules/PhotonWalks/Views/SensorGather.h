// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorGather_h
#define irradiance_SensorGather_h

#include "Photons/Sensor.h"
#include "Views/ViewGather.h"

#include <deque>
#include <vector>

namespace irradiance
{

/**
 * What sensors receive, on surfaces or in the air: irradiance, or of a sensor that receives from all directions the
 * fluence rate. The direct light of all lights is asked for at the very point, see PointDirectLight. Indirect
 * light comes by a final gather from there, see ViewGather. Theory.md, 5.8.
 *
 * All is a pure function of the scene, the seed, the sums, and the place and number of a sensor.
 */
class SensorGather
{
public:
  using Bands = PointDirectLight::Bands;

  /// Of the present frame of an engine, which must not change meanwhile. It stores all walks, or tells sides
  /// apart. `rays`: to lights and for indirect light each; rounded up to a multiple of the replicates.
  /// Throws Interrupted, and InputError where a point light shines on specular cells.
  SensorGather(const IrradianceEngine& engine, std::uint32_t rays, Execution& execution);

  /// W/m2.
  struct Light
  {
    Bands value; ///< NaN of a sensor that is too far away, see sensorPlace()
    /// From the variance between replicates; NaN without these, or if none of them received anything.
    Bands standardError;
  };
  /// At the sensors of these numbers, which choose the samples. Throws std::runtime_error for a path that does
  /// not end. May be called by several threads.
  std::vector<Light> at(
    const std::vector<Sensor>& sensors, const std::vector<std::size_t>& numbers) const;

private:
  /// What came by paths, to the `start`-th start, and straight from the lights.
  std::vector<Bands> replicatesOf(
    const PathSums& brought, std::size_t start, const LitPoint& point, std::size_t number) const;
  static Light lightOf(const std::vector<Bands>& replicates);

  CellShapes noShapes_;
  ViewGather gather_;
  std::deque<PointDirectLight>
    direct_; ///< for the points themselves; each sample is of one replicate
};

}

#endif
