// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkMemory_h
#define irradiance_WalkMemory_h

#include "IrradianceEngine.h"

namespace irradiance
{

/// Throws InputError if the walks that this process is to store cannot fit into the memory that it
/// may have, before one is shot. `ranks`: that share them.
void requireMemory(const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks);

/// Whether the rays of so many sensors may be kept for frames to come: they take at most a quarter
/// of the memory.
bool mayKeepRays(std::size_t sensors, std::uint32_t raysOfEach);

/// What to say when memory ran out all the same.
std::string outOfMemory(
  const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks);

}

#endif
