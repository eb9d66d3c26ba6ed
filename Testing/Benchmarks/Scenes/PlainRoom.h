// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Scenes/MovingTeapotScene.h"

#include <vector>

/// A room of 4 x 4 x 3 m with 14 x 14 cells a wall, reflectances of .05 to .9 at random, a lamp of
/// 4 cells below the ceiling, and two closed meshes, a ring of 6,000 triangles and a knobbly ball
/// of 960, whose triangles are cells. Both may move, but only the ring does. `size`: m, across the
/// ring, at most 1.8; the ball is .8 m.
MovingScene makePlainRoom(double size = 0.8);

/**
 * The plain room, and others that differ in what decides between shooting and gathering:
 *
 *   real      each wall has one reflectance, .3 to .8
 *   bright    reflectances of .7 to .9 at random; dark: of .1 to .3
 *   points    four point lights, no lamp
 *   lamps64   64 panels below the ceiling and a lamp of 5 cm that is 5 cm over the floor
 *   lamps16   14 larger panels, that lamp, and a strip of 3.6 m that is 5 cm from a wall
 */
std::vector<MovingScene> makeGatheringRooms();

/// The same walls and lamp, with so many balls of 320 triangles, which are cells. All of them move.
/// `size`: m, across.
MovingScene makeRoomOfMovers(int movers, double size);

/// The same room, in which that share of the cells, chosen at random, also reflects half of what it
/// would absorb, in lobes with an exponent of 50.
MovingScene makeGlossyRoom(double share, double size = 0.8);
