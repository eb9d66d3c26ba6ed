// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "IrradianceEngine.h"

#include <vector>

/// A value for each cell of a scene, object after object.
using CellField = Eigen::ArrayXd;

/// `value(object, cell, area)` of each cell; areas are in m2, in the world.
template <class Value>
CellField fieldOf(const irradiance::SceneObjects& objects, const Value& value)
{
  std::vector<double> field;
  for (std::uint32_t object = 0; object < objects.size(); ++object)
  {
    const std::vector<double> areas = irradiance::cellAreas(objects[object]);
    for (std::size_t cell = 0; cell < areas.size(); ++cell)
    {
      field.push_back(value(object, cell, areas[cell]));
    }
  }
  return Eigen::Map<CellField>(field.data(), static_cast<Eigen::Index>(field.size()));
}

inline CellField areasOf(const irradiance::SceneObjects& objects)
{
  return fieldOf(objects, [](std::uint32_t, std::size_t, double area) { return area; });
}

/// W/m2 in the first band.
inline CellField irradianceOf(
  const irradiance::IrradianceEngine& engine, const irradiance::SceneObjects& objects)
{
  return fieldOf(objects, [&](std::uint32_t object, std::size_t cell, double) {
    return engine.irradiance({ object, cell }, 0);
  });
}

/// The mean over the area.
inline double meanOf(const CellField& field, const CellField& areas)
{
  return (field * areas).sum() / areas.sum();
}
