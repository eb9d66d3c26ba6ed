// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_Recast_h
#define irradiance_Recast_h

#include "Repair/WalkVerifier.h"

#include <vector>

namespace irradiance
{

/// The first stale segments of walks that an earlier frame marked, with their hits in the present
/// scene: a hit found in that frame may have changed since, but the ray has not.
std::vector<StaleSegment> recast(
  const WalkTracer& tracer, const WalkHistory& history, const std::vector<SegmentRef>& segments);

}

#endif
