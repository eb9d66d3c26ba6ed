// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scenes/MovingTeapotScene.h"

/// A scene in which speed is traded for accuracy. Every triangle is a cell.
struct TradeScene : MovingScene
{
  bool isFurnace = false; ///< the truth is 1 W/m2 everywhere
};

/// The scene of Examples/MovingTeapot with larger cells, its head decimated; a closed box with a
/// lamp and a box that moves; and a furnace in which a white sphere moves, lit by all of its walls.
/// `head`: a file in the OFF format.
std::vector<TradeScene> makeTradeScenes(const std::string& head);

/// Every triangle cut into four `levels` times, each piece a cell: cell i becomes the cells 4 i to
/// 4 i + 3.
irradiance::SceneObjects subdivided(const irradiance::SceneObjects& objects, int levels);
