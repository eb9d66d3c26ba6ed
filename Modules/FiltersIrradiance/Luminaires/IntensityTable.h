// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_IntensityTable_h
#define irradiance_IntensityTable_h

#include "Geometry/Vector.h"

#include <cstddef>
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

  Vector3 direction(double polarDegrees, double azimuthDegrees) const;
  /// The exact integral over the sphere.
  double flux() const;
  void scale(double factor);
};

/// Angles of a table in one direction, and which of the angles in the file each one stands for.
struct StoredAngles
{
  explicit StoredAngles(const std::vector<double>& angles);

  std::vector<double> degrees;
  std::vector<std::size_t> stored;

  /// What follows the last angle mirrors what is before it.
  void mirrorAtLast();
  /// The first angle also follows the last one, a turn later, unless it is there.
  void closeIfOpen();
};

/// With angles that count the other way round.
StoredAngles reversed(StoredAngles angles);

/// The table of a file's values; the strides are from one stored angle to the next.
IntensityTable expandedTable(const StoredAngles& polar, const StoredAngles& azimuth,
  const std::vector<double>& values, std::size_t polarStride, std::size_t azimuthStride);

}

#endif
