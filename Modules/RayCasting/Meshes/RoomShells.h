// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_RoomShells_h
#define irradiance_RoomShells_h

#include "Meshes/SolidSides.h"

namespace irradiance
{

/// Marks the closed shells that are solid outside: the walls of rooms, if there may be any, and of
/// the cavities of bodies, as solidSides() says. `around`: the closed shell around each shell with
/// its front inside, see shellsAround(). Known is which shells hold all of the mesh; of those,
/// bodies with cavities lose that.
void markRooms(std::vector<Shell>& shells, const std::vector<std::uint32_t>& around,
  bool mayHoldRooms, const CancelPoint& cancelPoint);

}

#endif
