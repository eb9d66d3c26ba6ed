// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_WalkPath_h
#define irradiance_WalkPath_h

#include "Execution/Ranks.h"
#include "Geometry/Vector.h"
#include "Surfaces/Power.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace irradiance
{

/// A stored walk, to look at.
struct WalkPath
{
  std::uint32_t walk;
  Power power; ///< with which it starts
  /// World space: the start on its light, then its hits. One that starts where direct light was
  /// gathered begins on the light from which that came. A walk that escapes has one more, where it
  /// is cut off.
  std::vector<Vector3> points;
  bool escapes;
  bool isStale; ///< part of it is no longer valid, see StaleWalks
  std::size_t
    firstRepaired; ///< the first point that was shot again, see WalkSet::repaired(); else their number
};

/// The paths that all ranks have, ordered by walk. Throws RankFailed.
std::vector<WalkPath> pathsOfAll(const std::vector<WalkPath>& own, Ranks& ranks);

}

#endif
