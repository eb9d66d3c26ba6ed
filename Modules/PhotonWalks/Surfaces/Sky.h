// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"

#include <tuple>
#include <vector>

namespace irradiance
{

/// Light that comes from infinity, into a part of space. Of bands there are as many as materials
/// have. East is +x, north +y, the zenith +z.
struct Sky
{
  /// W/m2/sr in band weights, all polar angles of the first azimuth, then of the second; empty: none
  /// but the sun. See DirectionTable; degrees from the zenith, and from north over east.
  std::vector<double> radiance, polarAngles, azimuths;
  std::vector<double> bandWeights; ///< of the radiance, one per band

  Vector3 towardsSun = Vector3::UnitZ();
  std::vector<double>
    sunIrradiance;      ///< W/m2 on a plane across the light, one per band; empty: none
  double sunRadius = 0; ///< radians; 0: all light is parallel

  Box lit; ///< where light enters: all of the scene has to be inside

  friend bool operator==(const Sky& a, const Sky& b)
  {
    const auto all = [](const Sky& sky) {
      return std::tie(sky.radiance, sky.polarAngles, sky.azimuths, sky.bandWeights, sky.towardsSun,
        sky.sunIrradiance, sky.sunRadius, sky.lit.lower, sky.lit.upper);
    };
    return all(a) == all(b);
  }
};

}
