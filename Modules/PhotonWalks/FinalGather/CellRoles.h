// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_CellRoles_h
#define irradiance_CellRoles_h

#include "Surfaces/CellShapes.h"
#include "Walks/WalkSets.h"

#include <algorithm>
#include <cstdint>
#include <vector>

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

/// By number, large static cells that lamps light from nearer than the cell is wide, as those of a
/// cove do with the ceiling; empty: none. The bright spot is smaller than the cell, and what it
/// receives on average says little of the point that a ray hits. Such cells are not read. Lamps
/// that are hard to find make none: to ask them adds more noise than there is bias. Nor do dynamic
/// cells count: with each that came near a lamp, or left it, all paths would be others. `shapes`:
/// of the static cells at least.
std::vector<bool> unevenCells(const CellShapes& shapes, const CellRoles& roles,
  const WalkSets& walks, const CancelPoint& cancelPoint);

/// By number, the cells whose emission rays count where they meet it, as nobody looks for it (see
/// FirstHits::dimLights()); empty: none.
std::vector<bool> foundLamps(const WalkSets& walks, const CellNumbers& cells);

/// The shapes of all cells of a frame. Marked are sides to which no light can come at all, neither
/// straight from the lights nor from elsewhere: the outer sides of a room; and where direct light
/// is gathered the inner ones of closed dynamic objects.
CellShapes darkShapesOf(const WalkSets& walks, const Frame& frame, const CancelPoint& cancelPoint);

}

#endif
