// SPDX-License-Identifier: BSD-3-Clause
#ifndef CellSet_h
#define CellSet_h

#include "Measuring/CellField.h"

#include <vector>

/// Some cells of a scene, one after another.
struct CellSet
{
  std::string name;
  Eigen::Index first, count;

  Eigen::Index end() const { return first + count; }
  /// Of these cells alone.
  CellField of(const CellField& field) const { return field.segment(first, count); }
};

/// All cells; those of the static object, with the lamps; those of the dynamic ones.
inline std::vector<CellSet> cellSetsOf(const irradiance::SceneObjects& objects)
{
  const Eigen::Index all = areasOf(objects).size();
  const auto walls = static_cast<Eigen::Index>(irradiance::cellAreas(objects.staticObject).size());
  return { { "all", 0, all }, { "walls", 0, walls }, { "movers", walls, all - walls } };
}

#endif
