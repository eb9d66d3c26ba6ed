// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Room.h"

namespace interactiveroom
{

/**
 * A scene of meshes from files, each where its file has it; lengths are multiplied by `unit` (m).
 * If no mesh shines, a lamp hangs above them. Throws std::runtime_error that names the option and
 * the file.
 */
Room ReadUserRoom(const std::vector<std::string>& stillFiles,
  const std::vector<std::string>& movingFiles, double unit);

}
