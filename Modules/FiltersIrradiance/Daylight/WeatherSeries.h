// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WeatherSeries_h
#define irradiance_WeatherSeries_h

#include "Daylight/SunPosition.h"

#include <string>
#include <vector>

namespace irradiance
{

struct WeatherRow
{
  std::string where; ///< for messages
  ClockTime time;
  double directNormal, diffuseHorizontal; ///< W/m2
};

/// The rows of a file as vtkSunSkySource.h describes it, one at least. Throws InputError, naming
/// file, line, column and value.
std::vector<WeatherRow> readWeather(const std::string& fileName);

}

#endif
