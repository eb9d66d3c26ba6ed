// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellRoles_h
#define irradiance_CellRoles_h

#include "Surfaces/SceneCells.h"

#include <algorithm>
#include <cstdint>

namespace irradiance
{

/**
 * Which cells of a frame gather their indirect light, and which ones the rays of others read. It
 * follows from how many photons a cell would receive if walks arrived evenly over all area: from
 * areas and the number of walks alone, never from what did arrive. So the choice is not biased by
 * noise.
 */
class CellRoles
{
public:
  /// Photons from which on the sum of a cell is read. Fewer would do, as a ray of many reads it;
  /// but with several replicates each reads its own part.
  static constexpr double kFewestToRead = 25;

  /// Small cells expect fewer photons for each of their rays. The noise of n photons is about 1 /
  /// sqrt(n), that of n rays less, as each brings a mean of many photons.
  static constexpr double kPhotonsPerRay = 2;

  /// Large cells that gather take so many times as many rays: most of the area is theirs.
  static constexpr std::uint32_t kTimesOfLarge = 4;

  /// `walks`: of all area. `rays`: of each side of a small cell; 0: none gathers. `isEverywhere`:
  /// all cells gather; else small ones. `readsCells`: else no cell is read.
  CellRoles(const SceneCells& cells, double walks, std::uint32_t rays, bool isEverywhere = false,
    bool readsCells = true);

  /// Photons that a cell of this area, m2, expects.
  double expectedOn(double area) const { return area * walksPerArea_; }
  bool gathers(const SceneCell& cell) const
  {
    return cells_.area(cell) > 0 && photons_ > 0 && (isEverywhere_ || isSmall(cell));
  }
  /// How many times the rays of the settings each side of a cell takes that gathers.
  std::uint32_t timesOf(const SceneCell& cell) const { return isSmall(cell) ? 1 : kTimesOfLarge; }
  bool isRead(const SceneCell& cell) const
  {
    return readsCells_ && expectedOn(cells_.area(cell)) >= fewestToRead();
  }
  double fewestToRead() const { return std::min(kFewestToRead, photons_); }

private:
  bool isSmall(const SceneCell& cell) const { return expectedOn(cells_.area(cell)) < photons_; }

  const SceneCells& cells_;
  bool isEverywhere_;
  bool readsCells_;
  double photons_;          ///< small cells expect fewer
  double walksPerArea_ = 0; ///< 1/m2
};

}

#endif
