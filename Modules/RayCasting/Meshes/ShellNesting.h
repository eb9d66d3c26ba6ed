// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Meshes/SolidSides.h"

namespace irradiance
{

constexpr std::uint32_t kNoShell = 0xffffffffu;

/// For each closed shell with its front inside, the smallest closed shell that holds it, itself
/// left out. For other shells, and where none is around, kNoShell. A shell holds another if it is
/// larger and if points close to the other one's surface, on its inner side, are all inside.
/// `bodies`: sides as if all closed shells were bodies.
std::vector<std::uint32_t> shellsAround(
  const std::vector<Triangle>& triangles, const SolidSides& bodies, const CancelPoint& cancelPoint);

/// Marks the closed shells that are solid outside: the walls of rooms, if there may be any, and of
/// the cavities of bodies, as solidSides() says. `around`: the closed shell around each shell with
/// its front inside, see shellsAround(). Known is which shells hold all of the mesh; of those,
/// bodies with cavities lose that.
void markRooms(std::vector<Shell>& shells, const std::vector<std::uint32_t>& around,
  bool mayHoldRooms, const CancelPoint& cancelPoint);

/// Whether a box holds another one, or touches it from outside by less than rounding.
bool holds(const Box& outer, const Box& inner);

}
