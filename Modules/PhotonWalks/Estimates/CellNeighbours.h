// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Geometry/Triangle.h"
#include "Progress/CancelPoint.h"

#include <array>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// Two cells that continue each other across an edge.
struct CellNeighbours
{
  std::array<std::uint32_t, 2> cells;
  bool isTurned;      ///< the front of one continues the back of the other
  double conductance; ///< length of the edge / distance of the cells' middles across it
};

/// Cosine of the largest fold between neighbours, 35 degrees. Folds of up to 30 degrees are
/// commonly shaded as smooth. A regular prism of 12 sides folds by just that, so the limit lies
/// above, where rounding decides nothing.
constexpr double kCosineOfMostFold = 0.81915204428899178;

/**
 * Cells are neighbours where a triangle of one and a triangle of the other have an edge with
 * exactly the same two corners, no third triangle has that edge, and the surface folds there by no
 * more than kCosineOfMostFold allows. Triangles without area are as if they were not there. Two
 * cells are listed once for each edge that they share. Apart from the order of the list, the result
 * does not depend on the order of cells.
 *
 * Lengths and distances are measured on points (x, normalLength * n), where x is the place and n
 * the normal, in six dimensions: a turn of the surface by an angle counts as a way of normalLength
 * times the angle. So what diffuses keeps to where the surface faces the same way, as light does.
 * The area that it fills stays the same: as much as it is narrower, it is longer.
 */
std::vector<CellNeighbours> cellNeighbours(const std::vector<Triangle>& triangles,
  const std::vector<std::uint32_t>& cellOfTriangle, std::size_t numberOfCells, double normalLength,
  const CancelPoint& cancelPoint = {});

}
