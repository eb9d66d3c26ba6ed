// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_UnevenCells_h
#define irradiance_UnevenCells_h

#include "FinalGather/CellRoles.h"
#include "Surfaces/CellShapes.h"
#include "Walks/WalkSets.h"

#include <vector>

namespace irradiance
{

/// Large static cells that lamps light from nearer than the cell is wide, as those of a cove do
/// with the ceiling: the bright spot is smaller than the cell, and what it receives on average says
/// little of the point that a ray hits. Such cells are not read. Lamps that are hard to find make
/// none: to ask them adds more noise than there is bias. Nor do dynamic cells count: with each that
/// came near a lamp, or left it, all paths would be others.
class UnevenCells
{
public:
  /// `shapes`: of the static cells at least.
  UnevenCells(const CellShapes& shapes, const CellRoles& roles, const WalkSets& walks,
    const CancelPoint& cancelPoint);

  bool contains(std::size_t cell) const { return !areUneven_.empty() && areUneven_[cell]; }

private:
  std::vector<bool> areUneven_; ///< by number; empty: none
};

}

#endif
