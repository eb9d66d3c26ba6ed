// SPDX-License-Identifier: BSD-3-Clause
#include "Luminaires/IntensityTable.h"

#include "Sampling/DirectionTable.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace irradiance
{

Vector3 IntensityTable::direction(double polarDegrees, double azimuthDegrees) const
{
  constexpr double kDegree = kPi / 180;
  const double p = polarDegrees * kDegree, a = azimuthDegrees * kDegree;
  return std::cos(p) * axis +
    std::sin(p) * (std::cos(a) * reference + std::sin(a) * reference.cross(axis));
}

double IntensityTable::flux() const
{
  return DirectionTable(polar, azimuth, values).integral();
}

void IntensityTable::scale(double factor)
{
  for (double& value : values)
  {
    value *= factor;
  }
}

StoredAngles::StoredAngles(const std::vector<double>& angles)
  : degrees(angles)
  , stored(angles.size())
{
  std::iota(stored.begin(), stored.end(), std::size_t{ 0 });
}

void StoredAngles::mirrorAtLast()
{
  const double mirror = degrees.back();
  for (std::size_t i = degrees.size() - 1; i-- > 0;)
  {
    degrees.push_back(2 * mirror - degrees[i]);
    stored.push_back(stored[i]);
  }
}

void StoredAngles::closeIfOpen()
{
  if (degrees.back() < degrees.front() + 360)
  {
    degrees.push_back(degrees.front() + 360);
    stored.push_back(stored.front());
  }
}

StoredAngles reversed(StoredAngles angles)
{
  std::reverse(angles.degrees.begin(), angles.degrees.end());
  std::reverse(angles.stored.begin(), angles.stored.end());
  for (double& angle : angles.degrees)
  {
    angle = 0 - angle; // not -0
  }
  return angles;
}

IntensityTable expandedTable(const StoredAngles& polar, const StoredAngles& azimuth,
  const std::vector<double>& values, std::size_t polarStride, std::size_t azimuthStride)
{
  IntensityTable table{ polar.degrees, azimuth.degrees, {} };
  table.values.reserve(polar.degrees.size() * azimuth.degrees.size());
  for (const std::size_t plane : azimuth.stored)
  {
    for (const std::size_t row : polar.stored)
    {
      table.values.push_back(values[plane * azimuthStride + row * polarStride]);
    }
  }
  return table;
}

}
