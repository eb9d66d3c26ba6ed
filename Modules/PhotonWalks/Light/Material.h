// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Material_h
#define irradiance_Material_h

#include "Light/PointLight.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// How cells of an object reflect and emit. Arrays hold one value per cell and band, cell-major.
struct Material
{
  int bands = 1; ///< 1 or 3
  std::size_t numberOfCells = 0;
  std::vector<std::uint32_t> cellOfTriangle;
  std::vector<double> reflectance; ///< diffuse, 0..1
  std::vector<double> exitance;    ///< W/m2 from the front; empty: none
  std::vector<PointLight> pointLights;
  /// The first cell of each input, if there are several.
  std::vector<std::size_t> firstCellOfPart;

  bool emits() const { return !exitance.empty() || !pointLights.empty(); }
  double reflectanceOf(std::uint32_t triangle, int band) const
  {
    return reflectance[cellOfTriangle[triangle] * static_cast<std::size_t>(bands) +
      static_cast<std::size_t>(band)];
  }

  std::uint32_t partOfCell(std::size_t cell) const
  {
    return static_cast<std::uint32_t>(
      std::upper_bound(firstCellOfPart.begin(), firstCellOfPart.end(), cell) -
      firstCellOfPart.begin());
  }

  friend bool operator==(const Material& a, const Material& b)
  {
    return a.bands == b.bands && a.numberOfCells == b.numberOfCells &&
      a.cellOfTriangle == b.cellOfTriangle && a.reflectance == b.reflectance &&
      a.exitance == b.exitance && a.pointLights == b.pointLights &&
      a.firstCellOfPart == b.firstCellOfPart;
  }
};

}

#endif
