// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Estimates/CellEstimate.h"
#include "Surfaces/SceneCells.h"
#include "Walks/LightSurvey.h"

#include <functional>

namespace irradiance
{

/// Which settings a user leaves to the scene.
struct LeftToScene
{
  bool directLight = false;
  bool cellEstimate = false;
};

/// Rays of a side at least.
constexpr std::uint32_t kFewestRays = 4;

/**
 * Chooses what is left to the scene of a frame: to gather wherever that pays.
 *
 * The cell estimate is Gathered or Spread, else Sums, if
 * - direct light may be gathered, and rays read what walks brought (no `unbiasedGather`);
 * - cells that expect enough photons to be read, see CellRoles::isRead(), have half of the area;
 * - the rays of both sides of all small cells are at most 1.2 times the walks, so that they take
 *   about as long as all else; where there are more, each cell has half as many until that holds,
 *   down to kFewestRays;
 * - no point light is unseen, see unseenLight().
 *
 * Of these two it is Gathered where the rays of a small cell are less noise than the photons of
 * walks that the cell could draw on: what rests is lit evenly, lights are easily found, or small
 * parts catch few photons. See Documentation/Theory.md, 1.3.
 *
 * Direct light is gathered if the estimate is Gathered, or could be but for the noise, or if there
 * are no more cells than walks; with Spread only where samples cost much less than walks.
 *
 * This follows from the settings and the frame alone, never from what was shot: so an update
 * chooses as a fresh start does. No rigid motion changes it, but of lights, and a part that comes
 * or goes may. `walks` and `estimate` hold all that is asked for, and take what is chosen;
 * `gathersDirectLight` tells whether that may be, if it is left. `cells`: of the objects. `survey`:
 * of the lights; called only if it is needed.
 */
void chooseByScene(const LeftToScene& left, const SceneObjects& objects, const SceneCells& cells,
  const std::function<const LightSurvey&()>& survey, WalkSettings& walks,
  EstimateSettings& estimate);

}
