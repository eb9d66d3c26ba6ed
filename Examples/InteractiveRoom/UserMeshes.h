// SPDX-License-Identifier: BSD-3-Clause
#ifndef UserMeshes_h
#define UserMeshes_h

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

#endif
