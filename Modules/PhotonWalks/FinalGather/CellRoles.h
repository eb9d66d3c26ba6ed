// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "DirectLight/DarkSides.h"
#include "Surfaces/CellShapes.h"
#include "Walks/WalkSets.h"

#include <algorithm>
#include <cstdint>
#include <memory>
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
    bool readsCells = true)
    : cells_(cells)
    , isEverywhere_(isEverywhere)
    , readsCells_(readsCells)
    , photons_(kPhotonsPerRay * rays)
  {
    double area = 0;
    cells.numbers().forEach([&](const SceneCell& cell) { area += cells.area(cell); });
    walksPerArea_ = area > 0 ? walks / area : 0;
  }

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
inline std::vector<bool> unevenCells(const CellShapes& shapes, const CellRoles& roles,
  const WalkSets& walks, const CancelPoint& cancelPoint)
{
  // Lamps are near within so many radii of a cell: two to three edges of a square.
  constexpr double kNear = 2;
  constexpr double kMuch = 0.1; // the part of the light that may come from there
  std::vector<std::shared_ptr<const LampPieces>> lamps;
  std::vector<LampChoice> choices;
  for (const WalkSet& set : walks.sets())
  {
    const WalkSource& source = set.source();
    if (!source.lights.isEmpty() && (source.areNear || (source.cells && !source.isDynamic())))
    {
      lamps.push_back(source.knownLamps());
      choices.emplace_back(*lamps.back());
    }
  }
  std::vector<bool> areUneven;
  if (choices.empty())
  {
    return areUneven;
  }
  ThrottledCancelPoint pace(cancelPoint);
  std::size_t number = 0;
  shapes.numbers().forEach([&](const SceneCell& cell) {
    const CellShape& shape = shapes[number++];
    pace.step();
    const double reach = kNear * shape.radius;
    const auto mayBeNear = [&](const LampChoice& choice) { return choice.distance(shape) < reach; };
    if (cell.object > 0 || !roles.isRead(cell) ||
      std::none_of(choices.begin(), choices.end(), mayBeNear))
    {
      return;
    }
    double near = 0, all = 0;
    for (LampChoice& choice : choices)
    {
      all += choice.expectedPower(shape);
      near += choice.powerFromWithin(reach);
    }
    if (near > kMuch * all)
    {
      areUneven.resize(shapes.size());
      areUneven[number - 1] = true;
    }
  });
  return areUneven;
}

/// By number, the cells whose emission rays count where they meet it, as nobody looks for it (see
/// FirstHits::dimLights()); empty: none.
inline std::vector<bool> foundLamps(const WalkSets& walks, const CellNumbers& cells)
{
  std::vector<bool> areFound;
  for (const WalkSet& set : walks.sets())
  {
    const bool areLamps = set.source().areFoundByRays && !set.source().isSky();
    for (std::size_t i = 0; areLamps && i < set.lights().lights().size(); ++i)
    {
      areFound.resize(cells.size());
      areFound[cells[set.lights()[i].cell]] = true;
    }
  }
  return areFound;
}

/// The shapes of all cells of a frame. Marked are sides to which no light can come at all, neither
/// straight from the lights nor from elsewhere: the outer sides of a room; and where direct light
/// is gathered the inner ones of closed dynamic objects.
inline CellShapes darkShapesOf(
  const WalkSets& walks, const Frame& frame, const CancelPoint& cancelPoint)
{
  std::vector<Box> lights;
  std::vector<const DistantLight*> distant;
  Box bounds = frame.scene.bounds();
  bool areGathered = false;
  for (const WalkSet& set : walks.sets())
  {
    areGathered = areGathered || set.gathered();
    for (const Light& light : set.lights().lights())
    {
      lights.push_back(light.stand());
      bounds.add(light.stand());
      if (light.distant())
      {
        distant.push_back(light.distant());
      }
    }
  }
  CellShapes shapes(frame, 0, frame.objects.size(), cancelPoint);
  if (areGathered) // else solid sides have not been found
  {
    markInnerSides(shapes, frame, lights);
  }
  markOuterSides(shapes, bounds, distant);
  return shapes;
}

}
