// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "vtkMath.h"

#include <array>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <locale>
#include <optional>
#include <sstream>
#include <string>

namespace irradiance
{

/// Days from 2000-01-01. Month 13 is the next January. From March of 1900 to February of 2100.
inline int daysFrom2000(int year, int month, int day)
{
  return 367 * year - 7 * (year + (month + 9) / 12) / 4 + 275 * month / 9 + day - 730531;
}

struct ClockTime
{
  double seconds; ///< since noon of 2000-01-01
  int dayOfYear;  ///< 1 on January 1st
};

/// Reads a time such as 2024-06-21 12:00 or 2024-06-21T12:00:30, of the years 1901 to 2099; none if
/// it is no such time.
inline std::optional<ClockTime> parseTime(const std::string& time)
{
  // A std::istream takes what ends early for a time, too, so the lengths tell.
  const bool hasSeconds = time.size() == 19;
  if (!hasSeconds && time.size() != 16)
  {
    return std::nullopt;
  }
  std::string format = hasSeconds ? "%Y-%m-%d %H:%M:%S" : "%Y-%m-%d %H:%M";
  format[8] = time[10] == 'T' ? 'T' : ' ';
  std::istringstream stream(time);
  stream.imbue(std::locale::classic());
  std::tm clock{};
  stream >> std::get_time(&clock, format.c_str());
  if (stream.fail() || stream.peek() != std::istringstream::traits_type::eof())
  {
    return std::nullopt;
  }
  const int year = clock.tm_year + 1900, month = clock.tm_mon + 1;
  const int first = daysFrom2000(year, month, 1);
  if (year < 1901 || year > 2099 || clock.tm_mday > daysFrom2000(year, month + 1, 1) - first)
  {
    return std::nullopt;
  }
  const int day = first + clock.tm_mday - 1;
  return ClockTime{ 86400. * day + 3600 * (clock.tm_hour - 12) + 60 * clock.tm_min + clock.tm_sec,
    day - daysFrom2000(year, 1, 1) + 1 };
}

/// Where the middle of the sun is, degrees.
struct SunPosition
{
  double azimuth; ///< from north over east
  double altitude;

  /// The unit vector towards the sun: x east, y north, z up.
  std::array<double, 3> direction() const
  {
    const double turn = vtkMath::RadiansFromDegrees(azimuth);
    const double height = vtkMath::RadiansFromDegrees(altitude);
    return { std::sin(turn) * std::cos(height), std::cos(turn) * std::cos(height),
      std::sin(height) };
  }
};

/// The sun without refraction, after Michalsky (1988): within .01 degrees from 1950 to 2050. Time
/// is UT, latitude and longitude are degrees, north and east positive.
inline SunPosition sunPosition(double secondsSince2000, double latitude, double longitude)
{
  const auto radians = [](double degrees) { return vtkMath::RadiansFromDegrees(degrees); };
  const double days = secondsSince2000 / 86400;
  const double meanLongitude = 280.460 + 0.9856474 * days;
  const double anomaly = radians(357.528 + 0.9856003 * days);
  const double ecliptic =
    radians(meanLongitude + 1.915 * std::sin(anomaly) + 0.020 * std::sin(2 * anomaly));
  const double obliquity = radians(23.439 - 4e-7 * days);
  const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));
  const double rightAscension =
    std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
  // Hours of sidereal time in Greenwich at 0 h UT, and what has passed of the day.
  const double sidereal =
    6.697375 + 0.0657098242 * days + 24 * (days + 0.5 - std::floor(days + 0.5));
  const double hourAngle = radians(15 * sidereal + longitude) - rightAscension;
  const double place = radians(latitude);
  const double east = -std::cos(declination) * std::sin(hourAngle);
  const double north = std::sin(declination) * std::cos(place) -
    std::cos(declination) * std::sin(place) * std::cos(hourAngle);
  const double up = std::sin(declination) * std::sin(place) +
    std::cos(declination) * std::cos(place) * std::cos(hourAngle);
  return { vtkMath::DegreesFromRadians(std::atan2(east, north)),
    vtkMath::DegreesFromRadians(std::atan2(up, std::hypot(east, north))) };
}

/// The square of mean over actual distance of the sun (Spencer 1971), by which the extraterrestrial
/// irradiance of a day differs from its mean over the year.
inline double distanceFactor(int dayOfYear)
{
  const double turn = 2 * vtkMath::Pi() * (dayOfYear - 1) / 365;
  return 1.00011 + 0.034221 * std::cos(turn) + 0.00128 * std::sin(turn) +
    0.000719 * std::cos(2 * turn) + 0.000077 * std::sin(2 * turn);
}

}
