// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SkyModel_h
#define irradiance_SkyModel_h

#include "Daylight/SunPosition.h"

namespace irradiance
{

/// How the radiance of a sky is spread over it, in any unit: (1 + a exp(b / cos Z)) (f + c exp(d
/// chi) + e cos^2 chi), where Z is the angle from the zenith and chi the angle from the sun.
struct SkyShape
{
  double a = 0, b = -1, c = 0, d = -1, e = 0, f = 1;
  bool isOvercast = false; ///< (1 + 2 cos Z) instead: CIE's traditional overcast sky, type 16

  bool isRound() const { return c == 0 && e == 0; }
  /// At the horizon it is the limit for b < 0.
  double radiance(double cosZenith, double sunAngle) const;
};

/// Types 1 to 15 of the CIE general sky (ISO 15469).
SkyShape cieSky(int type);

/// Perez, Seals and Michalsky (1993). `diffuseHorizontal` > 0; the sun is not below the horizon.
/// For some input b > 0, and the radiance grows without limit towards the horizon.
SkyShape perezSky(
  double directNormal, double diffuseHorizontal, double sunAltitude, double distanceFactor);

}

#endif
