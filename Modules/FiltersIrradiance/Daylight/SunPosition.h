// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_SunPosition_h
#define irradiance_SunPosition_h

#include <array>
#include <optional>
#include <string>

namespace irradiance
{

struct ClockTime
{
  double seconds; ///< since noon of 2000-01-01
  int dayOfYear;  ///< 1 on January 1st
};

/// Reads a time such as 2024-06-21 12:00 or 2024-06-21T12:00:30, of the years 1901 to 2099; none if
/// it is no such time.
std::optional<ClockTime> parseTime(const std::string& time);

/// Where the middle of the sun is, degrees.
struct SunPosition
{
  double azimuth; ///< from north over east
  double altitude;

  /// The unit vector towards the sun: x east, y north, z up.
  std::array<double, 3> direction() const;
};

/// The sun without refraction, after Michalsky (1988): within .01 degrees from 1950 to 2050. Time
/// is UT, latitude and longitude are degrees, north and east positive.
SunPosition sunPosition(double secondsSince2000, double latitude, double longitude);

/// The square of mean over actual distance of the sun (Spencer 1971), by which the extraterrestrial
/// irradiance of a day differs from its mean over the year.
double distanceFactor(int dayOfYear);

}

#endif
