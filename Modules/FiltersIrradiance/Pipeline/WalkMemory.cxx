// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/WalkMemory.h"

#include "History/BounceBlock.h"
#include "Progress/InputError.h"

#include "vtksys/SystemInformation.hxx"

#include <algorithm>
#include <cmath>

namespace irradiance
{

namespace
{

constexpr double kMega = 1e6;
constexpr double kMuch = 256 * kMega; ///< less is not worth asking the system

/// Of the walks that are stored here, if each has one segment.
double bytesHere(const EngineSettings& settings, std::size_t ranks)
{
  const double walks = settings.numberOfWalks;
  const double segmentBytes = static_cast<double>(BounceBlock::pageBytes(1)) / BouncePage::kSize;
  return (settings.allOnEachRank ? walks : walks / static_cast<double>(ranks)) * segmentBytes;
}

/// All that the machine has, or the limit of the process.
double availableBytes()
{
  vtksys::SystemInformation system;
  system.RunMemoryCheck();
  const double machine = 1048576.0 *
    static_cast<double>(system.GetTotalPhysicalMemory() + system.GetTotalVirtualMemory());
  const double process = 1024.0 * static_cast<double>(system.GetProcMemoryAvailable());
  const double host = 1024.0 * static_cast<double>(system.GetHostMemoryAvailable());
  return process < host ? process : machine;
}

std::string sentence(const EngineSettings& settings, const char* how, double bytes)
{
  return "NumberOfWalks is " + std::to_string(settings.numberOfWalks) + ", and its walks take " +
    how + std::to_string(std::llround(bytes / kMega)) + " MB to store; this process may have " +
    std::to_string(std::llround(availableBytes() / kMega)) + " MB";
}

}

void requireMemory(const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks)
{
  // A walk from a light has at least one segment. Walks from cells are born only where light
  // arrives.
  const double bytes = bytesHere(settings, ranks);
  if (storesWalks(objects, settings) && !settings.gathersDirectLight && bytes > kMuch &&
    bytes > availableBytes())
  {
    throw InputError(sentence(settings, "at least ", bytes));
  }
}

bool mayKeepRays(std::size_t sensors, std::uint32_t raysOfEach)
{
  constexpr double bytesOfRay = 100; // some 6 kB for each sensor with 64 rays
  const double bytes = bytesOfRay * raysOfEach * static_cast<double>(sensors);
  return bytes < kMuch || bytes < availableBytes() / 4;
}

std::string outOfMemory(
  const SceneObjects& objects, const EngineSettings& settings, std::size_t ranks)
{
  const double reflected = std::min(0.99, meanReflectance(objects.staticObject));
  const double bytes =
    storesWalks(objects, settings) ? bytesHere(settings, ranks) / (1 - reflected) : 0;
  return "out of memory: " + sentence(settings, "some ", bytes);
}

}
