// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "RoomWindow.h"

namespace interactiveroom
{

/**
 * Drags the chosen thing to and fro for so many frames, lets go, and prints frames a second, what a
 * frame's time went into, and the time from there to the exact light; for each of five rounds, then
 * their medians.
 */
void PrintDragTiming(RoomWindow& window, LightFollower& light, int frames);

}
