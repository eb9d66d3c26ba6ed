// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Sampling/DirectionTable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace irradiance
{

/// Intensities over the sphere, linear in both angles between those of the table. The direction is
/// cos(polar) axis + sin(polar) (cos(azimuth) reference + sin(azimuth) reference x axis).
struct IntensityTable
{
  std::vector<double> polar; ///< degrees, not decreasing; no light below the first, above the last
  std::vector<double> azimuth; ///< degrees, increasing; one alone: round about the axis
  std::vector<double> values;  ///< all polar angles of the first azimuth, then of the second ...
  Vector3 axis{ 0, 0, -1 };
  Vector3 reference{ 1, 0, 0 };

  Vector3 direction(double polarDegrees, double azimuthDegrees) const
  {
    constexpr double kDegree = kPi / 180;
    const double p = polarDegrees * kDegree, a = azimuthDegrees * kDegree;
    return std::cos(p) * axis +
      std::sin(p) * (std::cos(a) * reference + std::sin(a) * reference.cross(axis));
  }
  /// The exact integral over the sphere.
  double flux() const { return DirectionTable(polar, azimuth, values).integral(); }
  void scale(double factor)
  {
    for (double& value : values)
    {
      value *= factor;
    }
  }
};

/// Angles of a table in one direction, and which of the angles in the file each one stands for.
struct StoredAngles
{
  explicit StoredAngles(const std::vector<double>& angles)
    : degrees(angles)
    , stored(angles.size())
  {
    std::iota(stored.begin(), stored.end(), std::size_t{ 0 });
  }

  std::vector<double> degrees;
  std::vector<std::size_t> stored;

  /// What follows the last angle mirrors what is before it.
  void mirrorAtLast()
  {
    const double mirror = degrees.back();
    for (std::size_t i = degrees.size() - 1; i-- > 0;)
    {
      degrees.push_back(2 * mirror - degrees[i]);
      stored.push_back(stored[i]);
    }
  }
  /// The first angle also follows the last one, a turn later, unless it is there.
  void closeIfOpen()
  {
    if (degrees.back() < degrees.front() + 360)
    {
      degrees.push_back(degrees.front() + 360);
      stored.push_back(stored.front());
    }
  }
};

/// With angles that count the other way round.
inline StoredAngles reversed(StoredAngles angles)
{
  std::reverse(angles.degrees.begin(), angles.degrees.end());
  std::reverse(angles.stored.begin(), angles.stored.end());
  for (double& angle : angles.degrees)
  {
    angle = 0 - angle; // not -0
  }
  return angles;
}

/// The table of a file's values; the strides are from one stored angle to the next.
inline IntensityTable expandedTable(const StoredAngles& polar, const StoredAngles& azimuth,
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
