// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SensorDirectLight_h
#define irradiance_SensorDirectLight_h

#include "DirectLight/PointDirectLight.h"
#include "IrradianceEngine.h"

#include <deque>

namespace irradiance
{

/// The light that comes straight to sensors from the lights for which cells gather it. That of all
/// others arrives with the photons of walks.
class SensorDirectLight
{
public:
  /// Of the present frame of an engine, which must not change meanwhile.
  explicit SensorDirectLight(const IrradianceEngine& engine);

  /// W/m2, of the surface on which a sensor stands. `number`: of the sensor. May be called by
  /// several threads.
  Bands irradiance(const Foot& foot, std::uint64_t number) const;

private:
  const Scene& scene_;
  std::deque<PointDirectLight> groups_;
};

}

#endif
