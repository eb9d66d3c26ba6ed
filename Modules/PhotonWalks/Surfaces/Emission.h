// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Vector.h"
#include "Sampling/DirectionTable.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

namespace irradiance
{

/// An isotropic point source of an object.
struct PointSource
{
  Vector3 position;         ///< in the space of its object
  std::vector<double> flux; ///< W, one per band
  std::uint32_t cell = 0;   ///< of its object

  friend bool operator==(const PointSource& a, const PointSource& b)
  {
    return a.position == b.position && a.flux == b.flux && a.cell == b.cell;
  }
};

/// A lamp whose radiant intensity is given for each direction. It shines from points, or from the
/// fronts of cells that are its opening: a flat one, or a convex body.
struct Luminaire
{
  std::shared_ptr<const DirectionTable> intensity; ///< in any unit, as `flux` gives the power
  Vector3 axis, reference;                         ///< of the table: unit vectors in its object
  std::vector<double> flux;                        ///< W, one per band
  /// Area vectors of the opening, in its object, m2: the sum of all triangles in planes that are
  /// parallel, up to .1 degrees. Empty: it shines from points.
  std::vector<Vector3> faces;

  friend bool operator==(const Luminaire& a, const Luminaire& b)
  {
    return *a.intensity == *b.intensity &&
      std::tie(a.axis, a.reference, a.flux, a.faces) ==
      std::tie(b.axis, b.reference, b.flux, b.faces);
  }
};

/// The light that an object itself gives off.
struct Emission
{
  int bands = 1; ///< 1 or 3
  /// W/m2 from the front, one value per cell and band, cell-major; empty: none.
  std::vector<double> exitance;
  std::vector<PointSource> points;
  std::vector<Luminaire> luminaires;
  /// Which of these each cell belongs to, or kNone; empty: none does. Of a cell of an opening,
  /// the exitance is the mean over all directions before it was scaled by a pose.
  std::vector<std::uint32_t> luminaireOfCell;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// The group of each cell's lights; empty: all are in `group`. To an engine all are one, see
  /// GroupLamps.
  std::vector<std::uint32_t> groups;
  std::uint32_t group = 0;

  std::uint32_t groupOf(std::size_t cell) const { return groups.empty() ? group : groups[cell]; }
  bool isEmpty() const { return exitance.empty() && points.empty(); }
  /// Null for a cell of an object without exitance; else one value per band.
  const double* exitanceOf(std::size_t cell) const
  {
    return exitance.empty() ? nullptr : &exitance[cell * static_cast<std::size_t>(bands)];
  }
  /// Null for a cell whose light leaves alike in all directions.
  const Luminaire* luminaireOf(std::size_t cell) const
  {
    return luminaireOfCell.empty() || luminaireOfCell[cell] == kNone
      ? nullptr
      : &luminaires[luminaireOfCell[cell]];
  }
  bool hasExitance(std::size_t cell) const
  {
    const double* const first = exitanceOf(cell);
    return first && std::any_of(first, first + bands, [](double watts) { return watts > 0; });
  }
  /// Whether light of a cell starts walks: by its exitance, or from a point source of it.
  bool emits(std::size_t cell) const
  {
    return hasExitance(cell) ||
      std::any_of(points.begin(), points.end(),
        [cell](const PointSource& source) { return source.cell == cell; });
  }

  friend bool operator==(const Emission& a, const Emission& b)
  {
    return a.bands == b.bands && a.exitance == b.exitance && a.points == b.points &&
      a.luminaires == b.luminaires && a.luminaireOfCell == b.luminaireOfCell &&
      a.groups == b.groups && a.group == b.group;
  }
};

}
