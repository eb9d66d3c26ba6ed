// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Daylight/SunPosition.h"

#include <string>
#include <vector>

namespace irradiance
{

/// How the radiance of a sky is spread over it, in any unit: (1 + a exp(b / cos Z)) (f + c exp(d
/// chi) + e cos^2 chi), where Z is the angle from the zenith and chi the angle from the sun.
struct SkyShape
{
  double a = 0, b = -1, c = 0, d = -1, e = 0, f = 1;
  bool isOvercast = false; ///< (1 + 2 cos Z) instead: CIE's traditional overcast sky, type 16
};

/// Types 1 to 15 of the CIE general sky (ISO 15469).
SkyShape cieSky(int type);

/// Perez, Seals and Michalsky (1993). `diffuseHorizontal` > 0; the sun is not below the horizon.
/// For some input b > 0, and the radiance grows without limit towards the horizon.
SkyShape perezSky(
  double directNormal, double diffuseHorizontal, double sunAltitude, double distanceFactor);

/// Radiance from above, bilinear in polar angle and azimuth.
struct SkyTable
{
  std::vector<double> polarAngles; ///< degrees from the zenith; 90, twice, where the ground begins
  std::vector<double> azimuths;    ///< degrees from +y over +x, 0..360; one: round
  std::vector<double> radiance;    ///< W/m2/sr, all polar angles of the first azimuth first
  std::string note;                ///< what the model did not allow; empty: nothing

  /// Adds a ground of one radiance.
  void addGround(double groundRadiance);
};

/// A sky with this diffuse horizontal irradiance, exactly. Steps are 2.5 degrees at most, finer
/// around the sun and over the horizon. Where the shape is not possible, it is changed, and noted:
/// b > 0 becomes 0, and a negative radiance 0.
SkyTable skyTable(SkyShape shape, const SunPosition& sun, double diffuseHorizontal);

}
