// SPDX-License-Identifier: BSD-3-Clause
#include "Daylight/WeatherSeries.h"

#include "Input/CommaTable.h"
#include "Progress/InputError.h"

namespace irradiance
{

namespace
{

double irradianceIn(const CommaTable& table, const std::string& column)
{
  const double value = table.value(column);
  throwIf(value < 0,
    table.where() + ", column " + column + ": " + text(value) + " W/m2; it has to be 0 or more");
  return value;
}

}

std::vector<WeatherRow> readWeather(const std::string& fileName)
{
  CommaTable table(fileName, true);
  table.require({ "time", "dni", "dhi" });
  std::vector<WeatherRow> rows;
  while (table.next())
  {
    const std::string& time = table.cell("time");
    const auto clock = parseTime(time);
    throwIf(!clock,
      table.where() + ", column time: \"" + time + "\" is no time such as 2024-06-21 12:00");
    throwIf(!rows.empty() && clock->seconds <= rows.back().time.seconds,
      table.where() + ": the time " + time + " is not after that of the row before");
    rows.push_back(
      { table.where(), *clock, irradianceIn(table, "dni"), irradianceIn(table, "dhi") });
  }
  throwIf(rows.empty(), "the file " + fileName + " has no row of weather");
  return rows;
}

}
