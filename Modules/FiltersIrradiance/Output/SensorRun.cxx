// SPDX-License-Identifier: BSD-3-Clause
#include "Output/SensorRun.h"

#include <sstream>

namespace irradiance
{

std::string SensorRun::textOfLost(
  const std::vector<char>& areLost, const std::string& where, const std::string& what) const
{
  const auto lost = std::find(areLost.begin(), areLost.end(), char{ 1 });
  if (lost == areLost.end())
  {
    return {};
  }
  const auto first = static_cast<std::size_t>(lost - areLost.begin());
  const Vector3& position = sensors[first].position;
  std::ostringstream message;
  message << std::count(areLost.begin(), areLost.end(), char{ 1 }) << " of " << sensors.size()
          << " sensors lie farther than " << where << ": the first is point " << first << " at ("
          << position[0] << ", " << position[1] << ", " << position[2] << "). Their " << what;
  return message.str();
}

}
