// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Surfaces/SceneObjects.h"

/// A room of 4 x 4 x 3 m with 14 x 14 cells a side and a ball of 3,000 cells, lit by a panel of 100
/// W below the ceiling. `hasTable`: it shines by a lopsided table of 181 polar angles and 73
/// azimuths, else it is diffuse.
irradiance::SceneObjects makePanelRoom(bool hasTable);

/// 8 x 6 x 2.8 m, six table tops, 12 luminaires of 25 polar angles and 20 azimuths; some 10,000
/// cells.
irradiance::SceneObjects makeOffice();

/// Twenty houses on two sides of a street of 140 m, below a sky; some 5,000 cells. No cell of the
/// ground is in a house, and houses have no floor, so that no light gets in.
irradiance::SceneObjects makeStreet(irradiance::Sky sky);

/// Forty trackers of 12 modules each, which follow the sun from east to west, above a ground of
/// 1,600 cells; a clear sky and a sun with a disc. `hour`: 0..24 at an equinox; at night there is
/// no light.
irradiance::SceneObjects makeTrackers(double hour);
