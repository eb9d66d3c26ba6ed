// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SkyTable_h
#define irradiance_SkyTable_h

#include "Daylight/SkyModel.h"

#include <string>
#include <vector>

namespace irradiance
{

/// Radiance from above, bilinear in polar angle and azimuth.
struct SkyTable
{
  std::vector<double> polarAngles; ///< degrees from the zenith; 90, twice, where the ground begins
  std::vector<double> azimuths;    ///< degrees from +y over +x, 0..360; one: round
  std::vector<double> radiance;    ///< W/m2/sr, all polar angles of the first azimuth first
  std::string note;                ///< what the model did not allow; empty: nothing

  /// The exact integral of radiance times the cosine, over all above the horizon.
  double horizontalIrradiance() const;
  /// Adds a ground of one radiance.
  void addGround(double groundRadiance);
};

/// A sky with this diffuse horizontal irradiance, exactly. Steps are 2.5 degrees at most, finer
/// around the sun and over the horizon. Where the shape is not possible, it is changed, and noted:
/// b > 0 becomes 0, and a negative radiance 0.
SkyTable skyTable(SkyShape shape, const SunPosition& sun, double diffuseHorizontal);

}

#endif
