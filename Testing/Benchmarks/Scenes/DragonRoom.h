// SPDX-License-Identifier: BSD-3-Clause
#ifndef DragonRoom_h
#define DragonRoom_h

#include "Surfaces/SceneObjects.h"

#include <optional>

/// The large scene of makeRoomScene() with materials: a lamp lights the room from its place there,
/// each quad of the walls and each triangle of the dragon is a cell. Nothing when its meshes are
/// not there.
std::optional<irradiance::SceneObjects> makeDragonRoom();

#endif
