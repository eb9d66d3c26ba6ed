// SPDX-License-Identifier: BSD-3-Clause
#ifndef irradiance_NearLampLight_h
#define irradiance_NearLampLight_h

#include "Execution/Execution.h"
#include "FinalGather/FinalGatherPaths.h"
#include "Walks/WalkSet.h"

namespace irradiance
{

/**
 * Adds the direct light of lights from which walks start, near lamps see FirstHits, to the cells
 * that gather: their walks bring it together with the indirect light, which these cells do not take
 * from walks. They gather it as they do that of all other lights.
 *
 * `rounds`: of the walks that divide the flux of the lights. `sums`: adds to their first round, by
 * side; all ranks add the same.
 */
void addNearLampLight(const FinalGatherScene& scene, const WalkSet& set, std::size_t rounds,
  CellSums& sums, Execution& execution);

}

#endif
