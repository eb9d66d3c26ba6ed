// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Lights/LightTable.h"
#include "Surfaces/CellShapes.h"

#include <vector>

namespace irradiance
{

/**
 * Marks the sides of cells to which no light can come at all: the inner sides of closed dynamic
 * shells that are proven to be simple, in objects whose bounds have no light in them. `lights`: the
 * bounds of each.
 */
void markInnerSides(CellShapes& cells, const Frame& frame, const std::vector<Box>& lights);

/**
 * Marks the sides of flat cells to which no light can come at all, since everything is behind them:
 * the outer sides of a room. `bounds`: of the scene, and of all lights but those that are `distant`.
 */
void markOuterSides(
  CellShapes& cells, const Box& bounds, const std::vector<const DistantLight*>& distant);

/**
 * Marks the sides of cells to which no light can come straight from the lights of a table, whatever
 * stands where: as markInnerSides(), and the outer sides of these cells where they are flat and
 * turn away from all lights.
 */
void markDarkSides(CellShapes& cells, const Frame& frame, const LightTable& lights);

}
