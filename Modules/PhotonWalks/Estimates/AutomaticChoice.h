// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_AutomaticChoice_h
#define irradiance_AutomaticChoice_h

#include "Estimates/CellEstimate.h"
#include "Surfaces/SceneObjects.h"

namespace irradiance
{

/// Which settings a user leaves to the scene.
struct LeftToScene
{
  bool directLight = false;
  bool cellEstimate = false;
};

/// Gather rays pay if the average cell expects this number of photons: cells with so few that no ray reads them, see
/// CellRoles::isRead(), are then at most half of the area, however different cells are.
constexpr double kFewestWalksOfCell = 50;

/**
 * Chooses what is left to the scene of a frame: to gather wherever that pays.
 *
 * The cell estimate is Gathered, else Sums, if
 * - direct light may be gathered, and rays read what walks brought (no `unbiasedGather`);
 * - the rays of both sides of all cells are no more than the walks, so that they take about as long, and there are
 *   kFewestWalksOfCell walks for each cell;
 * - no point light is unseen, see unseenLight().
 *
 * Direct light is gathered if the estimate is Gathered, or if there are no more cells than walks.
 *
 * This follows from the settings and the frame alone, never from what was shot: so an update chooses as a fresh start
 * does. No motion changes it, but a part that comes or goes may. `walks` and `estimate` hold all that is asked for, and
 * take what is chosen; `gathersDirectLight` tells whether that may be, if it is left.
 */
void chooseByScene(const LeftToScene& left, const SceneObjects& objects, WalkSettings& walks,
  EstimateSettings& estimate);

}

#endif
