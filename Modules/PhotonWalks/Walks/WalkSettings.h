// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkSettings_h
#define irradiance_WalkSettings_h

#include "DirectLight/FewestSamples.h"

#include <cstdint>

namespace irradiance
{

/// How many walks are shot, and what is kept of them.
struct WalkSettings
{
  std::uint32_t numberOfWalks = 1000000;
  std::uint64_t seed = 1;
  bool verify = true; ///< false: all walks of every frame are shot again
  bool cacheStaticHits = false;
  /// Whether cells gather the light that comes straight from the lights, and walks start where it
  /// arrived; else walks start at the lights.
  bool gathersDirectLight = false;
  FewestSamples fewestSamples; ///< with which cells gather it
  /// Whether walks are stored even if nothing can move, for filters that need their photons.
  bool keepPhotons = false;
  /// Whether each rank shoots and keeps all walks, for filters that read their photons there; else
  /// the ranks share them.
  bool allOnEachRank = false;
  bool listRepaired = false;    ///< whether it is noted which walks a repair shoots again
  std::uint32_t replicates = 1; ///< independent; with 2 or more, standard errors are known
  /// Relative half-width of the 95 % interval that 95 % of the area is to reach; 0: no target. The
  /// number of walks is doubled until then.
  double targetRelativeError = 0;
  std::uint32_t maximumNumberOfWalks = 10000000; ///< >= numberOfWalks; with a target
  /// Seconds for the repair of a frame; what is not repaired in time stays stale for the next call.
  /// 0: no limit.
  double repairTimeBudget = 0;
};

/// What the walks of a frame cost.
struct WalkStatistics
{
  std::int64_t suspectSegments = 0; ///< for which the verification cast a ray
  std::int64_t invalidWalks = 0;    ///< found by the verification, or started where no light is now
  std::int64_t repairedSegments = 0;
  double shootSeconds = 0;
  double verifySeconds = 0;
  double repairSeconds = 0;

  WalkStatistics& operator+=(const WalkStatistics& other)
  {
    suspectSegments += other.suspectSegments;
    invalidWalks += other.invalidWalks;
    repairedSegments += other.repairedSegments;
    shootSeconds += other.shootSeconds;
    verifySeconds += other.verifySeconds;
    repairSeconds += other.repairSeconds;
    return *this;
  }
};

}

#endif
