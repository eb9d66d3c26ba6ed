// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scenes/MovingTeapotScene.h"

#include <optional>
#include <vector>

/// A scene that is lit in one of the ways in which users light theirs.
struct LightingScene : MovingScene
{
  /// The static objects by which the same light is known, if walks would hardly find it in this
  /// scene.
  std::optional<irradiance::SceneObject> truthIn;
};

/**
 * One for each way in which light comes: a panel; tubes of 48 and of 2,000 facets; a bulb of 2,000
 * facets; 400 LEDs; a luminous ceiling; everything emits, and the irradiance is 1 W/m2; an oven of
 * warm walls and two lamps; lamps behind a louvre; a cove; two rooms with a door; 100 street lamps;
 * four point lights; a mover that emits; a hut with a lamp a thousandth as strong as one outside; a
 * mover of 18,000 cells in a hall of 15,000; a module of 3,200 cells in 4 km of rows below an even
 * sky.
 *
 * Most are rooms of 4 x 4 x 3 m with 14 x 14 cells a side that reflect half of the light, and a
 * ball of .6 m and 3,000 cells that moves 2 cm a frame.
 */
std::vector<LightingScene> makeLightingScenes();
