// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "History/BounceBlock.h"
#include "IrradianceEngine.h"
#include "Progress/InputError.h"

#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cmath>
#include <string>

namespace irradiance
{

constexpr double kMegabyte = 1e6;
constexpr double kMuchMemory = 256 * kMegabyte; ///< bytes; less is not worth asking the system

/// Of the walks that are stored here, if each has one segment.
inline double bytesOfWalks(const EngineSettings& settings, std::size_t ranks)
{
  const double walks = settings.numberOfWalks;
  const double segmentBytes = static_cast<double>(BounceBlock::pageBytes(1)) / BouncePage::kSize;
  return (settings.allOnEachRank ? walks : walks / static_cast<double>(ranks)) * segmentBytes;
}

/// All that the machine has, or the limit of the process.
inline double availableBytes()
{
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  const double machine = 1048576.0 *
    static_cast<double>(system.GetTotalPhysicalMemory() + system.GetTotalVirtualMemory());
  const double process = 1024.0 * static_cast<double>(system.GetProcMemoryAvailable());
  const double host = 1024.0 * static_cast<double>(system.GetHostMemoryAvailable());
  return process < host ? process : machine;
}

inline std::string memorySentence(const EngineSettings& settings, const char* how, double bytes)
{
  return "NumberOfWalks is " + std::to_string(settings.numberOfWalks) + ", and its walks take " +
    how + std::to_string(std::llround(bytes / kMegabyte)) + " MB to store; this process may have " +
    std::to_string(std::llround(availableBytes() / kMegabyte)) + " MB";
}

/// Throws InputError if the walks that this process is to store cannot fit into the memory that it
/// may have, before one is shot. `ranks`: that share them.
inline void requireMemory(
  const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks)
{
  // A walk from a light has at least one segment. Walks from cells are born only where light
  // arrives.
  const double bytes = bytesOfWalks(settings, ranks);
  if (storesWalks(objects, settings) && !settings.gathersDirectLight && bytes > kMuchMemory &&
    bytes > availableBytes())
  {
    throw InputError(memorySentence(settings, "at least ", bytes));
  }
}

/// Whether the rays of so many sensors may be kept for frames to come: they take at most a quarter
/// of the memory.
inline bool mayKeepRays(std::size_t sensors, std::uint32_t raysOfEach)
{
  constexpr double bytesOfRay = 100; // some 6 kB for each sensor with 64 rays
  const double bytes = bytesOfRay * raysOfEach * static_cast<double>(sensors);
  return bytes < kMuchMemory || bytes < availableBytes() / 4;
}

/// What to say when memory ran out all the same.
inline std::string outOfMemory(
  const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks)
{
  const double reflected = std::min(0.99, meanReflectance(objects.staticObject));
  const double bytes =
    storesWalks(objects, settings) ? bytesOfWalks(settings, ranks) / (1 - reflected) : 0;
  return "out of memory: " + memorySentence(settings, "some ", bytes);
}

}
