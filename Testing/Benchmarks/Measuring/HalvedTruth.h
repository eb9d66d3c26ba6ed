// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// The right answer as two estimates that are independent of each other and of all that is compared
/// with them: where differences from the two are multiplied, their noise has no part on the
/// average.
struct HalvedTruth
{
  /// Of these cells: the mean square difference from the truth over the area, in units of the
  /// square of the mean irradiance. May come out negative where it is small beside the noise.
  double squaredError(const CellField& field, const CellField& areas, const CellSet& set) const;

  CellField first, second; ///< W/m2
};

/// Two ways to the truth in one: each half the mean of both, on each set of cells with weights by
/// their noise there. The sets must not overlap.
HalvedTruth combined(const HalvedTruth& a, const HalvedTruth& b, const CellField& areas,
  const std::vector<CellSet>& sets);

/// How the mean of some runs agrees with the truth, on some cells.
struct Agreement
{
  double ratio; ///< of the mean irradiance
  double
    systematic; ///< RMS over the area / mean irradiance: what noise does not explain; negative: its square is
};

/// Throws std::runtime_error if the mean irradiance, or the irradiance of cells, differs by more
/// than noise explains and what is allowed: a thousandth is more than floats miss at edges. `runs`:
/// at least two.
Agreement requireAgreement(const std::string& who, const std::vector<CellField>& runs,
  const HalvedTruth& truth, const CellField& areas, const CellSet& set, double allowed = 1e-3);
